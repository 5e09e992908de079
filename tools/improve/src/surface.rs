//! Triangles of the surface, while edges between them are replaced.
//!
//! Inside of a flat facet the shape does not depend on how it is triangulated. An edge there goes like one inside, with
//! the tetrahedra around it, from one of its triangles to the other; both then have the other diagonal of the quadrilateral
//! that they are (J. Shewchuk, "Two discrete optimization algorithms for the topological improvement of tetrahedral
//! meshes", 2002).

use rustc_hash::FxHashMap;

/// The triangles, and the facets in which their edges may be replaced.
#[derive(Default)]
pub struct Surface {
    triangles: Vec<[u32; 3]>,
    facets: Vec<Option<u32>>,
    /// Number of the triangle between three vertices.
    numbers: FxHashMap<[u32; 3], u32>,
}

/// An edge between two triangles, and what is there when it is replaced.
#[derive(Clone, Copy, Debug)]
pub struct Diagonal {
    /// The edge that goes.
    pub old: [u32; 2],
    /// The one that is there instead.
    pub new: [u32; 2],
}

impl Surface {
    /// Triangles, each with the facet in which its edges may be replaced, if it is in one. Linear.
    pub fn new(triangles: Vec<[u32; 3]>, facets: Vec<Option<u32>>) -> Self {
        let free = triangles.iter().zip(&facets).enumerate();
        let numbers = free
            .filter(|(_, (_, facet))| facet.is_some())
            .map(|(i, (t, _))| (sorted(*t), i as u32))
            .collect();
        Self {
            triangles,
            facets,
            numbers,
        }
    }

    /// The triangles, in the order that they had.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Whether the triangles at an edge to both other vertices are in one facet, and may be others.
    pub fn has(&self, Diagonal { old: [a, b], new }: Diagonal) -> bool {
        let [Some(one), Some(other)] = new.map(|c| self.numbers.get(&sorted([a, b, c])).copied())
        else {
            return false;
        };
        let [s, t] = [one, other].map(|t| self.triangles[t as usize]);
        self.facets[one as usize] == self.facets[other as usize] && runs(s, a, b) != runs(t, a, b)
    }

    /// Replaces an edge.
    pub fn replace(&mut self, Diagonal { old, new }: Diagonal) {
        let [a, b] = old;
        let numbers = new.map(|c| self.numbers.remove(&sorted([a, b, c])));
        // Of the first, the edge's end goes to the corner of the other; of the other, the edge's start to the corner of the first.
        let changes = [(b, new[1]), (a, new[0])];
        for (number, (from, to)) in numbers.into_iter().zip(changes) {
            let Some(number) = number else { continue };
            let triangle = &mut self.triangles[number as usize];
            *triangle = triangle.map(|v| if v == from { to } else { v });
            self.numbers.insert(sorted(*triangle), number);
        }
    }
}

/// Whether the way around a triangle goes from `a` to `b`.
fn runs([x, y, z]: [u32; 3], a: u32, b: u32) -> bool {
    [(x, y), (y, z), (z, x)].contains(&(a, b))
}

/// Vertices of a triangle in increasing order.
pub fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagonals_are_exchanged() {
        let square = vec![[0, 1, 2], [2, 3, 0]];
        let diagonal = Diagonal {
            old: [0, 2],
            new: [1, 3],
        };
        let mut surface = Surface::new(square.clone(), vec![Some(7); 2]);
        assert!(surface.has(diagonal));
        surface.replace(diagonal);
        assert!(!surface.has(diagonal));
        // Both still run the same way around.
        assert_eq!(surface.triangles(), [[0, 1, 3], [2, 3, 1]]);
        let back = Diagonal {
            old: [1, 3],
            new: [0, 2],
        };
        assert!(surface.has(back));
        surface.replace(back);
        let all: Vec<[u32; 3]> = surface.triangles().iter().map(|&t| sorted(t)).collect();
        assert_eq!(all, [[0, 1, 2], [0, 2, 3]].map(sorted));

        // Not across facets, not where one has to stay, not on one side of a sheet only.
        for facets in [[Some(7), Some(8)], [Some(7), None], [None, None]] {
            assert!(!Surface::new(square.clone(), facets.to_vec()).has(diagonal));
        }
        let folded = vec![[0, 1, 2], [0, 3, 2]];
        assert!(!Surface::new(folded, vec![Some(7); 2]).has(diagonal));
        assert!(!Surface::default().has(diagonal));
    }
}
