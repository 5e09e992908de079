//! Triangles that go on smoothly across their edges.

use geom::edges::{Across, EdgeUse, Edges};
use geom::measure::double_area_vector;
use glam::DVec3;

/// How facets are read.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// Within this of a plane, triangles are in one plane, model units.
    pub flat: f64,
    /// Cosine of the angle between facets from which on their edge is a feature.
    pub feature: f64,
}

/// No mate.
const NONE: u32 = u32::MAX;

/// A complex of triangles, in which more than two may meet at an edge, and which of them go on smoothly beyond it.
pub struct Sheets<'a> {
    /// Positions, model units.
    pub points: &'a [DVec3],
    /// Vertex ids.
    pub triangles: &'a [[u32; 3]],
    /// Unit normal of each triangle; zero without area.
    pub normals: Vec<DVec3>,
    /// All edges.
    pub edges: Edges,
    /// Of each corner, three times the triangle beyond the edge that begins there, plus its corner, or [`NONE`].
    mates: Vec<[u32; 3]>,
}

/// What goes on beyond an edge.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Mate {
    /// The triangle.
    pub triangle: u32,
    /// The corner at which the edge begins there.
    pub corner: usize,
    /// Whether it is wound alike, so that its normal is on the same side.
    pub alike: bool,
}

impl<'a> Sheets<'a> {
    /// At each edge, those two triangles are mates that turn by least, each of all beside the other, and by less than the
    /// feature angle. Linear, but for edges with many triangles.
    pub fn new(points: &'a [DVec3], triangles: &'a [[u32; 3]], reading: Reading) -> Self {
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| points[v as usize]);
            double_area_vector(a, b, c).normalize_or_zero()
        };
        let mut sheets = Self {
            points,
            triangles,
            normals: triangles.iter().map(normal).collect(),
            edges: Edges::new(triangles),
            mates: vec![[NONE; 3]; triangles.len()],
        };
        for edge in 0..sheets.edges.len() {
            for [u, v] in sheets.pairs(edge, reading.feature) {
                sheets.mates[u.triangle as usize][u.corner as usize] =
                    3 * v.triangle + u32::from(v.corner);
                sheets.mates[v.triangle as usize][v.corner as usize] =
                    3 * u.triangle + u32::from(u.corner);
            }
        }
        sheets
    }

    fn pairs(&self, edge: usize, least: f64) -> Vec<[EdgeUse; 2]> {
        let around = self.edges.around(edge);
        let best = |u: &EdgeUse| {
            let others = around.iter().filter(|v| *v != u);
            // The first of those that are equal.
            others.fold(None, |best: Option<(f64, EdgeUse)>, v| {
                let cosine = self.cosine(u, v);
                let better = best.is_none_or(|(most, _)| cosine > most);
                if better { Some((cosine, *v)) } else { best }
            })
        };
        let mut pairs = Vec::new();
        for u in around {
            if let Some((cosine, v)) = best(u)
                && cosine > least
                && (u.triangle, u.corner) < (v.triangle, v.corner)
                && best(&v).is_some_and(|(_, w)| w == *u)
            {
                pairs.push([*u, v]);
            }
        }
        pairs
    }

    /// Cosine of the angle by which the surface turns from one triangle at an edge to another.
    fn cosine(&self, u: &EdgeUse, v: &EdgeUse) -> f64 {
        let [m, n] = [u, v].map(|u| self.normals[u.triangle as usize]);
        if u.forward == v.forward {
            -m.dot(n)
        } else {
            m.dot(n)
        }
    }

    /// What goes on beyond the edge that begins at a corner of a triangle.
    pub fn mate(&self, triangle: u32, corner: usize) -> Option<Mate> {
        let mate = self.mates[triangle as usize][corner];
        let (other, start) = (mate / 3, mate as usize % 3);
        (mate != NONE).then(|| Mate {
            triangle: other,
            corner: start,
            alike: self.triangles[other as usize][start]
                != self.triangles[triangle as usize][corner],
        })
    }

    /// Whether an edge is just inside of a facet, given the facet of each triangle.
    pub fn is_within(&self, edge: usize, facet: &[u32]) -> bool {
        match self.edges.around(edge) {
            [u, v] => {
                let mate = self.mate(u.triangle, u.corner.into());
                let [f, g] = [u, v].map(|u| facet[u.triangle as usize]);
                mate.is_some_and(|m| m.triangle == v.triangle) && f == g
            }
            _ => false,
        }
    }

    /// The triangles that go on beyond each edge.
    pub fn across(&self) -> Across {
        let beyond = self.mates.iter().map(|mates| mates.map(|m| m / 3));
        Across::over(
            beyond
                .zip(&self.mates)
                .map(|(t, m)| [0, 1, 2].map(|c| (m[c] != NONE).then_some(t[c])))
                .collect(),
        )
    }

    /// The height of a triangle above the edge that begins at a corner.
    pub fn height(&self, triangle: u32, corner: usize) -> f64 {
        let corners = self.corners(triangle);
        let [a, b, c] = [0, 1, 2].map(|i| corners[(corner + i) % 3]);
        (c - a).cross((b - a).normalize_or_zero()).length()
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.points[v as usize])
    }
}
