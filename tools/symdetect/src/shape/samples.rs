//! Points at which symmetry is tested.

use crate::budget::{FIT, FULL, GLANCE};
use crate::shape::interfaces::Interfaces;
use crate::shape::random::Random;
use geom::measure::double_area_vector;
use glam::DVec3;

/// Binary digits of each coordinate in a place along a space-filling curve.
const CURVE_BITS: u32 = u32::BITS / 3;

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Where it is.
    pub point: DVec3,
    /// A triangle it lies on.
    pub triangle: u32,
}

/// Samples in a fixed random order, so that any run of them is representative.
pub struct Samples {
    /// Points inside faces, evenly spread by area, every kind of interface represented.
    pub faces: Vec<Sample>,
    /// Vertices, once for each kind of interface they are on; the sharpest when there are too many.
    pub vertices: Vec<Sample>,
    /// Both, alternating until one kind runs out.
    pub mixed: Vec<Sample>,
    /// Both, neighbours in space near each other in the list: quicker to go through in full.
    pub sorted: Vec<Sample>,
}

impl Samples {
    /// Samples a surface.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]], interfaces: &Interfaces) -> Self {
        let class = &interfaces.class;
        let mut random = Random(0x5EED);
        let corners = |t: usize| triangles[t].map(|v| vertices[v as usize]);
        let mut faces = sample_faces(&corners, interfaces, &mut random);
        random.shuffle(&mut faces);
        let mut picked = pick_vertices(vertices, triangles, class, &mut random);
        random.shuffle(&mut picked);
        let mut mixed = Vec::with_capacity(faces.len() + picked.len());
        let common = faces.len().min(picked.len());
        for i in 0..common {
            mixed.extend([picked[i], faces[i]]);
        }
        mixed.extend_from_slice(&faces[common..]);
        mixed.extend_from_slice(&picked[common..]);
        let mut sorted = mixed.clone();
        sorted.sort_by_cached_key(|s| morton(s.point));
        Self {
            faces,
            vertices: picked,
            mixed,
            sorted,
        }
    }
}

/// Place of a point of the unit ball along a space-filling curve.
fn morton(p: DVec3) -> u32 {
    let spread = |x: f64| {
        let cells = 1_u32 << CURVE_BITS;
        let cell = ((0.5 * (x + 1.0) * f64::from(cells)) as u32).min(cells - 1);
        (0..CURVE_BITS).fold(0, |m, bit| m | ((cell >> bit) & 1) << (3 * bit))
    };
    spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2
}

fn sample_faces(
    corners: &impl Fn(usize) -> [DVec3; 3],
    interfaces: &Interfaces,
    random: &mut Random,
) -> Vec<Sample> {
    let (class, classes) = (&interfaces.class, interfaces.classes.len());
    let count = class.len();
    let area = |t: usize| {
        let [a, b, c] = corners(t);
        double_area_vector(a, b, c).length()
    };
    let inside = |t: usize, random: &mut Random| {
        let [a, b, c] = corners(t);
        let (mut u, mut v) = (random.unit(), random.unit());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        Sample {
            point: a + (b - a) * u + (c - a) * v,
            triangle: t as u32,
        }
    };
    let total: f64 = (0..count).map(area).sum();
    let wanted = count.clamp(FIT, FULL);
    let mut taken = vec![0_usize; classes];
    let mut samples = Vec::with_capacity(wanted + GLANCE * classes);
    // Systematic sampling: equal steps along the cumulated area.
    let step = total / wanted as f64;
    let mut next = 0.5 * step;
    let mut sum = 0.0;
    for t in 0..count {
        sum += area(t);
        while next < sum && samples.len() < wanted {
            samples.push(inside(t, random));
            taken[class[t] as usize] += 1;
            next += step;
        }
    }
    if taken.iter().any(|&n| n < GLANCE) {
        let mut members = vec![0_usize; classes];
        for &c in class {
            members[c as usize] += 1;
        }
        for (t, &c) in class.iter().enumerate() {
            let c = c as usize;
            if taken[c] < GLANCE {
                for _ in 0..GLANCE.div_ceil(members[c]) {
                    samples.push(inside(t, random));
                    taken[c] += 1;
                }
            }
        }
    }
    samples
}

/// Vertices in use, once per class of their triangles.
fn pick_vertices(
    vertices: &[DVec3],
    triangles: &[[u32; 3]],
    class: &[u32],
    random: &mut Random,
) -> Vec<Sample> {
    let mut pairs: Vec<(u32, u32, u32)> = Vec::with_capacity(triangles.len() * 3);
    for (t, corners) in triangles.iter().enumerate() {
        for &v in corners {
            pairs.push((v, class[t], t as u32));
        }
    }
    if class.iter().all(|&c| c == class[0]) {
        // One kind of interface: the first triangle of each vertex will do, without sorting.
        let mut seen = vec![false; vertices.len()];
        pairs.retain(|p| !std::mem::replace(&mut seen[p.0 as usize], true));
    } else {
        pairs.sort_unstable();
        pairs.dedup_by_key(|p| (p.0, p.1));
    }
    if pairs.len() > FULL {
        let bluntness = bluntness(vertices, triangles);
        random.shuffle(&mut pairs);
        pairs.sort_by(|p, q| {
            let [p, q] = [p, q].map(|pair| bluntness[pair.0 as usize]);
            p.total_cmp(&q)
        });
        pairs.truncate(FULL);
    }
    pairs
        .into_iter()
        .map(|(v, _, triangle)| Sample {
            point: vertices[v as usize],
            triangle,
        })
        .collect()
}

/// How well the normals around each vertex agree: the length of their mean by area, 1 in a plane.
fn bluntness(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut sum = vec![(DVec3::ZERO, 0.0); vertices.len()];
    for t in triangles {
        let [a, b, c] = t.map(|v| vertices[v as usize]);
        let n = double_area_vector(a, b, c);
        let length = n.length();
        for &v in t {
            let s = &mut sum[v as usize];
            *s = (s.0 + n, s.1 + length);
        }
    }
    sum.iter().map(|(n, total)| n.length() / total).collect()
}
