//! How long edges will be where surfaces are remeshed, however they are drawn.

use crate::asked::Asked;
use crate::wedge::Wedge;
use glam::DVec3;
use remesh::{Curve, Drawn, Rules, Sizes, Surface, Wanted};
use rustc_hash::FxHashMap;

/// The lengths that edges of a wedge will have.
pub struct Remade {
    wanted: Wanted,
    /// Curve of each feature edge, lower vertex first.
    features: FxHashMap<[u32; 2], u32>,
    /// The cut faces that each vertex is on, a bit each.
    faces: Vec<u8>,
}

impl Remade {
    /// Looks at the surface of a wedge as remeshing does. n log n.
    pub fn new(wedge: &Wedge<'_>, asked: &Asked) -> Self {
        let template = wedge.template;
        // What is on different sides of an edge between regions or faces stays apart.
        let mut labels: FxHashMap<(u32, u32, u8), u32> = FxHashMap::default();
        let mut lengths: Vec<f64> = Vec::new();
        let label = |(t, triangle): (usize, &tmesh::Triangle)| {
            let face = match wedge.is_cut[t] {
                true => {
                    let on = triangle.vertices.map(|v| wedge.faces[v as usize]);
                    on.into_iter().fold(u8::MAX, |x, y| x & y)
                }
                false => 0,
            };
            let next = labels.len() as u32;
            let key = (triangle.front, triangle.back, face);
            *labels.entry(key).or_insert_with(|| {
                lengths.push(asked.length[t]);
                next
            })
        };
        let surface = Surface {
            points: template.vertices.clone(),
            triangles: template.triangles.iter().map(|t| t.vertices).collect(),
            labels: template.triangles.iter().enumerate().map(label).collect(),
        };
        let bound: Vec<u32> = wedge.faces.iter().map(|&on| u32::from(on)).collect();
        let held = vec![false; surface.points.len()];
        let rules = Rules {
            held: &held,
            bound: &bound,
            onto: &|_, p: DVec3| p,
            links: &[],
            spaces: &[],
            deviation: asked.deviation,
            nearer: &[],
            noise: asked.noise,
            flat: asked.flat,
            folds: asked.folds,
            feature: asked.feature,
            sharp: 0.0,
            drawn: Drawn::Roughly,
            sizes: Sizes {
                turn: asked.turn,
                turn_is_asked: asked.turn_is_asked,
                lengths: &lengths,
                local: None,
                growth: asked.growth,
            },
        };
        let wanted = Wanted::new(&surface, &rules);
        Self {
            features: wanted.features.iter().copied().collect(),
            wanted,
            faces: wedge.faces.clone(),
        }
    }

    /// Lengths at both ends of what becomes of an edge; `None` where neither a length that is asked for nor the shape says what.
    pub fn lengths(&self, ends: [u32; 2]) -> Option<[f64; 2]> {
        let [a, b] = ends;
        let curve = self.features.get(&[a.min(b), a.max(b)]);
        let curve = curve.and_then(|&c| self.wanted.curves[c as usize].as_ref());
        let room = curve.map_or(f64::INFINITY, |curve| self.room(curve));
        let lengths = ends.map(|v| self.wanted.at[v as usize].min(room));
        lengths.iter().all(|l| l.is_finite()).then_some(lengths)
    }

