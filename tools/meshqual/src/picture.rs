//! Pictures of a mesh, drawn here: a buffer of depths, flat shading, edges.

use crate::instances::wall_triangles;
use crate::png;
use geom::tet::{FACES, TetMeasures};
use glam::{DMat3, DVec3};
use tmesh::{Document, OUTSIDE};

/// Size of a picture, pixels.
const WIDTH: usize = 720;
const HEIGHT: usize = 560;
/// Samples per pixel in each direction.
const SAMPLES: usize = 2;
/// Share of the picture that the mesh takes.
const FILL: f64 = 0.94;
/// Half the width of edges, samples.
const EDGE: f64 = 0.8;
/// Smaller triangles are drawn without edges, samples.
const SMALL: f64 = 7.0;

const COLOURS: [[f64; 3]; 8] = [
    [92.0, 142.0, 196.0],
    [226.0, 190.0, 92.0],
    [206.0, 116.0, 74.0],
    [128.0, 176.0, 112.0],
    [154.0, 122.0, 180.0],
    [110.0, 180.0, 180.0],
    [196.0, 120.0, 150.0],
    [150.0, 150.0, 150.0],
];

/// Colours of smallest dihedral angles: from 0 degrees to [`GOOD`] and above.
const QUALITY: [[f64; 3]; 5] = [
    [178.0, 24.0, 43.0],
    [239.0, 138.0, 98.0],
    [247.0, 226.0, 160.0],
    [146.0, 197.0, 160.0],
    [33.0, 120.0, 130.0],
];
const GOOD: f64 = 40.0;

/// Colour of a region, by its position in the list of regions.
pub fn region_colour(position: usize) -> [f64; 3] {
    COLOURS[position % COLOURS.len()]
}

/// Colour of a smallest dihedral angle in degrees.
pub fn quality_colour(degrees: f64) -> [f64; 3] {
    let steps = (QUALITY.len() - 1) as f64;
    let t = (degrees / GOOD).clamp(0.0, 1.0) * steps;
    let i = (t as usize).min(QUALITY.len() - 2);
    let f = t - i as f64;
    std::array::from_fn(|c| QUALITY[i][c] * (1.0 - f) + QUALITY[i + 1][c] * f)
}

/// The outside of the mesh, coloured by region, as a PNG file.
pub fn outside(document: &Document) -> Vec<u8> {
    let view = View::of(document);
    let mut canvas = Canvas::new();
    let walls = wall_triangles(document);
    // A piece on its own shows its cut faces.
    let alone = document.instances.len() <= document.templates.len();
    for instance in &document.instances {
        let t = instance.template as usize;
        let template = &document.templates[t];
        let placed = instance.isometry.placed();
        for (triangle, &on_wall) in template.triangles.iter().zip(&walls[t]) {
            let outer = (triangle.front == OUTSIDE) != (triangle.back == OUTSIDE);
            if !outer || (on_wall && !alone) {
                continue;
            }
            let inner = triangle.front.min(triangle.back);
            let region = document.placed_region(instance, inner);
            let corners = triangle
                .vertices
                .map(|v| view.see(placed.apply(template.vertices[v as usize])));
            canvas.triangle(corners, region_colour(position(document, region)));
        }
    }
    canvas.png()
}

/// The half of the mesh behind a plane through the axis, its elements coloured by their smallest
/// dihedral angle, as a PNG file; `None` without tetrahedra.
pub fn inside(document: &Document) -> Option<Vec<u8>> {
    if document.templates.iter().all(|t| t.tets.is_empty()) {
        return None;
    }
    let view = View::of(document);
    let mut canvas = Canvas::new();
    let colours: Vec<Vec<[u8; 3]>> = document
        .templates
        .iter()
        .map(|template| {
            let corners = template.tets.iter().map(|t| t.vertices);
            corners
                .map(|v| {
                    let m = TetMeasures::of(v.map(|v| template.vertices[v as usize]));
                    quality_colour(m.min_dihedral.to_degrees()).map(|c| c as u8)
                })
                .collect()
        })
        .collect();
    for instance in &document.instances {
        let t = instance.template as usize;
        let template = &document.templates[t];
        let placed = instance.isometry.placed();
        let seen: Vec<DVec3> = template
            .vertices
            .iter()
            .map(|&p| view.see(placed.apply(p)))
            .collect();
        let behind: Vec<bool> = template
            .vertices
            .iter()
            .map(|&p| view.is_behind(placed.apply(p)))
            .collect();
        // Seen from outside, with y downwards, unless the instance is a mirror image.
        let facing = if instance.isometry.reverses_orientation() {
            1.0
        } else {
            -1.0
        };
        for (tet, colour) in template.tets.iter().zip(&colours[t]) {
            if !tet.vertices.iter().all(|&v| behind[v as usize]) {
                continue;
            }
            for face in FACES {
                let [a, b, c] = face.map(|c| seen[tet.vertices[c] as usize]);
                let turn = (b - a).truncate().perp_dot((c - a).truncate());
                if turn * facing > 0.0 {
                    canvas.triangle([a, b, c], colour.map(f64::from));
                }
            }
        }
    }
    Some(canvas.png())
}

