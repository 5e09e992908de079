//! Ways to read which edges are sharp.

use crate::shape::smooth::curvature::curvature;
use crate::shape::smooth::curves::follow;
use crate::shape::smooth::facets::{BENT, Facets, Fold};
use crate::shape::smooth::fit::{Told, fitted};
use crate::shape::smooth::heights::{Heights, add_fitted, flip, patches};
use crate::shape::smooth::slack::slack;
use crate::shape::table::Table;
use geom::smooth::SMOOTH_COSINE;

/// One way to read the edges of a surface.
pub struct Reading<'a> {
    facets: &'a Facets<'a>,
    /// The smooth edges between different flats.
    folds: Vec<Fold>,
    /// Whether each edge is smooth.
    is_smooth: Vec<bool>,
    /// Cosine of the largest turn at a smooth edge.
    least: f64,
}

impl<'a> Reading<'a> {
    /// All edges sharp that may be.
    pub fn sharp(facets: &'a Facets<'a>) -> Self {
        Self {
            facets,
            folds: facets.folds(),
            is_smooth: (0..facets.edges.len())
                .map(|e| facets.is_smooth(e))
                .collect(),
            least: SMOOTH_COSINE,
        }
    }

    /// All edges smooth that may be, if that is another reading than this one, which has them sharp.
    pub fn bent(&self) -> Option<Self> {
        let doubtful = self.facets.doubtful(&self.folds);
        let mut is_smooth = self.is_smooth.clone();
        for fold in &doubtful {
            is_smooth[fold.edge as usize] = true;
        }
        (!doubtful.is_empty()).then(|| Self {
            facets: self.facets,
            folds: [&self.folds[..], &doubtful].concat(),
            is_smooth,
            least: BENT,
        })
    }

    /// Heights of the shape above the triangles, from those around each vertex.
    pub fn heights(&self, around: &Table, told: Told) -> Vec<Heights> {
        let facets = self.facets;
        let curvature = curvature(facets, &self.folds);
        let mut heights = patches(facets, &curvature);
        follow(facets, &self.is_smooth, &mut heights);
        flip(facets, &self.is_smooth, &mut heights);
        let known = (&self.folds[..], &curvature[..], self.least);
        slack(facets, around, known, &mut heights);
        if let Told::ByVertices { hiding } = told {
            let fitted = fitted(facets, &self.folds, (&curvature, hiding));
            add_fitted(facets, &fitted, &mut heights);
        }
        heights
    }

    /// The edges that are not smooth.
    pub fn sharp_edges(&self) -> impl Iterator<Item = usize> {
        (0..self.is_smooth.len()).filter(|e| !self.is_smooth[*e])
    }
}
