//! Edges of a triangle complex and the triangles around them, in angular order.

use crate::element::predicate::orientation;
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// Undirected edges of a triangle list, each with the triangles around it.
pub struct Edges {
    /// Vertex ids, lower one first; in order of first appearance.
    pub ends: Vec<[u32; 2]>,
    /// Prefix offsets into `uses`, one more than `ends`.
    offsets: Vec<u32>,
    /// Triangle and corner: the edge runs from that corner to the next one, or backwards.
    uses: Vec<EdgeUse>,
}

/// A triangle's use of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeUse {
    /// Triangle index.
    pub triangle: u32,
    /// The edge joins this corner (0, 1, 2) and the next.
    pub corner: u8,
    /// Whether the triangle runs along the edge from its lower to its higher vertex id.
    pub forward: bool,
}

impl Edges {
    /// Collects the edges of a triangle list. Linear.
    pub fn new(triangles: &[[u32; 3]]) -> Self {
        let mut index: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        index.reserve(triangles.len() * 3 / 2);
        let mut ends = Vec::with_capacity(triangles.len() * 3 / 2);
        let mut of_use = Vec::with_capacity(triangles.len() * 3);
        let mut offsets = vec![0_u32];
        for t in triangles {
            for corner in 0..3 {
                let (a, b) = (t[corner], t[(corner + 1) % 3]);
                let key = if a < b { [a, b] } else { [b, a] };
                let edge = *index.entry(key).or_insert_with(|| {
                    ends.push(key);
                    offsets.push(0);
                    ends.len() as u32 - 1
                });
                of_use.push(edge);
                offsets[edge as usize + 1] += 1;
            }
        }
        for i in 1..offsets.len() {
            offsets[i] += offsets[i - 1];
        }
        let mut next = offsets.clone();
        let blank = EdgeUse {
            triangle: 0,
            corner: 0,
            forward: false,
        };
        let mut uses = vec![blank; of_use.len()];
        for (i, &edge) in of_use.iter().enumerate() {
            let (triangle, corner) = (i / 3, i % 3);
            let t = triangles[triangle];
            uses[next[edge as usize] as usize] = EdgeUse {
                triangle: triangle as u32,
                corner: corner as u8,
                forward: t[corner] < t[(corner + 1) % 3],
            };
            next[edge as usize] += 1;
        }
        Self {
            ends,
            offsets,
            uses,
        }
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The triangles around an edge, in order of triangle index.
    pub fn around(&self, edge: usize) -> &[EdgeUse] {
        &self.uses[self.offsets[edge] as usize..self.offsets[edge + 1] as usize]
    }

    /// The triangles around an edge, counter-clockwise seen against the direction from the lower to
    /// the higher vertex id (a right-handed turn about that direction). Exact; triangles at the same
    /// angle stay in order of index.
    pub fn sorted_around(
        &self,
        edge: usize,
        triangles: &[[u32; 3]],
        vertices: &[DVec3],
    ) -> Vec<EdgeUse> {
        let mut uses = self.around(edge).to_vec();
        if uses.len() > 2 {
            let [a, b] = self.ends[edge].map(|v| vertices[v as usize]);
            let apex =
                |u: &EdgeUse| vertices[apex_of(&triangles[u.triangle as usize], u.corner) as usize];
            let first = apex(&uses[0]);
            uses[1..].sort_by(|u, v| turn_order(a, b, first, apex(u), apex(v)));
        }
        uses
    }
}

/// The triangles next to each triangle.
pub struct Across {
    /// Of each corner, the triangle beyond the edge from it to the next corner, or [`NONE`].
    beyond: Vec<[u32; 3]>,
}

/// No triangle beyond an edge.
const NONE: u32 = u32::MAX;

impl Across {
    /// The triangle beyond each edge of each triangle, by the corner that the edge begins at, where there is one.
    pub fn over(beyond: Vec<[Option<u32>; 3]>) -> Self {
        let numbers = beyond.into_iter();
        Self {
            beyond: numbers.map(|t| t.map(|t| t.unwrap_or(NONE))).collect(),
        }
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.beyond.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.beyond.is_empty()
    }

    /// The triangles next to a triangle, at most three.
    pub fn of(&self, triangle: u32) -> impl Iterator<Item = u32> + use<> {
        let beyond = self.beyond[triangle as usize];
        beyond.into_iter().filter(|&t| t != NONE)
    }

    /// The triangle beyond the edge from a corner (0, 1, 2) to the next.
    pub fn beyond(&self, triangle: u32, corner: usize) -> Option<u32> {
        Some(self.beyond[triangle as usize][corner]).filter(|&t| t != NONE)
    }
}

impl Edges {
    /// Neighbours over edges with exactly two triangles that are wound alike.
    pub fn across(&self) -> Across {
        let mut beyond = vec![[NONE; 3]; self.uses.len() / 3];
        for edge in 0..self.len() {
            if let [u, v] = self.around(edge)
                && u.forward != v.forward
            {
                beyond[u.triangle as usize][u.corner as usize] = v.triangle;
                beyond[v.triangle as usize][v.corner as usize] = u.triangle;
            }
        }
        Across { beyond }
    }
}

/// The vertex of a triangle opposite to the edge that begins at `corner`.
pub fn apex_of(triangle: &[u32; 3], corner: u8) -> u32 {
    triangle[(corner as usize + 2) % 3]
}

/// Compares the angles of `p` and `q` about the directed line `a b`, measured right-handed from the
/// half plane of `first`, exactly. `first` itself has angle 0.
fn turn_order(a: DVec3, b: DVec3, first: DVec3, p: DVec3, q: DVec3) -> Ordering {
    let half = |x: DVec3| {
        let side = orientation(a, b, first, x);
        if side > 0.0 {
            1
        } else if side < 0.0 {
            3
        } else {
            // In the plane of `first`: angle 0 or half a turn.
            let axis = b - a;
            let out = |v: DVec3| (v - a) - axis * ((v - a).dot(axis) / axis.length_squared());
            if out(first).dot(out(x)) >= 0.0 { 0 } else { 2 }
        }
    };
    half(p).cmp(&half(q)).then_with(|| {
        // Within the same open half space: q beyond p when it lies on the positive side of p.
        let side = orientation(a, b, p, q);
        0.0_f64.partial_cmp(&side).unwrap_or(Ordering::Equal)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fans_are_sorted_by_angle() {
        let axis = [DVec3::ZERO, DVec3::Z];
        let mut vertices = axis.to_vec();
        let angles = [0.0, 200.0, 90.0, 10.0, 300.0, 180.0, 89.9999999];
        for angle in angles {
            let a = f64::to_radians(angle);
            vertices.push(DVec3::new(a.cos(), a.sin(), 0.3));
        }
        let triangles: Vec<[u32; 3]> = (0..angles.len() as u32).map(|i| [0, 1, i + 2]).collect();
        let edges = Edges::new(&triangles);
        let edge = edges.ends.iter().position(|e| *e == [0, 1]).unwrap();
        let order: Vec<f64> = edges
            .sorted_around(edge, &triangles, &vertices)
            .iter()
            .map(|u| angles[u.triangle as usize])
            .collect();
        assert_eq!(order, [0.0, 10.0, 89.9999999, 90.0, 180.0, 200.0, 300.0]);
    }
}
