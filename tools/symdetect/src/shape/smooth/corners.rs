//! Corners of the shape: points of it that any drawing has.

use crate::shape::smooth::facets::{BENT, Facets};
use geom::tree::Tree;
use glam::DVec3;

/// The vertices at which sharp edges meet or turn, more than they do in any drawing of a smooth surface or curve.
pub struct Corners {
    points: Vec<DVec3>,
    tree: Tree,
}

impl Corners {
    /// Of facets. n log n.
    pub fn new(facets: &Facets<'_>) -> Self {
        let edges = &facets.edges;
        let mut at: Vec<(u32, DVec3)> = Vec::new();
        for e in (0..edges.len()).filter(|e| !facets.may_be_smooth(*e)) {
            let [a, b] = edges.ends[e];
            let [p, q] = [a, b].map(|v| facets.vertices[v as usize]);
            let along = (q - p).normalize_or_zero();
            at.extend([(a, along), (b, -along)]);
        }
        at.sort_by_key(|(v, _)| *v);
        let is_corner = |edges: &&[(u32, DVec3)]| match edges {
            [_] => false,
            [(_, m), (_, n)] => -m.dot(*n) < BENT,
            _ => true,
        };
        let there = at.chunk_by(|s, t| s.0 == t.0).filter(is_corner);
        let points: Vec<DVec3> = there.map(|s| facets.vertices[s[0].0 as usize]).collect();
        Self {
            tree: Tree::new(points.iter().map(|p| [*p; 3])),
            points,
        }
    }

    /// Their mean, which is where axes pass if what they have is not more than an accident; `None` of fewer than three.
    pub fn centre(&self) -> Option<DVec3> {
        let count = self.points.len();
        (count >= 3).then(|| self.points.iter().sum::<DVec3>() / count as f64)
    }

    /// Where they are.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The one nearest to a point, if one is nearer than `within`.
    pub fn nearest(&self, point: DVec3, within: f64) -> Option<DVec3> {
        self.tree.nearest(point, within).map(|hit| hit.point)
    }
}
