//! What a writer needs of a mesh, without the mesh being in memory as a whole.

use glam::{DMat3, DVec3};
use std::io;
use tmesh::{Marker, Region, Source, Symmetry};

/// Some tetrahedra of one instance. All slices have the same length, but for the middles.
pub struct TetBlock<'a> {
    /// Four point ids each, positively oriented.
    pub vertices: &'a [[u32; 4]],
    /// Points in the middle of the edges, of second-order elements, else empty: on the edges between
    /// vertices 0 1, 1 2, 0 2, 0 3, 1 3, 2 3.
    pub middles: &'a [[u32; 6]],
    /// Region id of each.
    pub regions: &'a [u32],
    /// Index of the instance they belong to.
    pub instance: u32,
}

impl TetBlock<'_> {
    /// Vertices and middles of each tetrahedron of second order.
    pub fn all_points(&self) -> Vec<[u32; 10]> {
        let both = self.vertices.iter().zip(self.middles);
        both.map(|(v, m)| std::array::from_fn(|i| if i < 4 { v[i] } else { m[i - 4] }))
            .collect()
    }
}

/// Regions of some tetrahedra of one instance.
pub struct TetRegionBlock<'a> {
    /// Region id of each.
    pub regions: &'a [u32],
    /// Index of the instance they belong to.
    pub instance: u32,
}

/// Some surface triangles of one instance. All slices have the same length, but for the corners and
/// the middles.
pub struct TriangleBlock<'a> {
    /// Three point ids each, counter-clockwise seen from the front region.
    pub vertices: &'a [[u32; 3]],
    /// Points in the middle of the edges, of second-order elements, else empty: on the edges between
    /// vertices 0 1, 1 2, 2 0.
    pub middles: &'a [[u32; 3]],
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

impl TriangleBlock<'_> {
    /// Vertices and middles of each triangle of second order.
    pub fn all_points(&self) -> Vec<[u32; 6]> {
        let both = self.vertices.iter().zip(self.middles);
        both.map(|(v, m)| std::array::from_fn(|i| if i < 3 { v[i] } else { m[i - 3] }))
            .collect()
    }
}

/// What a piece of surface is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Label {
    /// A boundary piece of the input, by marker id.
    Marker(u32),
    /// A cut face, by position in [`MeshStream::wall_names`]; whatever its marker.
    Wall(u32),
    /// Neither.
    Unnamed,
}

/// All surface triangles with the same label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    /// What they have in common.
    pub label: Label,
    /// How many there are.
    pub triangles: u64,
}

/// The tetrahedron that a triangle is a face of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Position of the tetrahedron in the order of [`MeshStream::tets`], or [`Side::NONE`].
    pub tet: u64,
    /// Position among the tetrahedron's vertices of the one that is not on the face.
    pub opposite: u8,
}

impl Side {
    /// A triangle that is no face of a tetrahedron.
    pub const NONE: u64 = u64::MAX;
}

/// Some triangles of one patch and one instance. All slices have the same length, but for the
/// middles and the sides.
pub struct PatchBlock<'a> {
    /// Three point ids each. Where there is material on one side only, the normal points out of it.
    pub vertices: &'a [[u32; 3]],
    /// Points in the middle of the edges, as in [`TriangleBlock`].
    pub middles: &'a [[u32; 3]],
    /// The tetrahedron behind each, or in front of it where there is none behind; empty unless
    /// asked for.
    pub sides: &'a [Side],
}

/// Two faces of a mesh of which one is the image of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// Such as `seam`.
    pub name: String,
    /// The face mapped, as a position in [`MeshStream::wall_names`].
    pub low: u32,
    /// Its image; the same as `low` when the faces of both templates at a hub share a label.
    pub high: u32,
    /// Number of sectors that make up the whole when the map is a rotation by one part of a turn,
    /// else `None`.
    pub sectors: Option<u32>,
    /// Linear part of the map, world coordinates.
    pub matrix: DMat3,
    /// What the map adds.
    pub translation: DVec3,
    /// Two points of the axis; the map turns to the right about the direction from the first to the
    /// second.
    pub axis: [DVec3; 2],
    /// Pairs (point of the low face, its image). Points on the axis are paired with themselves.
    pub points: Vec<[u32; 2]>,
    /// Pairs (triangle of the low face, its image), positions in the order of
    /// [`MeshStream::triangles`].
    pub triangles: Vec<[u64; 2]>,
}