fn position(document: &Document, region: u32) -> usize {
    let found = document.regions.binary_search_by_key(&region, |r| r.id);
    found.unwrap_or(region as usize)
}

/// How the mesh is looked at: from above, with the axis upright.
struct View {
    rotation: DMat3,
    /// From the frame of the document to that of the axis.
    upright: DMat3,
    middle: DVec3,
    scale: f64,
    /// Towards the eye, along the ground.
    towards: DVec3,
    centre: DVec3,
}

impl View {
    fn of(document: &Document) -> Self {
        let (elevation, azimuth) = (36_f64.to_radians(), -62_f64.to_radians());
        let (se, ce) = (libm::sin(elevation), libm::cos(elevation));
        let (sa, ca) = (libm::sin(azimuth), libm::cos(azimuth));
        let eye = DVec3::new(ce * ca, ce * sa, se);
        let right = DVec3::new(-sa, ca, 0.0);
        // The axis of an assembled mesh lies anywhere.
        let promise = document.symmetry.as_ref().and_then(|s| s.promise.as_ref());
        let (upright, origin) = match promise.filter(|_| document.is_plain()) {
            Some(p) => (
                DMat3::from_cols_array_2d(&p.rotation),
                DVec3::from_array(p.origin),
            ),
            None => (DMat3::IDENTITY, DVec3::ZERO),
        };
        let rotation = DMat3::from_cols(right, eye.cross(right), eye).transpose() * upright;
        let mut view = Self {
            rotation,
            upright,
            middle: DVec3::ZERO,
            scale: 1.0,
            towards: DVec3::new(ca, sa, 0.0),
            centre: origin,
        };
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for instance in &document.instances {
            let placed = instance.isometry.placed();
            for &p in &document.templates[instance.template as usize].vertices {
                let q = rotation * placed.apply(p);
                low = low.min(q);
                high = high.max(q);
            }
        }
        if low.x <= high.x {
            let size = high - low;
            view.middle = 0.5 * (low + high);
            let fit = |pixels: usize, extent: f64| {
                FILL * (pixels * SAMPLES) as f64 / extent.max(f64::MIN_POSITIVE)
            };
            view.scale = fit(WIDTH, size.x).min(fit(HEIGHT, size.y));
            if promise.is_none() && document.is_plain() {
                // Nothing is known of an axis: cut through the middle.
                view.centre = rotation.transpose() * view.middle;
            }
        }
        view
    }

    /// Samples to the right, samples down, and depth towards the eye.
    fn see(&self, p: DVec3) -> DVec3 {
        let q = (self.rotation * p - self.middle) * self.scale;
        let half = [WIDTH, HEIGHT].map(|n| 0.5 * (n * SAMPLES) as f64);
        DVec3::new(half[0] + q.x, half[1] - q.y, q.z)
    }

    fn is_behind(&self, p: DVec3) -> bool {
        (self.upright * (p - self.centre)).dot(self.towards) <= 1e-9 / self.scale
    }
}

/// Samples with colours and depths.
struct Canvas {
    colours: Vec<[u8; 3]>,
    depths: Vec<f32>,
}

impl Canvas {
    const SIZE: [usize; 2] = [WIDTH * SAMPLES, HEIGHT * SAMPLES];

