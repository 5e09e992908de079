//! The rim of an open surface: edges with an odd number of triangles, and how far what is at them may reach.

use crate::soup::surface::Surface;
use geom::edges::{EdgeUse, Edges};
use glam::DVec3;

/// The rim of a surface.
pub struct Rim {
    /// Edges of one triangle only, as that triangle uses them.
    pub open: Vec<EdgeUse>,
    /// Vertices of edges with an odd number of triangles, increasing.
    pub vertices: Vec<u32>,
    /// Of each vertex of the surface, half the length of the shortest edge at it: no neighbour is nearer to what lies
    /// within.
    clear: Vec<f64>,
    /// Of each open edge, half its length.
    halves: Vec<f64>,
    /// Of each vertex of the surface, what gaps there may be wide as far as is known now.
    allowed: Vec<f64>,
    /// What counts as equal, however short edges are.
    equal: f64,
    within: Within,
}

/// How far off corners and edges are looked for, beside their reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Within {
    /// As far as gaps may be wide.
    Allowed,
    /// Farther, too.
    Any,
}

impl Rim {
    /// The rim of a surface, given its edges with an odd number of triangles.
    pub fn new(
        surface: &Surface,
        edges: &Edges,
        odd: &[usize],
        (equal, allowed, within): (f64, Vec<f64>, Within),
    ) -> Self {
        let half = |e: usize| {
            let [a, b] = edges.ends[e].map(|v| surface.points[v as usize]);
            (0.5 * a.distance(b)).max(equal)
        };
        let mut clear = vec![f64::INFINITY; surface.points.len()];
        for (e, ends) in edges.ends.iter().enumerate() {
            let half = half(e);
            for &v in ends {
                clear[v as usize] = clear[v as usize].min(half);
            }
        }
        let mut vertices: Vec<u32> = odd.iter().flat_map(|&e| edges.ends[e]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let open = odd.iter().filter_map(|&e| match edges.around(e) {
            &[only] => Some((only, half(e))),
            _ => None,
        });
        let (open, halves) = open.unzip();
        Self {
            open,
            vertices,
            clear,
            halves,
            allowed,
            equal,
            within,
        }
    }

    /// Whether a gap may be closed that has these corners on its sides.
    pub fn may_close(&self, corners: &[u32], gap: f64) -> bool {
        let allowed = corners.iter().map(|&v| self.allowed[v as usize]);
        self.within == Within::Any || gap <= allowed.fold(self.equal, f64::max)
    }

    /// How far a vertex reaches, at most `most`.
    pub fn reach(&self, vertex: u32, most: f64) -> f64 {
        self.clear[vertex as usize].min(most).max(self.equal)
    }

    /// How far an open edge reaches, at most `most`.
    pub fn edge_reach(&self, edge: u32, most: f64) -> f64 {
        self.halves[edge as usize].min(most).max(self.equal)
    }

    /// Whether nothing reaches farther than this.
    pub fn is_within(&self, most: f64) -> bool {
        let vertices = self.vertices.iter().map(|&v| self.clear[v as usize]);
        vertices
            .chain(self.halves.iter().copied())
            .all(|r| r <= most)
    }

    /// Whether two corners at some distance may be joined, now or when the reach has grown.
    pub fn may_join(&self, corners: [u32; 2], apart: f64) -> bool {
        let [a, b] = corners.map(|v| self.clear[v as usize]);
        apart <= a.min(b) && self.may_close(&corners, apart)
    }
}

/// The box about a point that reaches half as far as given to all sides: boxes of two points that are within the
/// smaller of their reaches meet.
pub fn half_box(low: DVec3, high: DVec3, reach: f64) -> [DVec3; 2] {
    [low - 0.5 * reach, high + 0.5 * reach]
}
