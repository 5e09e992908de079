//! The shape behind all facets of a surface.

use super::bent::Bent;
use super::curves::{Bow, Tangents};
use super::drawing::Drawing;
use super::faces::flat_faces;
use super::sheets::{Reading, Sheets};
use geom::measure::double_area_vector;
use glam::DVec3;

/// The smooth shape that the facets of a surface stand for.
pub struct SmoothShape {
    /// Facet of each triangle of the surface.
    facet: Vec<u32>,
    /// Normal of each facet that is a flat face.
    flat: Vec<Option<DVec3>>,
    /// Where the triangles of each facet between corners begin, and where the last ones end.
    start: Vec<u32>,
    /// Corners of these triangles.
    corners: Vec<[DVec3; 3]>,
    /// The curves of their edges.
    bows: Vec<[Bow; 3]>,
    /// Of each, the corner at which the shape has a tip.
    tip: Vec<Option<u8>>,
}

impl SmoothShape {
    /// Of a surface in which more than two triangles may meet at an edge. n log n.
    pub fn new(points: &[DVec3], triangles: &[[u32; 3]], reading: Reading) -> Self {
        let sheets = Sheets::new(points, triangles, reading);
        let mut drawing = Drawing::new(&sheets, reading);
        let redrawn = drawing.redraw(&sheets);
        let sheets = Sheets::new(points, &redrawn.triangles, reading);
        let count = drawing.planes.len();
        let is_face = flat_faces(&sheets, &redrawn.facet, count);
        let is_flat: Vec<bool> = (redrawn.facet.iter())
            .map(|f| is_face[*f as usize])
            .collect();
        let bent = Bent::new(&sheets, &is_flat, &redrawn.facet);
        let plane = |facet: usize| is_face[facet].then_some(drawing.planes[facet].normal);
        let is_feature = |e: usize| !bent.is_inside(e) && !sheets.is_within(e, &redrawn.facet);
        let tangents = Tangents::new(&sheets, is_feature, reading);
        let normals = bent.normals(reading, &tangents);
        let bows = bent.bows((&tangents, &normals), |t| {
            plane(redrawn.facet[t as usize] as usize)
        });
        let tip = normals.iter().zip(&is_flat).map(|(normals, is_flat)| {
            let tip = normals.iter().position(Option::is_none)?;
            (!is_flat).then_some(tip as u8)
        });
        let mut start = vec![0; count + 1];
        redrawn
            .facet
            .iter()
            .for_each(|f| start[*f as usize + 1] += 1);
        for facet in 0..count {
            start[facet + 1] += start[facet];
        }
        Self {
            flat: (0..count).map(plane).collect(),
            corners: (0..redrawn.triangles.len() as u32)
                .map(|t| sheets.corners(t))
                .collect(),
            facet: drawing.facet,
            start,
            tip: tip.collect(),
            bows,
        }
    }

    /// Facet of a triangle of the surface.
    pub fn facet(&self, triangle: u32) -> u32 {
        self.facet[triangle as usize]
    }

    /// The unit normal of a facet that is a flat face.
    pub fn flat(&self, facet: u32) -> Option<DVec3> {
        self.flat[facet as usize]
    }

    /// Whether the shape is nowhere anything but its facets.
    pub fn is_drawn(&self) -> bool {
        let mut all = self.bows.iter().flatten().flatten();
        all.all(|b| *b == DVec3::ZERO)
    }

    /// From a point of one of some facets to the shape. On the edge between two facets, both say the same but for rounding.
    /// Linear in the number of their corners.
    pub fn above(&self, facets: &[u32], point: DVec3) -> DVec3 {
        let triangles = facets.iter().flat_map(|&facet| {
            let [from, to] = [0, 1].map(|i| self.start[facet as usize + i] as usize);
            from..to
        });
        let parts = triangles.map(|t| (t, barycentric(self.corners[t], point)));
        let least = |parts: &[f64; 3]| parts.iter().copied().fold(f64::INFINITY, f64::min);
        let within = parts.max_by(|s, t| least(&s.1).total_cmp(&least(&t.1)));
        within.map_or(DVec3::ZERO, |(t, parts)| {
            blend((&self.bows[t], self.tip[t]), parts.map(|b| b.max(0.0)))
        })
    }
}

/// The curves of the edges of a triangle, blended at a point with these barycentric coordinates. From a tip, straight lines
/// lead to the curve across from it.
fn blend((bows, tip): (&[Bow; 3], Option<u8>), parts: [f64; 3]) -> DVec3 {
    let edge = |c: usize| {
        let [i, j, k] = [0, 1, 2].map(|s| parts[(c + s) % 3]);
        let [low, high] = bows[c];
        // On the edge, where there is no k, the curve itself.
        let bow = i * j * ((i + 0.5 * k) * low + (j + 0.5 * k) * high);
        match tip.map(usize::from) == Some((c + 2) % 3) && i + j > 0.0 {
            true => bow / (i + j),
            false => bow,
        }
    };
    edge(0) + edge(1) + edge(2)
}

fn barycentric([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let area = double_area_vector(a, b, c);
    let squared = area.length_squared();
    let part = |x: DVec3, y: DVec3| double_area_vector(p, x, y).dot(area) / squared;
    [part(b, c), part(c, a), part(a, b)]
}
