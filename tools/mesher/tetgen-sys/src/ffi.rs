//! Declarations of `shim/tetgen_shim.h`.

use crate::SizeNode;
use std::ffi::{c_char, c_int};
use std::sync::atomic::AtomicU64;

#[derive(Debug)]
#[repr(C)]
pub(crate) struct SharedCounts {
    pub tetrahedra: AtomicU64,
    pub points: AtomicU64,
}

#[repr(C)]
pub(crate) struct Input {
    pub switches: *const c_char,
    pub points: *const f64,
    pub triangles: *const i32,
    pub markers: *const i32,
    pub holes: *const f64,
    pub regions: *const f64,
    pub point_count: i32,
    pub triangle_count: i32,
    pub hole_count: i32,
    pub region_count: i32,
    pub memory: u64,
    pub counts: *const SharedCounts,
    pub size_nodes: *const SizeNode,
    pub size_origin: [f64; 3],
    pub size_width: f64,
    pub size_volume: f64,
}

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(crate) struct Header {
    pub state: u64,
    pub code: i64,
    pub points: u64,
    pub tetrahedra: u64,
    pub neighbors: u64,
    pub attributes: u64,
    pub triangles: u64,
    pub triangle_markers: u64,
    pub triangle_sides: u64,
}

pub(crate) const DONE: u64 = 0x7465_7464_6573_6821;
pub(crate) const BAD_SWITCHES: i64 = 1000;
pub(crate) const UNKNOWN_EXCEPTION: i64 = 1001;
pub(crate) const NO_SPACE: i64 = 1002;
pub(crate) const NOT_LINEAR: i64 = 1003;
pub(crate) const ENDED: i64 = 1004;
pub(crate) const CANNOT_BEGIN: i32 = 125;
pub(crate) const OUT_OF_MEMORY: i32 = 124;

unsafe extern "C" {
    pub(crate) fn tetgen_shim_start(input: *const Input, result: c_int, chatter: c_int) -> i32;
}
