//! A buffer of colours and depths on which triangles are drawn: flat shading, edges.

use super::layout::{LAYOUT, Layout};
use geom::measure::double_area_vector;
use glam::DVec3;
use png::EncodingError;

/// Samples with colours and depths.
pub struct Canvas {
    colours: Vec<[u8; 3]>,
    depths: Vec<f32>,
}

impl Canvas {
    const SIZE: [usize; 2] = [
        LAYOUT.width * LAYOUT.samples,
        LAYOUT.height * LAYOUT.samples,
    ];

    /// A white canvas.
    pub fn new() -> Self {
        let [width, height] = Self::SIZE;
        Self {
            colours: vec![[255; 3]; width * height],
            depths: vec![f32::NEG_INFINITY; width * height],
        }
    }

    /// Draws a triangle, given in samples to the right, samples down and depth towards the eye, where
    /// nothing is nearer.
    pub fn triangle(&mut self, corners: [DVec3; 3], colour: [f64; 3]) {
        let [a, b, c] = corners;
        let normal = double_area_vector(a, b, c);
        if normal.z == 0.0 || !normal.is_finite() {
            return;
        }
        let light = DVec3::from_array(LAYOUT.light).normalize();
        // Down is positive, and either side may be seen.
        let facing = normal.normalize_or_zero() * normal.z.signum();
        let shade = LAYOUT.shade + (1.0 - LAYOUT.shade) * facing.dot(light).max(0.0);
        let fill = colour.map(|c| (c * shade) as u8);
        let line = colour.map(|c| (c * shade * LAYOUT.edge_shade) as u8);
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
        let edges = heights.iter().all(|&h| h > LAYOUT.smallest_with_edges);
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
                let near = w.iter().zip(heights).any(|(w, h)| w * h < LAYOUT.edge);
                self.colours[at] = if edges && near { line } else { fill };
            }
        }
    }

    /// The canvas as a PNG file.
    ///
    /// # Errors
    /// Fails when the encoder does.
    pub fn png(&self) -> Result<Vec<u8>, EncodingError> {
        let Layout {
            width,
            height,
            samples,
            ..
        } = LAYOUT;
        let mut pixels = Vec::with_capacity(3 * width * height);
        for y in 0..height {
            for x in 0..width {
                let mut sum = [0_usize; 3];
                for sy in 0..samples {
                    for sx in 0..samples {
                        let at = (y * samples + sy) * width * samples + x * samples + sx;
                        for (s, c) in sum.iter_mut().zip(self.colours[at]) {
                            *s += usize::from(c);
                        }
                    }
                }
                pixels.extend(sum.map(|s| (s / (samples * samples)) as u8));
            }
        }
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&pixels)?;
        writer.finish()?;
        Ok(file)
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
    fn a_picture_is_a_png_file_of_its_size() {
        let file = Canvas::new().png().unwrap();
        let header = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x02\xd0\0\0\x02\x30\x08\x02\0\0\0";
        assert!(file.starts_with(header));
        // The end of every such file.
        assert!(file.ends_with(b"\0\0\0\0IEND\xae\x42\x60\x82"));
    }
}
