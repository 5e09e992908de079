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

/// Tetrahedra of each image in a cube, in the mean, up to which it is looked at what they want. Cubes with more are divided first, which
/// is far less work; so that a field that is the same everywhere has a leaf for so many of its elements at least.
const FEW: usize = 64;

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
    /// Whether the middle of the cube is in one of them.
    is_in_mesh: bool,
    /// Whether the border of its mesh meets the cube.
    has_border: bool,
    /// Range by its border.
    faces: [f32; 2],
}

impl Image {
    const UNKNOWN: Self = Self {
        tets: [f32::INFINITY, 0.0],
        is_in_mesh: false,
        has_border: false,
        faces: [f32::INFINITY; 2],
    };

    fn has_tets(&self) -> bool {
        self.tets[0] < f32::INFINITY
    }

    /// Whether all of the cube is in its mesh: its middle is, and it meets no border.
    fn is_within(&self) -> bool {
        self.is_in_mesh && !self.has_border
    }

    fn least(&self) -> f32 {
        self.tets[0].min(self.faces[0])
    }

    /// Where the mesh ends without a border, beside the template, nobody asks: there it goes on.
    fn most(&self) -> f32 {
        let goes_on = self.has_tets() && self.faces[1] == f32::INFINITY;
        match self.is_within() || goes_on {
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

    /// Drops triangles of the border from a list that do not matter in a cube: those of images in whose mesh all of it is, and those
    /// farther than others. Returns whether so many tetrahedra are listed that the cube is to be divided whatever it wants.
    pub fn narrow(&mut self, (corner, width): (DVec3, f64), listed: &mut Listed) -> bool {
        let cube = Cube::new(corner, width);
        self.images.fill(Image::UNKNOWN);
        for &t in &listed.tets {
            let tet = &self.folded.tets[t as usize];
            let known = &mut self.images[tet.image as usize];
            known.is_in_mesh = known.is_in_mesh || is_in(cube.parts(tet));
        }
        let reach = cube.reach();
        for &f in &listed.faces {
            let face = &self.folded.faces[f as usize];
            let known = &mut self.images[face.image as usize];
            let (distance, size) = cube.distance_to_box(face);
            known.has_border |= distance == 0.0;
            let farthest = face.most() + self.growth * (distance + 2.0 * reach + size);
            known.faces[1] = known.faces[1].min(farthest);
        }
        listed.faces.retain(|&f| {
            let face = &self.folded.faces[f as usize];
            let known = self.images[face.image as usize];
            !known.is_within()
                && face.least() + self.growth * cube.distance_to_box(face).0 <= known.faces[1]
        });
        listed.tets.len() > FEW * self.folded.images
    }

    /// What of a list is in each eighth of a cube, x first, then y.
    pub fn divided(&self, (corner, width): (DVec3, f64), listed: &Listed) -> [Listed; 8] {
        let middle = (corner + 0.5 * width).as_vec3();
        let mut eighths: [Listed; 8] = Default::default();
        for &t in &listed.tets {
            let [low, high] = self.folded.boxes[t as usize];
            // On either side, or both.
            let lower = low.cmple(middle).bitmask();
            let upper = high.cmpge(middle).bitmask();
            for (child, eighth) in (0..).zip(&mut eighths) {
                let is_in = (!child & lower) | (child & upper);
                if is_in == 0b111 {
                    eighth.tets.push(t);
                }
            }
        }
        for eighth in &mut eighths {
            eighth.faces.clone_from(&listed.faces);
        }
        eighths
    }

    /// What is wanted in a cube, and which elements matter in it, where others want `most` at most. The list is that of
    /// [`Cells::narrow`]. Linear in it.
    pub fn see(
        &mut self,
        (corner, width): (DVec3, f64),
        listed: &Listed,
        most: f64,
    ) -> (Seen, Listed) {
        let cube = Cube::new(corner, width);
        let mut kept = Listed::default();
        self.images.fill(Image::UNKNOWN);
        for &t in &listed.tets {
            let tet = &self.folded.tets[t as usize];
            let parts = cube.parts(tet);
            if let Some([low, high]) = cube.range(tet, parts) {
                let known = &mut self.images[tet.image as usize];
                known.is_in_mesh = known.is_in_mesh || is_in(parts);
                known.tets = [known.tets[0].min(low), known.tets[1].max(high)];
                kept.tets.push(t);
            }
        }
        for &f in &listed.faces {
            let face = &self.folded.faces[f as usize];
            let known = &mut self.images[face.image as usize];
            // The box of a slanted triangle is far larger than that.
            if !known.has_border && cube.distance_to_box(face).0 == 0.0 {
                let (_, distance) = cube.nearest(face);
                known.has_border = distance <= cube.reach();
            }
        }
        let within = self.images.iter().filter(|i| i.is_within());
        let mut bound = within.map(|i| i.tets[1]).fold(most as f32, f32::min);
        let mut near = Vec::new();
        for &f in &listed.faces {
            let face = &self.folded.faces[f as usize];
            if self.images[face.image as usize].is_within()
                || face.least() + self.growth * cube.distance_to_box(face).0 > bound
            {
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

/// Whether barycentric coordinates are those of a place in a tetrahedron.
fn is_in(parts: [f32; 4]) -> bool {
    parts.iter().all(|&part| part >= OUTSIDE)
}

struct Cube {
    middle: Vec3,
    half: f32,
}

impl Cube {
    fn new(corner: DVec3, width: f64) -> Self {
        let half = 0.5 * width as f32;
        Self {
            middle: corner.as_vec3() + half,
            half,
        }
    }

    /// The barycentric coordinates of the middle in a tetrahedron.
    fn parts(&self, tet: &Tet) -> [f32; 4] {
        let from = self.middle - tet.corner;
        let [b, c, d] = tet.gradients.map(|g| g.dot(from));
        [1.0 - (b + c + d), b, c, d]
    }

    /// The range of lengths in what a tetrahedron and the cube may have in common, by the coordinates of its middle; `None` if that is
    /// nothing.
    fn range(&self, tet: &Tet, at: [f32; 4]) -> Option<[f32; 2]> {
        let spread = |g: Vec3| self.half * g.abs().element_sum();
        let [u, v, w] = tet.gradients;
        let gradients = [u + v + w, u, v, w];
        let mut both = at.iter().zip(gradients);
        if both.any(|(at, g)| at + spread(g) < OUTSIDE) {
            return None;
        }
        let [s, a, b, c] = tet.sizes;
        let least = s.min(a).min(b).min(c);
        let most = s.max(a).max(b).max(c);
        let [a, b, c] = [a - s, b - s, c - s];
        let middle = s + a * at[1] + b * at[2] + c * at[3];
        let spread = spread(u * a + v * b + w * c);
        Some([middle - spread, middle + spread].map(|x| x.clamp(least, most)))
    }

    /// Distance from the box about a triangle, and the diagonal of that.
    fn distance_to_box(&self, face: &Face) -> (f32, f32) {
        let [a, b, c] = face.corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let gap = (low - self.middle).max(self.middle - high) - self.half;
        (gap.max(Vec3::ZERO).length(), low.distance(high))
    }

    /// Distance of the corners from the middle.
    fn reach(&self) -> f32 {
        self.half * 3.0_f32.sqrt()
    }

    /// The point of a triangle that is nearest to the middle, and its distance.
    fn nearest(&self, face: &Face) -> (DVec3, f32) {
        let middle = self.middle.as_dvec3();
        let nearest = closest_point(middle, &face.corners.map(Vec3::as_dvec3));
        (nearest, middle.distance(nearest) as f32)
    }

    /// The range of lengths that grow from the nearest point of a triangle.
    fn range_from(&self, face: &Face, growth: f32) -> [f32; 2] {
        let (nearest, distance) = self.nearest(face);
        let reach = self.reach();
        let corners = face.corners.map(Vec3::as_dvec3);
        let (at, slope) = linear(&corners, face.sizes, nearest);
        // What is nearest to a point moves by no more than the point.
        let low = (at - slope * reach).max(face.least()) + growth * (distance - reach).max(0.0);
        let high = (at + slope * reach).min(face.most()) + growth * (distance + reach);
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
