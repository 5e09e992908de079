//! The triangles of an outer boundary.

use super::outline::{Outline, Section};
use glam::{DVec2, DVec3};
use tmesh::Isometry;

/// Where on an outer boundary something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Across the axis, at its lower end.
    Below,
    /// Across the axis, at its upper end.
    Above,
    /// Around the axis.
    Side,
}

impl Outline {
    /// Vertices in world coordinates, and triangles with outward normals.
    pub fn surface(&self) -> (Vec<DVec3>, Vec<([u32; 3], Part)>) {
        let corners = self.corners();
        let n = corners.len() as u32;
        let height = self.half_height;
        let at = |p: &DVec2, z| self.frame.to_world(p.extend(z));
        let mut vertices: Vec<DVec3> = corners.iter().map(|p| at(p, -height)).collect();
        vertices.extend(corners.iter().map(|p| at(p, height)));
        // On the axis, where a wedge has its corner.
        vertices.extend([-height, height].map(|z| at(&DVec2::ZERO, z)));
        let [bottom, top] = [2 * n, 2 * n + 1];
        let triangles = (0..n).flat_map(|a| {
            let b = (a + 1) % n;
            let (c, d) = (b + n, a + n);
            [
                ([a, b, c], Part::Side),
                ([a, c, d], Part::Side),
                ([bottom, b, a], Part::Below),
                ([top, d, c], Part::Above),
            ]
        });
        (vertices, triangles.collect())
    }

    /// Corners of the cross-section, counter-clockwise.
    fn corners(&self) -> Vec<DVec2> {
        match self.section {
            Section::Polygon { sides, inner } => {
                let (cos_half, _) = Isometry::rotation(1, 2 * sides).cos_sin();
                let corner = |k| {
                    let (cos, sin) = Isometry::rotation(k, sides).cos_sin();
                    inner / cos_half * DVec2::new(cos, sin)
                };
                (0..i64::from(sides)).map(corner).collect()
            }
            Section::Rectangle([x, y]) => [(x, y), (-x, y), (-x, -y), (x, -y)]
                .map(|(x, y)| DVec2::new(x, y))
                .to_vec(),
        }
    }

    /// What it is, in words.
    pub fn words(&self) -> String {
        let height = kit::number(2.0 * self.half_height);
        match self.section {
            Section::Polygon { sides, inner } => format!(
                "a prism of {sides} sides around a circle of radius {}, {height} high",
                kit::number(inner)
            ),
            Section::Rectangle([x, y]) => format!(
                "a box of {} by {} by {height}",
                kit::number(2.0 * x),
                kit::number(2.0 * y)
            ),
        }
    }
}
