//! Connected sides of a triangle complex.
//!
//! Each triangle has two sides. Two sides touch when one can walk from one to the other around a
//! shared edge without passing through a triangle. A component of sides bounds one cell of space;
//! a cell with cavities has several components.

use crate::edges::{EdgeUse, Edges};
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
    let mut sets = UnionFind::new(2 * triangles.len());
    for edge in 0..edges.len() {
        let fan = edges.sorted_around(edge, triangles, vertices);
        for (i, u) in fan.iter().enumerate() {
            let next = &fan[(i + 1) % fan.len()];
            sets.join(side(u, true), side(next, false));
        }
    }
    let (component, count) = sets.labels();
    SideComponents { component, count }
}

/// Disjoint sets with path halving; joins towards the smaller index, so labels are deterministic.
pub struct UnionFind(Vec<u32>);

impl UnionFind {
    /// `n` singletons.
    pub fn new(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    /// Representative: the smallest member of the set.
    pub fn find(&mut self, mut x: u32) -> u32 {
        while self.0[x as usize] != x {
            let up = self.0[self.0[x as usize] as usize];
            self.0[x as usize] = up;
            x = up;
        }
        x
    }

    /// Joins the sets of two members; returns whether they were apart.
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        self.0[high as usize] = low;
        a != b
    }

    /// Numbers the sets 0, 1, ... in order of their smallest member: label per member, and count.
    pub fn labels(mut self) -> (Vec<u32>, usize) {
        let n = self.0.len();
        let mut label = vec![u32::MAX; n];
        let mut count = 0;
        for x in 0..n as u32 {
            let root = self.find(x) as usize;
            if label[root] == u32::MAX {
                label[root] = count;
                count += 1;
            }
            label[x as usize] = label[root];
        }
        (label, count as usize)
    }
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
