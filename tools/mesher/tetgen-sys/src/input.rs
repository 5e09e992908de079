//! What TetGen is given.

use std::time::Duration;

/// A point inside a cell of the complex, with the size wanted in that cell.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct RegionSeed {
    /// A point strictly inside the cell.
    pub point: [f64; 3],
    /// Attribute that the cell's tetrahedra get under switch `A`; TetGen reads it as an integer.
    pub attribute: f64,
    /// Largest tetrahedron volume under switch `a`; not positive for none.
    pub max_volume: f64,
}

/// A piecewise linear complex whose facets are triangles.
#[derive(Clone, Copy, Debug)]
pub struct Complex<'a> {
    /// Point coordinates, all finite.
    pub points: &'a [[f64; 3]],
    /// Three point numbers each, counted from 0.
    pub triangles: &'a [[i32; 3]],
    /// One marker per triangle, not 0. Coplanar neighbours with the same marker become one facet.
    pub markers: &'a [i32],
    /// One point strictly inside each cell that is to stay empty.
    pub holes: &'a [[f64; 3]],
    /// Seeds of cells; only used under the switches `A` and `a`.
    pub regions: &'a [RegionSeed],
    /// How large tetrahedra may be from place to place, if that is bounded; only used under the switch `q`.
    pub sizes: Option<Sizes<'a>>,
}

/// An octree of sizes.
#[derive(Clone, Copy, Debug)]
pub struct Sizes<'a> {
    /// Least coordinates of the cube that it divides.
    pub origin: [f64; 3],
    /// Width of the cube.
    pub width: f64,
    /// Largest volume of a tetrahedron over the cube of the size at its middle.
    pub volume: f64,
    /// Nodes, the root first. Not empty.
    pub nodes: &'a [SizeNode],
}

/// A node of an octree of sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SizeNode {
    /// Size in a leaf.
    pub size: f64,
    /// The first of eight children, which follow each other, x first, then y; 0 for a leaf.
    pub first: u32,
    /// Unused.
    pub padding: u32,
}

/// Bounds on a run, and how it is watched.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// Wall-clock time after which the mesher is stopped; `None` for no limit.
    pub timeout: Option<Duration>,
    /// Memory that the mesher may take beyond what the caller holds, bytes; `None` for no limit.
    pub memory: Option<u64>,
    /// Processor time that the mesher may take from one thing that it prints to the next until it refines, and then without checking or
    /// making a tetrahedron; `None` for no limit. Its steps before are done in milliseconds for a thousand points, or come to no end.
    pub silence: Option<Duration>,
    /// Time from one count to the next, see [`crate::News::Counted`]; `None` for no counts.
    pub counted_every: Option<Duration>,
}
