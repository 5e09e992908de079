//! Sizes that the edges of the body and the thickness of its parts ask for.

use crate::remade::Remade;
use crate::sum::classes::RESOLUTION;
use crate::sum::samples::Sample;
use crate::sum::section::{SectionTriangle, flat};
use crate::wedge::Wedge;
use geom::edges::Edges;
use glam::DVec2;
use rustc_hash::FxHashMap;
use tmesh::OUTSIDE;

/// Cosine above which two triangles are one flat face: that of 0.03 degrees, by which single precision turns a triangle
/// of a plane whose size is the geometric mean of the body's and of the rounding.
pub const FLAT: f64 = 1.0 - f32::EPSILON as f64;

/// Lengths of the edges of the body, at their ends, and the least of those that are drawn. Edges in the walls are cuts; those that end at a
/// mirror plane go on behind it, and those that end at a seam go on from its other face.
pub fn edge_samples(wedge: &Wedge<'_>) -> (Vec<Sample>, f64) {
    let (on, partner) = (&wedge.faces, &wedge.partner);
    let vertices = &wedge.template.vertices;
    let triangles = &wedge.template.triangles;
    let corners: Vec<[u32; 3]> = triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&corners);
    let normal = |t: u32| {
        let [a, b, c] = wedge.corners(t);
        geom::measure::double_area_vector(a, b, c).normalize_or_zero()
    };
    let mut pieces: Vec<([u32; 2], f64)> = Vec::new();
    // Longest piece of an edge that ends at a vertex of the seam.
    let mut longest: FxHashMap<u32, f64> = FxHashMap::default();
    for e in 0..edges.len() {
        let [a, b] = edges.ends[e];
        if on[a as usize] & on[b as usize] != 0 {
            continue;
        }
        let around = edges.around(e);
        let is_flat = matches!(around, [u, v]
            if normal(u.triangle).dot(normal(v.triangle)) > FLAT);
        if is_flat {
            continue;
        }
        let length = vertices[a as usize].distance(vertices[b as usize]);
        for v in [a, b].into_iter().filter(|v| partner.contains_key(v)) {
            let known = longest.entry(v).or_default();
            *known = known.max(length);
        }
        pieces.push(([a, b], length));
    }
    let made = wedge.asked.as_ref();
    let made = made.map(|asked| Remade::new(wedge, asked));
    let mut samples = Vec::with_capacity(2 * pieces.len());
    let mut least = f64::INFINITY;
    for (ends, length) in pieces {
        let behind = |v: u32| match partner.get(&v) {
            Some(other) => longest.get(other).copied().unwrap_or(0.0),
            None if on[v as usize] != 0 => length,
            None => 0.0,
        };
        let drawn = length + behind(ends[0]).max(behind(ends[1]));
        least = least.min(drawn);
        let made = made.as_ref().and_then(|made| made.lengths(ends));
        let sizes = made.unwrap_or([drawn; 2]);
        samples.extend([0, 1].map(|k| Sample {
            at: flat(vertices[ends[k] as usize]),
            size: sizes[k],
        }));
    }
    (samples, least)
}

/// An edge of the section's outline or between two regions; material on either side.
pub struct OutlineEdge {
    a: DVec2,
    b: DVec2,
    /// Whether there is material to the left, and to the right.
    material: [bool; 2],
}

impl OutlineEdge {
    /// Whether two edges have an end in common.
    fn touches(&self, other: &Self) -> bool {
        [self.a, self.b]
            .iter()
            .any(|p| *p == other.a || *p == other.b)
    }
}

/// The outline of a section and the lines between its regions.
pub struct Outline {
    edges: Vec<OutlineEdge>,
}

impl Outline {
    /// Of the triangles of a section.
    pub fn new(section: &[SectionTriangle]) -> Self {
        let key = |p: DVec2| p.to_array().map(|x| (x + 0.0).to_bits());
        type Ends = ([u64; 2], [u64; 2]);
        let mut seen: FxHashMap<Ends, u32> = FxHashMap::default();
        for (t, region) in section {
            for k in 0..3 {
                seen.insert((key(t[k]), key(t[(k + 1) % 3])), *region);
            }
        }
        let mut edges = Vec::new();
        for (t, region) in section {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                let other = seen.get(&(key(b), key(a))).copied().unwrap_or(OUTSIDE);
                let on_axis = a.x == 0.0 && b.x == 0.0;
                // An edge between two regions comes twice.
                let twice = other != OUTSIDE && key(a) > key(b);
                if other != *region && !on_axis && !twice {
                    let ccw = (t[1] - t[0]).perp_dot(t[2] - t[0]) > 0.0;
                    let outside = other != OUTSIDE;
                    let material = if ccw {
                        [true, outside]
                    } else {
                        [outside, true]
                    };
                    edges.push(OutlineEdge { a, b, material });
                }
            }
        }
        Self { edges }
    }

    /// Thickness of what lies on either side of each edge, at places as far apart as the estimate tells sizes apart, no
    /// more of them than it has cells; `open` for that up to edges next to it not to count.
    pub fn thickness(&self, extent: f64, open: bool, samples: &mut Vec<Sample>) {
        let count = self.edges.len().max(1);
        let most = RESOLUTION * RESOLUTION;
        let length: f64 = self.edges.iter().map(|e| e.a.distance(e.b)).sum();
        let step = (length / most as f64).max(extent / RESOLUTION as f64);
        let stride = count.div_ceil(most);
        for edge in self.edges.iter().step_by(stride) {
            let along = edge.b - edge.a;
            let parts = (along.length() / step).ceil().max(1.0) as usize;
            let normal = along.perp().normalize_or_zero();
            for i in 0..parts {
                let from = edge.a + along * ((i as f64 + 0.5) / parts as f64);
                for (side, direction) in [normal, -normal].into_iter().enumerate() {
                    if edge.material[side]
                        && let Some((size, hit)) =
                            self.nearest(from, direction, f64::EPSILON.sqrt() * extent)
                        && !(open && edge.touches(hit))
                    {
                        samples.push(Sample { at: from, size });
                        samples.push(Sample {
                            at: from + direction * size,
                            size,
                        });
                    }
                }
            }
        }
    }

    /// Distance to the next edge along a ray, and that edge.
    fn nearest(&self, from: DVec2, direction: DVec2, least: f64) -> Option<(f64, &OutlineEdge)> {
        let mut best = f64::INFINITY;
        let mut hit = None;
        for e in &self.edges {
            let (u, v) = (e.a - from, e.b - from);
            let (p, q) = (direction.perp_dot(u), direction.perp_dot(v));
            if p * q > 0.0 || p == q {
                continue;
            }
            let t = direction.dot(u + (v - u) * (p / (p - q)));
            if t > least && t < best {
                best = t;
                hit = Some(e);
            }
        }
        hit.map(|e| (best, e))
    }
}
