//! What the VTK formats hold on cells: arrays of integers.

use crate::stream::MeshStream;
use std::io;
use tmesh::OUTSIDE;

/// Value of an array on cells that it says nothing about; -1 as a signed number.
pub const NONE: u32 = u32::MAX;

/// Which cells a file gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cells {
    /// Number of tetrahedra, the first cells.
    pub tets: u64,
    /// Number of triangles, which follow.
    pub triangles: u64,
}

impl Cells {
    /// The tetrahedra, and the triangles when asked for or when there is nothing else.
    pub fn of(mesh: &dyn MeshStream, boundary: bool) -> Self {
        let tets = mesh.tet_count();
        let triangles = if boundary || tets == 0 {
            mesh.triangle_count()
        } else {
            0
        };
        Self { tets, triangles }
    }

    pub fn count(self) -> u64 {
        self.tets + self.triangles
    }

    /// Points of a tetrahedron and of a triangle.
    pub fn corners(self, mesh: &dyn MeshStream) -> [u64; 2] {
        if mesh.is_second_order() {
            [10, 6]
        } else {
            [4, 3]
        }
    }
}

/// An array with one integer per cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellArray {
    /// Region of a tetrahedron; of a triangle the region behind it, or in front of it when there is
    /// none behind.
    Region,
    /// Index of the instance.
    Instance,
    /// Marker of a triangle.
    Marker,
    /// Wall of a triangle: 0 for none, else one plus its position among the wall names.
    Wall,
    /// Region in front of a triangle.
    Front,
    /// Region behind a triangle.
    Back,
}

impl CellArray {
    /// Arrays of a file with triangles.
    pub const ALL: [Self; 6] = [
        Self::Region,
        Self::Instance,
        Self::Marker,
        Self::Wall,
        Self::Front,
        Self::Back,
    ];

    /// Name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Region => "region",
            Self::Instance => "instance",
            Self::Marker => "marker",
            Self::Wall => "wall",
            Self::Front => "front",
            Self::Back => "back",
        }
    }

    /// Gives the values of all cells in order. A block without values stands for `count` times
    /// the same one.
    pub fn stream(
        self,
        mesh: &dyn MeshStream,
        cells: Cells,
        sink: &mut dyn FnMut(Values<'_>) -> io::Result<()>,
    ) -> io::Result<()> {
        match self {
            Self::Region => mesh.tet_regions(&mut |b| sink(Values::Each(b.regions)))?,
            Self::Instance => {
                mesh.tet_regions(&mut |b| sink(Values::Same(b.instance, b.regions.len() as u64)))?
            }
            _ => sink(Values::Same(NONE, cells.tets))?,
        }
        if cells.triangles == 0 {
            return Ok(());
        }
        let mut inside = Vec::new();
        mesh.triangles(&mut |b| match self {
            Self::Region => {
                let sides = b.front.iter().zip(b.back);
                inside.clear();
                inside.extend(sides.map(|(&f, &b)| if b == OUTSIDE { f } else { b }));
                sink(Values::Each(&inside))
            }
            Self::Instance => sink(Values::Same(b.instance, b.vertices.len() as u64)),
            Self::Marker => sink(Values::Each(b.markers)),
            Self::Wall => sink(Values::Each(b.walls)),
            Self::Front => sink(Values::Each(b.front)),
            Self::Back => sink(Values::Each(b.back)),
        })
    }
}

/// Values of some cells.
pub enum Values<'a> {
    /// One for each.
    Each(&'a [u32]),
    /// The same one for so many.
    Same(u32, u64),
}
