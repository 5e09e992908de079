//! The least and the largest length that a folded field wants in cubes of an octree.

use super::fold::{Face, Folded, Tet};
use geom::tree::closest_point;
use glam::{DVec3, Vec3};

/// Elements of a folded field that may matter in a cube.
#[derive(Clone, Debug, Default)]
pub struct Listed {
    tets: Vec<u32>,
    faces: Vec<u32>,
}

/// What a field wants in a cube, in units of the whole one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Least length, or less.
    pub least: f64,
    /// Length that holds for all of the cube: the least over images of the middle of the range of each.
    pub middle: f64,
    /// An upper bound, by images in whose mesh the cube is; infinite without any.
    pub within: f64,
    /// An upper bound, by images that have some of the cube beyond the border of their mesh; infinite without any.
    pub beyond: f64,
}

/// A barycentric coordinate in single precision may be off by this where an element is small beside the cube: a thousandth of it is
/// in the next one as well.
const OUTSIDE: f32 = -1e-3;

/// What is known of an image in a cube.
#[derive(Clone, Copy, Debug)]
struct Image {
    /// Range in tetrahedra that meet the cube.
    tets: [f32; 2],
    /// Whether the border of its mesh meets the cube.
    has_border: bool,
    /// Range by its border.
    faces: [f32; 2],
}

impl Image {
    const UNKNOWN: Self = Self {
        tets: [f32::INFINITY, 0.0],
        has_border: false,
        faces: [f32::INFINITY; 2],
    };

    fn has_tets(&self) -> bool {
        self.tets[0] < f32::INFINITY
    }

    /// Whether all of the cube is in its mesh: it meets tetrahedra, and no border.
    fn is_within(&self) -> bool {
        self.has_tets() && !self.has_border
    }

    fn least(&self) -> f32 {
        self.tets[0].min(self.faces[0])
    }

    fn most(&self) -> f32 {
        match self.is_within() {
            true => self.tets[1],
            false => self.tets[1].max(self.faces[1]),
        }
    }

    fn middle(&self) -> f32 {
        let [low, high] = match self.has_tets() {
            true => self.tets,
            false => self.faces,
        };
        (low * high).sqrt()
    }
}

/// Asks a folded field.
pub struct Cells<'a> {
    folded: &'a Folded,
    growth: f32,
    images: Vec<Image>,
}

impl<'a> Cells<'a> {
    /// For lengths that grow by `growth` of the distance beyond the border.
    pub fn new(folded: &'a Folded, growth: f64) -> Self {
        Self {
            folded,
            growth: growth as f32,
            images: vec![Image::UNKNOWN; folded.images],
        }
    }

    /// All elements.
    pub fn all(&self) -> Listed {
        Listed {
            tets: (0..self.folded.tets.len() as u32).collect(),
            faces: (0..self.folded.faces.len() as u32).collect(),
        }
    }

    /// What is wanted in a cube, and which elements matter in it, where others want `most` at most. Linear in the list.
    pub fn see(&mut self, (corner, width): (DVec3, f64), listed: &Listed, most: f64) -> (Seen, Listed) {
        let half = 0.5 * width as f32;
        let cube = Cube {
            middle: corner.as_vec3() + half,
            half,
        };
        let mut kept = Listed::default();
        self.images.fill(Image::UNKNOWN);
        for &t in &listed.tets {
            let tet = &self.folded.tets[t as usize];
            if let Some([low, high]) = cube.range(tet) {
                let known = &mut self.images[tet.image as usize];
                known.tets = [known.tets[0].min(low), known.tets[1].max(high)];
                kept.tets.push(t);
            }
        }
        for &f in &listed.faces {
            let face = &self.folded.faces[f as usize];
            let known = &mut self.images[face.image as usize];
            known.has_border = known.has_border || cube.distance_to_box(face) == 0.0;
        }
        let within = self.images.iter().filter(|i| i.is_within());
        let mut bound = within.map(|i| i.tets[1]).fold(most as f32, f32::min);
        let mut near = Vec::new();
        for &f in &listed.faces {
            let face = &self.folded.faces[f as usize];
            if self.images[face.image as usize].is_within() {
                continue;
            }
            let least = face.sizes.into_iter().fold(f32::INFINITY, f32::min);
            if least + self.growth * cube.distance_to_box(face) > bound {
                continue;
            }
            let [low, high] = cube.range_from(face, self.growth);
            let known = &mut self.images[face.image as usize];
            known.faces = [known.faces[0].min(low), known.faces[1].min(high)];
            if !known.has_tets() {
                bound = bound.min(known.faces[1]);
            }
            near.push((f, low));
        }
        let mut seen = Seen {
            least: f64::INFINITY,
            middle: f64::INFINITY,
            within: f64::INFINITY,
            beyond: f64::INFINITY,
        };
        for image in &self.images {
            seen.least = seen.least.min(f64::from(image.least()));
            seen.middle = seen.middle.min(f64::from(image.middle()));
            let bound = match image.is_within() {
                true => &mut seen.within,
                false => &mut seen.beyond,
            };
            *bound = bound.min(f64::from(image.most()));
        }
        let bound = seen.within.min(seen.beyond).min(most) as f32;
        kept.tets.retain(|&t| {
            let image = self.folded.tets[t as usize].image;
            self.images[image as usize].least() <= bound
        });
        kept.faces = near
            .into_iter()
            .filter(|&(f, low)| {
                let image = self.folded.faces[f as usize].image;
                low <= bound.min(self.images[image as usize].faces[1])
            })
            .map(|(f, _)| f)
            .collect();
        (seen, kept)
    }
}

