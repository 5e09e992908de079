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
    /// Of each vertex of the surface, half the length of the shortest edge at it: no neighbour is nearer to what
    /// lies within.
    pub reach: Vec<f64>,
}

impl Rim {
    /// The rim of a surface, given its edges with an odd number of triangles. Within `equal`, points are the same
    /// however short the edges are.
    pub fn new(surface: &Surface, edges: &Edges, odd: &[usize], equal: f64) -> Self {
        let mut reach = vec![f64::INFINITY; surface.points.len()];
        for ends in &edges.ends {
            let [a, b] = ends.map(|v| surface.points[v as usize]);
            let half = (0.5 * (b - a).length()).max(equal);
            for &v in ends {
                reach[v as usize] = reach[v as usize].min(half);
            }
        }
        let mut vertices: Vec<u32> = odd.iter().flat_map(|&e| edges.ends[e]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let open = odd.iter().filter_map(|&e| match edges.around(e) {
            &[only] => Some(only),
            _ => None,
        });
        Self {
            open: open.collect(),
            vertices,
            reach,
        }
    }
}

/// The box about a point that reaches half as far as given to all sides: boxes of two points that are within the
/// smaller of their reaches meet.
pub fn half_box(low: DVec3, high: DVec3, reach: f64) -> [DVec3; 2] {
    [low - 0.5 * reach, high + 0.5 * reach]
}
