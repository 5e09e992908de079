//! What a writer needs of a mesh, without the mesh being in memory as a whole.

use glam::DVec3;
use std::io;
use tmesh::{Marker, Region};

/// Some tetrahedra of one instance. Both slices have the same length.
pub struct TetBlock<'a> {
    /// Four point ids each, positively oriented.
    pub vertices: &'a [[u32; 4]],
    /// Region id of each.
    pub regions: &'a [u32],
    /// Index of the instance they belong to.
    pub instance: u32,
}

/// Regions of some tetrahedra of one instance.
pub struct TetRegionBlock<'a> {
    /// Region id of each.
    pub regions: &'a [u32],
    /// Index of the instance they belong to.
    pub instance: u32,
}

/// Some surface triangles of one instance. All slices have the same length, but for the corners.
pub struct TriangleBlock<'a> {
    /// Three point ids each, counter-clockwise seen from the front region.
    pub vertices: &'a [[u32; 3]],
    /// World coordinates of the three points; only given by [`MeshStream::facets`], else empty.
    pub corners: &'a [[DVec3; 3]],
    /// Marker id of each.
    pub markers: &'a [u32],
    /// Region in front of each, or [`tmesh::OUTSIDE`].
    pub front: &'a [u32],
    /// Region behind each, or [`tmesh::OUTSIDE`].
    pub back: &'a [u32],
    /// Wall of each: 0 for none, else one plus the position in [`MeshStream::wall_names`].
    pub walls: &'a [u32],
    /// Index of the instance they belong to.
    pub instance: u32,
}

/// Takes blocks of points.
pub type PointSink<'a> = dyn FnMut(&[DVec3]) -> io::Result<()> + 'a;
/// Takes blocks of tetrahedra.
pub type TetSink<'a> = dyn FnMut(&TetBlock<'_>) -> io::Result<()> + 'a;
/// Takes blocks of regions.
pub type TetRegionSink<'a> = dyn FnMut(&TetRegionBlock<'_>) -> io::Result<()> + 'a;
/// Takes blocks of triangles.
pub type TriangleSink<'a> = dyn FnMut(&TriangleBlock<'_>) -> io::Result<()> + 'a;

/// A mesh that can be passed over several times, block by block, always in the same order.
///
/// Every pass ends early with the first error a sink returns, and returns it.
pub trait MeshStream {
    /// One line that says what this is; see [`crate::promise_title`].
    fn title(&self) -> String;
    /// Number of points.
    fn point_count(&self) -> u64;
    /// Number of tetrahedra.
    fn tet_count(&self) -> u64;
    /// Number of surface triangles.
    fn triangle_count(&self) -> u64;
    /// Materials by id.
    fn regions(&self) -> &[Region];
    /// Boundary pieces by id.
    fn markers(&self) -> &[Marker];
    /// Names of walls; empty for an assembled mesh.
    fn wall_names(&self) -> &[String];
    /// Gives all points, world coordinates, in the order of their ids.
    fn points(&self, sink: &mut PointSink<'_>) -> io::Result<()>;
    /// Gives all tetrahedra.
    fn tets(&self, sink: &mut TetSink<'_>) -> io::Result<()>;
    /// Gives the regions of all tetrahedra, in the same order as [`MeshStream::tets`]; faster when
    /// only they are wanted.
    fn tet_regions(&self, sink: &mut TetRegionSink<'_>) -> io::Result<()>;
    /// Gives all surface triangles, without corners.
    fn triangles(&self, sink: &mut TriangleSink<'_>) -> io::Result<()>;
    /// Gives all surface triangles with their corners, in the same order.
    fn facets(&self, sink: &mut TriangleSink<'_>) -> io::Result<()>;
}