    /// The longest edge that a curve has room for: one that is closed has three at least, and one that ends at a cut face goes on behind it; where
    /// both ends do, there is no telling how far.
    fn room(&self, curve: &Curve) -> f64 {
        let cut = curve.ends.iter().filter(|&&v| self.faces[v as usize] != 0);
        match (curve.ends.len(), cut.count()) {
            (0, _) => curve.length / 3.0,
            (_, 0) => curve.length,
            (_, 1) => 2.0 * curve.length,
            _ => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{OUTSIDE, Template, Triangle};

    /// A prism one high over a polygon that is seen from its middle.
    fn prism(polygon: &[[f64; 2]]) -> Template {
        let n = polygon.len() as u32;
        let level = |z: f64| polygon.iter().map(move |p| DVec3::new(p[0], p[1], z));
        let mut vertices: Vec<DVec3> = level(0.0).chain(level(1.0)).collect();
        vertices.extend([DVec3::ZERO, DVec3::Z]);
        let sides = (0..n).flat_map(|i| {
            let j = (i + 1) % n;
            let low = [2 * n, j, i];
            let high = [2 * n + 1, n + i, n + j];
            [[i, j, n + j], [i, n + j, n + i], low, high]
        });
        let triangle = |vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        };
        Template {
            triangles: sides.map(triangle).collect(),
            vertices,
            ..Template::default()
        }
    }

    fn asked(template: &Template, length: f64) -> Asked {
        let turn = std::f64::consts::FRAC_PI_6;
        Asked {
            length: vec![length; template.triangles.len()],
            turn,
            turn_is_asked: false,
            growth: 0.35,
            feature: libm::cos(turn),
            deviation: 0.25 * length * turn,
            noise: 1e-6,
            flat: 1e-9,
            folds: 1e-6,
        }
    }

    /// A square two wide, each side in so many pieces.
    fn square(pieces: u32) -> Vec<[f64; 2]> {
        let corners = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let side = |i: usize| {
            let [p, q] = [corners[i], corners[(i + 1) % 4]];
            (0..pieces).map(move |k| {
                let s = f64::from(k) / f64::from(pieces);
                [0, 1].map(|c| p[c] + s * (q[c] - p[c]))
            })
        };
        (0..4).flat_map(side).collect()
    }

    #[test]
    fn edges_are_as_long_as_asked_for_or_the_shape_has_room_for() {
        let template = prism(&square(10));
        let wedge = Wedge::new(&template, 0, 1);
        for (length, expected) in [(0.7, 0.7), (5.0, 2.0)] {
            let remade = Remade::new(&wedge, &asked(&template, length));
            let [a, b] = remade.lengths([3, 4]).unwrap();
            assert!(
                (a - expected).abs() < 1e-9 && (b - expected).abs() < 1e-9,
                "{a} {b}"
            );
        }
        // Where nothing is asked for, the shape alone tells.
        let any = Asked {
            length: vec![f64::INFINITY; template.triangles.len()],
            ..asked(&template, 5.0)
        };
        let [a, b] = Remade::new(&wedge, &any).lengths([3, 4]).unwrap();
        assert!((a - 2.0).abs() < 1e-9 && (b - 2.0).abs() < 1e-9, "{a} {b}");
    }

    #[test]
    fn edges_go_on_behind_cut_faces() {
        let template = prism(&square(10));
        let mut wedge = Wedge::new(&template, 0, 1);
        // One end of a side is on a cut face, or both are.
        for (ends, expected) in [(&[10_u32][..], 4.0), (&[0, 10], 5.0)] {
            wedge.faces.iter_mut().for_each(|on| *on = 0);
            ends.iter().for_each(|&v| wedge.faces[v as usize] = 1);
            let remade = Remade::new(&wedge, &asked(&template, 5.0));
            let [a, _] = remade.lengths([3, 4]).unwrap();
            let size = remade.wanted.at[3];
            assert!((a - size.min(expected)).abs() < 1e-9, "{a} {size}");
            assert!(a > 2.5, "{a}");
        }
    }

    #[test]
    fn curves_turn_by_no_more_than_is_wanted() {
        let circle: Vec<[f64; 2]> = (0..90)
            .map(|i| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 90.0).sin_cos();
                [cos, sin]
            })
            .collect();
        let template = prism(&circle);
        let wedge = Wedge::new(&template, 0, 1);
        for (length, expected) in [(0.3, 0.3), (5.0, std::f64::consts::FRAC_PI_6)] {
            let remade = Remade::new(&wedge, &asked(&template, length));
            let [a, b] = remade.lengths([3, 4]).unwrap();
            assert!(
                (a / expected - 1.0).abs() < 0.01 && (b / expected - 1.0).abs() < 0.01,
                "{a} {b}"
            );
        }
    }
}
