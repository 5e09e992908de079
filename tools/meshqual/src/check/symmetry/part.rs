//! Parts of a mesh.

use glam::DVec3;
use tmesh::Tet;

/// The part of the mesh that a generator has to map onto itself; the default is all of it.
#[derive(Default)]
pub struct Part {
    /// Per vertex, whether it is a corner of a tetrahedron that reaches beyond the radius, and whether
    /// it lies beyond itself.
    vertices: Option<Vec<(bool, bool)>>,
}

impl Part {
    /// The tetrahedra with a corner farther from the axis than `radius`.
    pub fn beyond(radius: f64, tets: &[Tet], points: &[DVec3]) -> Self {
        let far = |p: &DVec3| p.truncate().length() > radius;
        let mut vertices: Vec<(bool, bool)> = points.iter().map(|p| (far(p), far(p))).collect();
        for tet in tets {
            if tet.vertices.iter().any(|&v| vertices[v as usize].1) {
                tet.vertices
                    .iter()
                    .for_each(|&v| vertices[v as usize].0 = true);
            }
        }
        Self {
            vertices: Some(vertices),
        }
    }

    /// Whether a vertex belongs to the part.
    pub fn has_vertex(&self, v: usize) -> bool {
        self.vertices.as_ref().is_none_or(|all| all[v].0)
    }

    /// Whether an element with these corners does.
    pub fn has_element(&self, corners: &[u32]) -> bool {
        let far = |all: &Vec<(bool, bool)>| corners.iter().any(|&v| all[v as usize].1);
        self.vertices.as_ref().is_none_or(far)
    }
}
