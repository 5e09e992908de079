//! The shape behind a whole surface.

use crate::shape::smooth::curvature::curvature;
use crate::shape::smooth::curves::follow;
use crate::shape::smooth::facets::Facets;
use crate::shape::smooth::heights::{Heights, barycentric, flip, patches};
use crate::shape::smooth::slack::slack;
use crate::shape::table::Table;
use geom::measure::distance_to_segment;
use glam::DVec3;

/// The smooth shape behind the facets of a surface.
pub struct SmoothSurface {
    heights: Vec<Heights>,
    /// The triangles at each vertex.
    around: Table,
    largest: f64,
}

/// What is known of the height of the shape above a point of a facet.
pub struct Height {
    /// The height, positive along the normal.
    pub shape: f64,
    /// The least and the largest height that the facets allow for.
    pub range: [f64; 2],
    /// How well that is known.
    pub slack: f64,
}

impl SmoothSurface {
    /// Of a surface with these unit normals. n log n.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]], normals: &[DVec3]) -> Self {
        let facets = Facets::new(vertices, triangles, normals);
        let corners = triangles.iter().enumerate();
        let pairs = corners.flat_map(|(t, corners)| corners.iter().map(move |&v| (v, t as u32)));
        let around = Table::new(vertices.len(), pairs);
        let folds = facets.folds();
        let curvature = curvature(&facets, &folds);
        let mut heights = patches(&facets, &curvature);
        follow(&facets, &mut heights);
        flip(&facets, &mut heights);
        slack(&facets, &around, (&folds, &curvature), &mut heights);
        Self {
            largest: heights.iter().map(Heights::most).fold(0.0, f64::max),
            heights,
            around,
        }
    }

    /// The most that any facet hides.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The shape above a point of a triangle with these corners.
    pub fn above(&self, triangle: u32, corners: [DVec3; 3], point: DVec3) -> Height {
        let heights = &self.heights[triangle as usize];
        let b = barycentric(corners, point);
        Height {
            shape: heights.shape(b),
            range: heights.range(b),
            slack: heights.slack.into(),
        }
    }

    /// The most that sharp edges hide which pass within a distance of a point of a triangle of the surface given.
    pub fn at_edges(
        &self,
        (vertices, triangles): (&[DVec3], &[[u32; 3]]),
        (triangle, point): (u32, DVec3),
        distance: f64,
    ) -> f64 {
        let mut most = 0.0_f32;
        let corners = &triangles[triangle as usize];
        for &t in corners.iter().flat_map(|v| self.around.of(*v)) {
            let border = self.heights[t as usize].border;
            let corners = triangles[t as usize].map(|v| vertices[v as usize]);
            for c in (0..3).filter(|c| border[*c] > 0.0) {
                if border[c] > most
                    && distance_to_segment(point, corners[c], corners[(c + 1) % 3]) <= distance
                {
                    most = border[c];
                }
            }
        }
        most.into()
    }
}