impl Coupling {
    /// Image of a point.
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.matrix * p + self.translation
    }

    /// The map as a 4 x 4 matrix, row by row.
    pub fn affine(&self) -> [f64; 16] {
        let rows = self.matrix.transpose();
        let t = self.translation;
        let mut all = [0.0; 16];
        for (to, (row, t)) in all.chunks_exact_mut(4).zip([
            (rows.x_axis, t.x),
            (rows.y_axis, t.y),
            (rows.z_axis, t.z),
        ]) {
            to.copy_from_slice(&[row.x, row.y, row.z, t]);
        }
        all[15] = 1.0;
        all
    }
}

/// Takes blocks of points.
pub type PointSink<'a> = dyn FnMut(&[DVec3]) -> io::Result<()> + 'a;
/// Takes blocks of tetrahedra.
pub type TetSink<'a> = dyn FnMut(&TetBlock<'_>) -> io::Result<()> + 'a;
/// Takes blocks of regions.
pub type TetRegionSink<'a> = dyn FnMut(&TetRegionBlock<'_>) -> io::Result<()> + 'a;
/// Takes blocks of triangles.
pub type TriangleSink<'a> = dyn FnMut(&TriangleBlock<'_>) -> io::Result<()> + 'a;

/// Takes blocks of triangles of a patch.
pub type PatchSink<'a> = dyn FnMut(&PatchBlock<'_>) -> io::Result<()> + 'a;

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
    /// Pieces of the surface, increasing in label.
    fn patches(&self) -> &[Patch];
    /// Gives the triangles of one patch; with the tetrahedra they are faces of when `sides` is set.
    fn patch(&self, patch: usize, sides: bool, sink: &mut PatchSink<'_>) -> io::Result<()>;

    /// Whether edges have points in the middle.
    fn is_second_order(&self) -> bool {
        false
    }
    /// For each of [`MeshStream::wall_names`] the unit normal of the mirror plane it lies on, world
    /// coordinates; none where it is no such face.
    fn wall_normals(&self) -> &[Option<DVec3>] {
        &[]
    }
    /// Faces that are images of each other; none in an assembled mesh.
    fn couplings(&self) -> &[Coupling] {
        &[]
    }
    /// Names of faces of a sector that only other sectors adjoin, at places where this one has no face left to couple them
    /// with.
    fn uncoupled(&self) -> &[String] {
        &[]
    }
    /// Edges on the axis of a sector, in order along it; of second-order elements their halves.
    fn axis_edges(&self) -> &[[u32; 2]] {
        &[]
    }
    /// Ids that the points have in the mesh that this one is a piece of.
    fn point_ids(&self) -> Option<&[u32]> {
        None
    }

    /// The symmetry that was found in a body which is stored as a whole, and what it was read from.
    fn findings(&self) -> Option<(&Symmetry, Option<&Source>)> {
        None
    }

    /// What a patch is called, if it has a name.
    fn patch_name(&self, label: Label) -> Option<String> {
        match label {
            Label::Marker(id) => {
                let markers = self.markers();
                let found = markers.binary_search_by_key(&id, |m| m.id);
                Some(found.map_or_else(|_| format!("marker{id}"), |i| markers[i].name.clone()))
            }
            Label::Wall(wall) => self.wall_names().get(wall as usize).cloned(),
            Label::Unnamed => None,
        }
    }
    /// What a region is called.
    fn region_name(&self, id: u32) -> String {
        let regions = self.regions();
        let found = regions.binary_search_by_key(&id, |r| r.id);
        found.map_or_else(|_| format!("region{id}"), |i| regions[i].name.clone())
    }
}
