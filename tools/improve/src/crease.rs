//! Edges of the surface that a vertex may come to be on.
//!
//! Around such an edge, triangles of the surface and the spaces between them take turns. The vertex divides the triangles, and what is
//! in each of the spaces makes room for it.

use crate::freedom::{Exact, Freedom, Freedoms};
use crate::mesh::Mesh;
use crate::surface::Sheet;

/// An edge of the surface.
pub struct Crease {
    /// Its ends.
    pub ends: [u32; 2],
    /// The tetrahedra at it, those of each space.
    pub spaces: Vec<Vec<u32>>,
    /// What a vertex on it may do, and what it must keep.
    pub within: (Freedom, Exact),
    /// Patches with nothing beyond at the edge, in which more triangles may be divided.
    sheets: Vec<Sheet>,
}

impl Crease {
    /// The edge between two vertices, if it is on the surface and all triangles there may be divided. Edges with an end on the axis
    /// stay.
    pub fn new(mesh: &Mesh<'_>, freedoms: &Freedoms, ends: [u32; 2]) -> Option<Self> {
        let [a, b] = ends;
        if freedoms.is_on_axis(a) || freedoms.is_on_axis(b) {
            return None;
        }
        let around = mesh.star(a).iter().copied();
        let mut left: Vec<u32> = around.filter(|&t| mesh.corners(t).contains(&b)).collect();
        let mut spaces: Vec<Vec<u32>> = Vec::new();
        // The other corner of each triangle of the surface at the edge.
        let mut corners: Vec<u32> = Vec::new();
        let others = |tet: u32| mesh.corners(tet).into_iter().filter(|v| !ends.contains(v));
        while let Some(first) = left.pop() {
            let mut space = vec![first];
            let mut open: Vec<u32> = others(first).collect();
            while let Some(c) = open.pop() {
                let is_next = |t: &u32| mesh.corners(*t).contains(&c);
                let next = left
                    .iter()
                    .position(is_next)
                    .filter(|&i| mesh.region(left[i]) == mesh.region(first));
                match next.filter(|_| !mesh.is_fixed_face([a, b, c])) {
                    Some(i) => {
                        let tet = left.swap_remove(i);
                        space.push(tet);
                        open.extend(others(tet).filter(|&v| v != c));
                    }
                    // The last face of a ring around an edge inside is between two that are known.
                    None if mesh.is_fixed_face([a, b, c]) || !closes(mesh, &space, c) => {
                        corners.push(c);
                    }
                    None => {}
                }
            }
            spaces.push(space);
        }
        corners.sort_unstable();
        corners.dedup();
        if corners.is_empty() {
            return None;
        }
        let surface = mesh.surface();
        let triangles = corners.iter().map(|&c| [a, b, c]);
        if !triangles.clone().all(|t| surface.is_divisible(t)) {
            return None;
        }
        let sheets: Vec<Sheet> = triangles.filter_map(|t| surface.sheet(t)).collect();
        let inside_of = match corners[..] {
            [c, d] => surface
                .flat([a, b, c])
                .filter(|patch| surface.is_in(patch, [a, b, d])),
            _ => None,
        };
        let within = match inside_of {
            // Inside of a sheet, there is more room in its triangles.
            Some(_) if !sheets.is_empty() => return None,
            Some(patch) => freedoms.within(&patch),
            None => {
                let [p, q] = ends.map(|v| mesh.positions[v as usize]);
                let along = (q - p).try_normalize()?;
                (Freedom::Line(along), freedoms.common(&ends))
            }
        };
        Some(Self {
            ends,
            spaces,
            within,
            sheets,
        })
    }

    /// Whether a face of what makes room for the vertex is one that it divides.
    pub fn is_divided(&self, mesh: &Mesh<'_>, face: [u32; 3]) -> bool {
        self.ends.iter().all(|v| face.contains(v))
            || self.sheets.iter().any(|s| mesh.surface().is_in(s, face))
    }
}

/// Whether two of some tetrahedra have a vertex.
fn closes(mesh: &Mesh<'_>, space: &[u32], v: u32) -> bool {
    let at = space.iter().filter(|&&t| mesh.corners(t).contains(&v));
    at.count() == 2
}
