//! The result, read in place from the memory file the child wrote.

use crate::Error;
use crate::ffi::{DONE, Header};
use std::fs::File;
use std::os::fd::AsRawFd;
use std::ptr::NonNull;

/// A tetrahedral mesh as TetGen returns it. Numbers count from 0; the input's points come first, in
/// their order, unless the switches say otherwise (`J` keeps points that no tetrahedron uses).
#[derive(Debug)]
pub struct Mesh {
    map: Map,
    header: Header,
}

impl Mesh {
    /// Positions.
    pub fn points(&self) -> &[[f64; 3]] {
        self.array(0)
    }

    /// Four points each, positively oriented: `(b - a) x (c - a) . (d - a) > 0`.
    pub fn tetrahedra(&self) -> &[[i32; 4]] {
        self.array(1)
    }

    /// Four neighbours each, opposite to the four corners, -1 for none; empty without switch `n`.
    pub fn neighbors(&self) -> &[[i32; 4]] {
        self.array(2)
    }

    /// One attribute per tetrahedron; empty without switch `A`.
    pub fn attributes(&self) -> &[f64] {
        self.array(3)
    }

    /// Triangles of the refined facets, three points each, in no particular orientation.
    pub fn triangles(&self) -> &[[i32; 3]] {
        self.array(4)
    }

    /// One marker per triangle.
    pub fn triangle_markers(&self) -> &[i32] {
        self.array(5)
    }

    /// The tetrahedra beside a triangle; none without switch `nn`.
    pub fn sides(&self, triangle: usize) -> [Option<usize>; 2] {
        let Some(&named) = self.array::<[i32; 2]>(6).get(triangle) else {
            return [None; 2];
        };
        // Where there is none, version 1.5.0 leaves a 0 that may also be a number.
        let corners = self.triangles()[triangle];
        let [a, b] = named.map(|tet| {
            let tet = usize::try_from(tet).ok()?;
            let t = self.tetrahedra().get(tet)?;
            corners.iter().all(|v| t.contains(v)).then_some(tet)
        });
        [a, b.filter(|_| a != b)]
    }

    /// Element count and bytes of each array, in file order.
    fn layout(header: &Header) -> [(u64, u64); 7] {
        [
            (header.points, 24),
            (header.tetrahedra, 16),
            (header.neighbors, 16),
            (header.attributes, 8),
            (header.triangles, 12),
            (header.triangle_markers, 4),
            (header.triangle_sides, 8),
        ]
    }

    fn array<T: Element>(&self, which: usize) -> &[T] {
        let layout = Self::layout(&self.header);
        let before: u64 = layout[..which]
            .iter()
            .map(|&(n, size)| padded(n, size))
            .sum();
        let (count, size) = layout[which];
        debug_assert_eq!(size, size_of::<T>() as u64);
        if count == 0 {
            return &[];
        }
        let offset = size_of::<Header>() + before as usize;
        // SAFETY: `new` checked that all arrays of the layout lie inside the map, each begins at a
        // multiple of 8 bytes, `Element` types have no invalid bit patterns, and nobody writes to
        // the map: its only writer, the child, has ended.
        unsafe {
            let first = self.map.begin.as_ptr().add(offset).cast::<T>();
            std::slice::from_raw_parts(first, count as usize)
        }
    }

    /// Maps the memory file of a child that has ended; `None` when the child did not finish.
    pub(crate) fn new(file: &File) -> Result<Option<(Self, i64)>, Error> {
        let bytes = file
            .metadata()
            .map_err(|error| Error::System {
                what: "the size of the shared memory",
                error,
            })?
            .len() as usize;
        if bytes < size_of::<Header>() {
            return Ok(None);
        }
        let map = Map::new(file, bytes)?;
        // SAFETY: the map is page-aligned and at least as long as the header.
        let header = unsafe { *map.begin.as_ptr().cast::<Header>() };
        let needed = Self::layout(&header)
            .iter()
            .try_fold(size_of::<Header>() as u64, |sum, &(n, size)| {
                sum.checked_add(n.checked_mul(size)?.checked_add(7)? & !7)
            });
        if header.state != DONE || needed.is_none_or(|n| n > bytes as u64) {
            return Ok(None);
        }
        Ok(Some((Self { map, header }, header.code)))
    }
}

fn padded(count: u64, size: u64) -> u64 {
    (count * size + 7) & !7
}

/// Plain numbers: any bit pattern is a value, alignment at most 8.
trait Element: Copy {}
impl Element for f64 {}
impl Element for i32 {}
impl<T: Element, const N: usize> Element for [T; N] {}

#[derive(Debug)]
struct Map {
    begin: NonNull<u8>,
    bytes: usize,
}

// SAFETY: the map is memory that is only read, and owned by this value.
unsafe impl Send for Map {}
// SAFETY: as above.
unsafe impl Sync for Map {}

impl Map {
    fn new(file: &File, bytes: usize) -> Result<Self, Error> {
        // SAFETY: a fresh mapping chosen by the kernel; failure is checked below.
        let begin = unsafe {
            libc::mmap(
                std::ptr::null_mut(),
                bytes,
                libc::PROT_READ,
                libc::MAP_SHARED,
                file.as_raw_fd(),
                0,
            )
        };
        if begin == libc::MAP_FAILED {
            return Err(Error::system("mapping the shared memory"));
        }
        match NonNull::new(begin.cast()) {
            Some(begin) => Ok(Self { begin, bytes }),
            None => Err(Error::system("mapping the shared memory")),
        }
    }
}

impl Drop for Map {
    fn drop(&mut self) {
        // SAFETY: unmaps exactly what `new` mapped; no slice outlives the `Mesh` that owns this.
        unsafe {
            libc::munmap(self.begin.as_ptr().cast(), self.bytes);
        }
    }
}