    fn new() -> Self {
        let [width, height] = Self::SIZE;
        Self {
            colours: vec![[255; 3]; width * height],
            depths: vec![f32::NEG_INFINITY; width * height],
        }
    }

    fn triangle(&mut self, corners: [DVec3; 3], colour: [f64; 3]) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        if normal.z == 0.0 || !normal.is_finite() {
            return;
        }
        let light = DVec3::new(-0.35, -0.5, 0.8).normalize();
        // Down is positive, and either side may be seen.
        let facing = normal.normalize_or_zero() * normal.z.signum();
        let shade = 0.55 + 0.45 * facing.dot(light).max(0.0);
        let fill = colour.map(|c| (c * shade) as u8);
        let line = colour.map(|c| (c * shade * 0.45) as u8);
        let range = |low: f64, high: f64, size: usize| {
            let begin = low.floor().clamp(0.0, size as f64) as usize;
            let end = (high.ceil() + 1.0).clamp(0.0, size as f64) as usize;
            begin..end
        };
        let [width, height] = Self::SIZE;
        let low = a.min(b).min(c);
        let high = a.max(b).max(c);
        // Distance of each corner from the opposite side, for the width of edges.
        let side = |p: DVec3, q: DVec3| (q - p).truncate().length();
        let heights = [(b, c), (c, a), (a, b)].map(|(p, q)| normal.z.abs() / side(p, q));
        let edges = heights.iter().all(|&h| h > SMALL);
        for y in range(low.y, high.y, height) {
            for x in range(low.x, high.x, width) {
                let p = DVec3::new(x as f64 + 0.5, y as f64 + 0.5, 0.0);
                let share = |q: DVec3, r: DVec3| {
                    ((q - p).truncate().perp_dot((r - p).truncate())) / normal.z
                };
                let w = [share(b, c), share(c, a), share(a, b)];
                if w.iter().any(|&w| w < 0.0) {
                    continue;
                }
                let depth = (w[0] * a.z + w[1] * b.z + w[2] * c.z) as f32;
                let at = y * width + x;
                if depth <= self.depths[at] {
                    continue;
                }
                self.depths[at] = depth;
                let near = w.iter().zip(heights).any(|(w, h)| w * h < EDGE);
                self.colours[at] = if edges && near { line } else { fill };
            }
        }
    }

    fn png(&self) -> Vec<u8> {
        let mut pixels = Vec::with_capacity(3 * WIDTH * HEIGHT);
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let mut sum = [0_usize; 3];
                for sy in 0..SAMPLES {
                    for sx in 0..SAMPLES {
                        let at = (y * SAMPLES + sy) * WIDTH * SAMPLES + x * SAMPLES + sx;
                        for (s, c) in sum.iter_mut().zip(self.colours[at]) {
                            *s += usize::from(c);
                        }
                    }
                }
                pixels.extend(sum.map(|s| (s / (SAMPLES * SAMPLES)) as u8));
            }
        }
        png::encode(WIDTH as u32, HEIGHT as u32, &pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nearer_hides_what_is_behind() {
        let mut canvas = Canvas::new();
        let corners = |z: f64| {
            [
                DVec3::new(10.0, 10.0, z),
                DVec3::new(60.0, 10.0, z),
                DVec3::new(10.0, 60.0, z),
            ]
        };
        let middle = 25 * Canvas::SIZE[0] + 25;
        canvas.triangle(corners(1.0), [200.0, 0.0, 0.0]);
        let red = canvas.colours[middle];
        assert!(red[0] > 100 && red[1] == 0);
        canvas.triangle(corners(0.0), [0.0, 200.0, 0.0]);
        assert_eq!(canvas.colours[middle], red);
        let [a, b, c] = corners(2.0);
        canvas.triangle([a, c, b], [0.0, 200.0, 0.0]);
        assert_eq!(canvas.colours[middle][0], 0);
        assert_eq!(canvas.colours[5 * Canvas::SIZE[0] + 5], [255; 3]);
    }

    #[test]
    fn qualities_run_through_all_colours() {
        assert_eq!(quality_colour(0.0), QUALITY[0]);
        assert_eq!(quality_colour(10.0), QUALITY[1]);
        assert_eq!(quality_colour(70.0), QUALITY[4]);
    }
}