struct Cube {
    middle: Vec3,
    half: f32,
}

impl Cube {
    /// The range of lengths in what a tetrahedron and the cube may have in common; `None` if that is nothing.
    fn range(&self, tet: &Tet) -> Option<[f32; 2]> {
        let from = self.middle - tet.corner;
        let spread = |g: Vec3| self.half * g.abs().element_sum();
        let [u, v, w] = tet.gradients;
        let at = [u, v, w].map(|g| g.dot(from));
        let first = 1.0 - (at[0] + at[1] + at[2]);
        let is_beyond = |at: f32, g: Vec3| at + spread(g) < OUTSIDE;
        if is_beyond(first, u + v + w)
            || is_beyond(at[0], u)
            || is_beyond(at[1], v)
            || is_beyond(at[2], w)
        {
            return None;
        }
        let [s, a, b, c] = tet.sizes;
        let least = s.min(a).min(b).min(c);
        let most = s.max(a).max(b).max(c);
        let [a, b, c] = [a - s, b - s, c - s];
        let middle = s + a * at[0] + b * at[1] + c * at[2];
        let spread = spread(u * a + v * b + w * c);
        Some([middle - spread, middle + spread].map(|x| x.clamp(least, most)))
    }

    /// Distance from the box about a triangle.
    fn distance_to_box(&self, face: &Face) -> f32 {
        let [a, b, c] = face.corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let gap = (low - self.middle).max(self.middle - high) - self.half;
        gap.max(Vec3::ZERO).length()
    }

    /// The range of lengths that grow from the nearest point of a triangle.
    fn range_from(&self, face: &Face, growth: f32) -> [f32; 2] {
        let corners = face.corners.map(Vec3::as_dvec3);
        let middle = self.middle.as_dvec3();
        let nearest = closest_point(middle, &corners);
        let distance = middle.distance(nearest) as f32;
        let reach = self.half * 3.0_f32.sqrt();
        let (at, slope) = linear(&corners, face.sizes, nearest);
        let least = face.sizes.into_iter().fold(f32::INFINITY, f32::min);
        let most = face.sizes.into_iter().fold(0.0, f32::max);
        // What is nearest to a point moves by no more than the point.
        let low = (at - slope * reach).max(least) + growth * (distance - reach).max(0.0);
        let high = (at + slope * reach).min(most) + growth * (distance + reach);
        [low, high]
    }
}

/// A linear function on a triangle, given at its corners: its value at a point of it, and its slope.
fn linear(&[a, b, c]: &[DVec3; 3], sizes: [f32; 3], at: DVec3) -> (f32, f32) {
    let [p, q, r] = sizes.map(f64::from);
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let square = normal.length_squared();
    let (along_u, along_v) = (v.cross(normal) / square, normal.cross(u) / square);
    let gradient = along_u * (q - p) + along_v * (r - p);
    if !gradient.is_finite() {
        // Without area: the nearest corner, and no slope.
        let corners = [(a, p), (b, q), (c, r)];
        let nearest = corners
            .into_iter()
            .min_by(|x, y| x.0.distance(at).total_cmp(&y.0.distance(at)));
        return (nearest.map_or(p, |n| n.1) as f32, 0.0);
    }
    let value = p + gradient.dot(at - a);
    (value as f32, gradient.length() as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_functions_are_met_at_corners() {
        let t = [DVec3::ZERO, DVec3::X, DVec3::new(0.2, 0.7, 0.4)];
        let sizes = [0.5, 0.25, 2.0];
        for (p, size) in t.iter().zip(sizes) {
            assert!((linear(&t, sizes, *p).0 - size).abs() < 1e-6);
        }
        let needle = [DVec3::ZERO, DVec3::X, DVec3::X];
        assert_eq!(linear(&needle, [1.0, 2.0, 2.0], DVec3::X), (2.0, 0.0));
    }
}
