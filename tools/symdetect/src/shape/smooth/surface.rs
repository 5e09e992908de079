//! The shape behind a whole surface.

use crate::shape::smooth::corners::Corners;
use crate::shape::smooth::facets::Facets;
use crate::shape::smooth::fit::Told;
use crate::shape::smooth::heights::{Heights, barycentric};
use crate::shape::smooth::reading::Reading;
use crate::shape::smooth::sharp::SharpEdges;
use crate::shape::table::Table;
use geom::measure::double_area_vector;
use glam::DVec3;

/// The smooth shape behind the facets of a surface.
pub struct SmoothSurface {
    heights: Vec<Heights>,
    /// The triangles at each vertex that have sharp edges.
    bordered: Table,
    sharp: SharpEdges,
    corners: Corners,
    largest: f64,
    mean: f64,
    /// How far above or below what folds tell the shape may be by what vertices tell.
    wider: f64,
}

/// Sharp edges near a place, chords of curves.
#[derive(Clone, Copy, Default)]
pub struct EdgesNear {
    /// The most that a curve of curvature one may be from one of them there.
    pub bow: f64,
    /// The largest curvature of the curves.
    pub curvature: f64,
}

/// What is known of the height of the shape above a point of a facet.
pub struct Height {
    /// The height, positive along the normal.
    pub shape: f64,
    /// The least and the largest height that the facets allow for.
    pub range: [f64; 2],
    /// What two estimates of it differ by where the corners of the facet are far away.
    pub slack: f64,
    /// How far away they are: the part of the slack that counts.
    pub away: f64,
}

impl Height {
    /// How far the heights that are allowed for go beyond what lies between the facet and the shape.
    pub fn doubt(&self) -> f64 {
        let [low, high] = self.range;
        (high - self.shape.max(0.0)).max(self.shape.min(0.0) - low)
    }

    /// How far two drawings of the same place may differ by what is not known of them. The shape may be as far beyond
    /// either estimate as that is from the other, which is twice what they differ by; and a place that one drawing
    /// tells well may be between corners of it all the same, where the other one tells that the shape bends.
    pub fn unknown_beside(&self, other: &Self) -> f64 {
        let own = 2.0 * (self.slack * self.away + other.slack * other.away);
        own.max(self.slack.max(other.slack) * (self.away + other.away))
    }
}

impl SmoothSurface {
    /// Of a surface with these unit normals. n log n.
    pub fn new(
        (vertices, triangles): (&[DVec3], &[[u32; 3]]),
        normals: &[DVec3],
        told: Told,
    ) -> Self {
        let facets = Facets::new(vertices, triangles, normals);
        let corners = triangles.iter().enumerate();
        let pairs = corners.flat_map(|(t, corners)| corners.iter().map(move |&v| (v, t as u32)));
        let around = Table::new(vertices.len(), pairs.clone());
        let reading = Reading::sharp(&facets);
        let bent = reading.bent();
        let mut heights = reading.heights(&around, told);
        if let Some(bent) = &bent {
            let other = bent.heights(&around, told);
            heights.iter_mut().zip(&other).for_each(|(h, o)| h.add(o));
        }
        let reading = bent.unwrap_or(reading);
        let is_bordered = |t: u32| (heights[t as usize].border.iter()).any(|b| b.length > 0.0);
        let at_sharp = pairs.filter(|(_, t)| is_bordered(*t));
        let area = |t: usize| {
            let [a, b, c] = facets.corners(t);
            double_area_vector(a, b, c).length()
        };
        let areas: Vec<f64> = (0..triangles.len()).map(area).collect();
        let hidden = heights.iter().zip(&areas).map(|(h, a)| a * h.most());
        Self {
            wider: heights.iter().map(Heights::wider).fold(0.0, f64::max),
            mean: hidden.sum::<f64>() / areas.iter().sum::<f64>(),
            largest: heights.iter().map(Heights::most).fold(0.0, f64::max),
            sharp: SharpEdges::new(&facets, reading.sharp_edges()),
            corners: Corners::new(&facets),
            bordered: Table::new(vertices.len(), at_sharp),
            heights,
        }
    }

    /// The most that any facet hides.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// How far above or below what folds tell the shape may be by what vertices tell.
    pub fn wider(&self) -> f64 {
        self.wider
    }

    /// The mean over the surface of the most that its facets hide.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// The most that a facet hides.
    pub fn most(&self, triangle: u32) -> f64 {
        self.heights[triangle as usize].most()
    }

    /// The edges that are sharp in all readings.
    pub fn sharp_edges(&self) -> &SharpEdges {
        &self.sharp
    }

    /// Where sharp edges meet.
    pub fn corners(&self) -> &Corners {
        &self.corners
    }

    /// The shape above a point of a triangle with these corners.
    pub fn above(&self, triangle: u32, corners: [DVec3; 3], point: DVec3) -> Height {
        let heights = &self.heights[triangle as usize];
        let b = barycentric(corners, point);
        Height {
            shape: heights.shape(b),
            range: heights.range(b),
            slack: heights.slack.into(),
            away: heights.away(b),
        }
    }

    /// What is known of the sharp edges that pass within a distance of a point of a triangle of the surface given, or so
    /// near that the point may be beyond the curves that they are chords of.
    pub fn edges_near(
        &self,
        (vertices, triangles): (&[DVec3], &[[u32; 3]]),
        (triangle, point): (u32, DVec3),
        distance: f64,
    ) -> EdgesNear {
        let mut near = EdgesNear::default();
        let corners = &triangles[triangle as usize];
        for &t in corners.iter().flat_map(|v| self.bordered.of(*v)) {
            let heights = &self.heights[t as usize];
            let corners = triangles[t as usize].map(|v| vertices[v as usize]);
            for c in (0..3).filter(|c| heights.border[*c].length > 0.0) {
                let (start, along) = (corners[c], corners[(c + 1) % 3] - corners[c]);
                let part = (point - start).dot(along) / along.length_squared();
                let part = part.clamp(0.0, 1.0);
                let border = heights.border[c];
                let (bow, curvature) = (
                    border.bow(part),
                    f64::from(border.curvature + border.fitted),
                );
                let reach = distance.max(bow * curvature);
                if point.distance_squared(start + part * along) <= reach * reach {
                    near.bow = near.bow.max(bow);
                    near.curvature = near.curvature.max(curvature);
                }
            }
        }
        near
    }
}
