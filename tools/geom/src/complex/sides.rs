//! Connected sides of a triangle complex.
//!
//! Each triangle has two sides. Two sides touch when one can walk from one to the other around a
//! shared edge without passing through a triangle. A component of sides bounds one cell of space;
//! a cell with cavities has several components.

use crate::complex::edges::{EdgeUse, Edges};
use crate::sets::DisjointSets;
use glam::DVec3;

/// Component of every triangle side.
pub struct SideComponents {
    /// For triangle `t`: component of its front side at `2 t`, of its back side at `2 t + 1`.
    pub component: Vec<u32>,
    /// Number of components.
    pub count: usize,
}

impl SideComponents {
    /// Component of the side the triangle's normal points to.
    pub fn front(&self, triangle: usize) -> u32 {
        self.component[2 * triangle]
    }

    /// Component of the other side.
    pub fn back(&self, triangle: usize) -> u32 {
        self.component[2 * triangle + 1]
    }
}

/// Side of the triangle that a right-handed turn about the edge (from its lower to its higher
/// vertex id) enters when it leaves the triangle, as an index into
/// [`SideComponents::component`]; `leaving` false: the side it arrives at.
fn side(u: &EdgeUse, leaving: bool) -> u32 {
    // Running forward along the edge, the apex is to the left of the edge seen from the front, and
    // a right-handed turn moves off towards the front.
    let front = u.forward == leaving;
    2 * u.triangle + u32::from(!front)
}

/// Components of the sides of a triangle complex; edges may have any number of triangles. At an
/// open edge the two sides of its one triangle are joined.
pub fn side_components(
    vertices: &[DVec3],
    triangles: &[[u32; 3]],
    edges: &Edges,
) -> SideComponents {
    let mut sets = DisjointSets::new(2 * triangles.len());
    for edge in 0..edges.len() {
        let fan = edges.sorted_around(edge, triangles, vertices);
        for (i, u) in fan.iter().enumerate() {
            let next = &fan[(i + 1) % fan.len()];
            sets.join(side(u, true), side(next, false));
        }
    }
    let (component, count) = sets.numbered();
    SideComponents { component, count }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron(base: u32) -> [[u32; 3]; 4] {
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(|t| t.map(|v| v + base))
    }

    #[test]
    fn a_closed_surface_has_an_inside_and_an_outside() {
        let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let triangles = tetrahedron(0);
        let sides = side_components(&vertices, &triangles, &Edges::new(&triangles));
        assert_eq!(sides.count, 2);
        for t in 0..4 {
            assert_eq!(sides.front(t), 0);
            assert_eq!(sides.back(t), 1);
        }
    }

    #[test]
    fn two_bodies_that_share_a_face_have_three_cells() {
        let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z];
        let mut triangles = tetrahedron(0).to_vec();
        // The second body below, without the shared face [0, 2, 1].
        triangles.extend([[0, 4, 1], [1, 4, 2], [2, 4, 0]]);
        let sides = side_components(&vertices, &triangles, &Edges::new(&triangles));
        assert_eq!(sides.count, 3);
        let outside = sides.front(1);
        let (upper, lower) = (sides.back(0), sides.front(0));
        assert!(upper != lower && upper != outside && lower != outside);
        for t in 1..4 {
            assert_eq!((sides.front(t), sides.back(t)), (outside, upper));
        }
        // Wound so that their front faces the lower body or the outside, consistently.
        for t in 4..7 {
            let pair = [sides.front(t), sides.back(t)];
            assert!(pair.contains(&outside) && pair.contains(&lower));
        }
    }
}
