//! Flat regions: sets of triangles that hang together over edges and lie in one plane.
//!
//! A region grows from a seed, and its plane is that of the seed, so that it cannot creep around a bend. Which
//! triangles it takes depends on the seed alone and not on the way it grows.

use crate::complex::edges::Across;
use crate::element::measure::double_area_vector;
use glam::DVec3;

/// No region.
const NONE: u32 = u32::MAX;

/// Connected sets of triangles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regions {
    /// Region of each triangle.
    pub of: Vec<u32>,
    /// The triangle that each region grew from.
    pub seeds: Vec<u32>,
}

impl Regions {
    /// Grows regions from seeds in the given order, which has every triangle once, over edges with two triangles:
    /// triangles that are in none yet and that `belongs(seed, triangle)` accepts. Linear.
    pub fn grow(
        across: &Across,
        order: impl IntoIterator<Item = u32>,
        mut belongs: impl FnMut(u32, u32) -> bool,
    ) -> Self {
        let mut regions = Self {
            of: vec![NONE; across.len()],
            seeds: Vec::new(),
        };
        let mut stack = Vec::new();
        for seed in order {
            if regions.of[seed as usize] != NONE {
                continue;
            }
            let region = regions.seeds.len() as u32;
            regions.seeds.push(seed);
            regions.of[seed as usize] = region;
            stack.push(seed);
            while let Some(t) = stack.pop() {
                for next in across.of(t) {
                    let place = &mut regions.of[next as usize];
                    if *place == NONE && belongs(seed, next) {
                        *place = region;
                        stack.push(next);
                    }
                }
            }
        }
        regions
    }
}

/// Cosine of the angle up to which what folds off the plane of a flat region may belong to it, 0.1 degrees, rounded down: that from
/// which on TetGen by itself tells facets apart, so that no edge is kept here that it would not keep of the whole body. With a
/// larger one shallow cones and draft angles are lost: ten degrees took 4.5 % of the volume of a part.
pub const FOLD_COSINE: f64 = 0.999_998_476;

/// Cosine of the angle up to which what folds off the plane of a whole face may belong to it, a degree, rounded down: of a face
/// that ends at sharper edges only, and does not go on as a curved one. In curved surfaces, regions of so large angles have borders
/// that lie anywhere, with sharp corners.
pub const FACE_FOLD_COSINE: f64 = 0.999_847_69;

/// Sine of that angle, rounded up.
pub const FACE_FOLD_SINE: f64 = 1.745_241e-2;

/// What counts as in the plane of a seed: what is within both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flatness {
    /// Largest distance of a corner from the plane, model units.
    pub distance: f64,
    /// Smallest cosine of the angle between the normals. The distance decides about triangles larger than it;
    /// this keeps out folds made of smaller ones.
    pub cosine: f64,
}

/// The plane of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal; zero where the seed has no area, and then the region is the seed alone.
    pub normal: DVec3,
    /// A point of the plane, the middle of the seed.
    pub origin: DVec3,
}

impl Plane {
    /// The plane of a triangle.
    pub fn of([a, b, c]: [DVec3; 3]) -> Self {
        Self {
            normal: double_area_vector(a, b, c).normalize_or_zero(),
            origin: (a + b + c) / 3.0,
        }
    }

    /// Signed distance of a point, positive on the side that the normal points to.
    pub fn height(&self, p: DVec3) -> f64 {
        (p - self.origin).dot(self.normal)
    }

    /// The largest distance of a corner of a triangle.
    pub fn off(&self, triangle: [DVec3; 3]) -> f64 {
        triangle
            .map(|p| self.height(p).abs())
            .into_iter()
            .fold(0.0, f64::max)
    }
}

/// Flat regions of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Flats {
    /// The regions.
    pub regions: Regions,
    /// The plane of each.
    pub planes: Vec<Plane>,
}

impl Flats {
    /// Grows flat regions, largest triangles first: they know the plane best. `flatness` says what counts as flat
    /// around a seed, by any of several measures, and `alike(seed, triangle)` whether two triangles may be in one region.
    /// n log n.
    pub fn new<const N: usize>(
        points: &[DVec3],
        triangles: &[[u32; 3]],
        across: &Across,
        flatness: impl Fn(u32) -> [Flatness; N],
        alike: impl Fn(u32, u32) -> bool,
    ) -> Self {
        let corners = |t: u32| triangles[t as usize].map(|v| points[v as usize]);
        let vectors: Vec<DVec3> = (0..triangles.len() as u32)
            .map(|t| {
                let [a, b, c] = corners(t);
                double_area_vector(a, b, c)
            })
            .collect();
        let sizes: Vec<f64> = vectors.iter().map(|v| v.length_squared()).collect();
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        order.sort_by(|&a, &b| sizes[b as usize].total_cmp(&sizes[a as usize]));
        let mut seed_of_plane = NONE;
        let mut plane = Plane::of([DVec3::ZERO; 3]);
        let regions = Regions::grow(across, order, |seed, next| {
            if seed != seed_of_plane {
                (seed_of_plane, plane) = (seed, Plane::of(corners(seed)));
            }
            let vector = vectors[next as usize];
            let (along, length) = (vector.dot(plane.normal), vector.length());
            let is_flat = |off: f64| {
                let measures = flatness(seed).into_iter();
                let mut within = measures.map(|m| along >= m.cosine * length && off <= m.distance);
                within.any(|within| within)
            };
            plane.normal != DVec3::ZERO && alike(seed, next) && is_flat(plane.off(corners(next)))
        });
        let planes = regions.seeds.iter().map(|&s| Plane::of(corners(s)));
        Self {
            planes: planes.collect(),
            regions,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::edges::Edges;

    /// A strip of four triangles: two flat but for `bump`, then two tilted.
    fn strip(bump: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let points = [
            (0.0, 0.0, 0.0),
            (0.0, 1.0, 0.0),
            (1.0, 0.0, 0.0),
            (1.0, 1.0, bump),
            (2.0, 0.0, 0.1),
            (2.0, 1.0, 0.1),
        ]
        .map(|(x, y, z)| DVec3::new(x, y, z));
        let triangles = vec![[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]];
        (points.to_vec(), triangles)
    }

    fn flats(bump: f64, flatness: Flatness, alike: impl Fn(u32, u32) -> bool) -> Vec<u32> {
        let (points, triangles) = strip(bump);
        let across = Edges::new(&triangles).across();
        let flats = Flats::new(&points, &triangles, &across, |_| [flatness], alike);
        flats.regions.of
    }

    #[test]
    fn cosines_and_sines_are_those_of_the_angles() {
        let cosine = |degrees: f64| libm::cos(degrees.to_radians());
        assert!((0.0..1e-9).contains(&(cosine(0.1) - FOLD_COSINE)));
        assert!((0.0..1e-8).contains(&(cosine(1.0) - FACE_FOLD_COSINE)));
        assert!((0.0..1e-7).contains(&(FACE_FOLD_SINE - libm::sin(1_f64.to_radians()))));
    }

    #[test]
    fn neighbours_in_one_plane_are_one_region() {
        let flatness = Flatness {
            distance: 1e-9,
            cosine: 0.99,
        };
        // The tilted ones are larger, and seeds first.
        assert_eq!(flats(1e-12, flatness, |_, _| true), [1, 1, 0, 0]);
        assert_eq!(flats(1e-6, flatness, |_, _| true), [3, 2, 0, 1]);
        assert_eq!(flats(0.0, flatness, |a, b| a % 2 == b % 2), [2, 3, 0, 1]);
        let tilted = Flatness {
            distance: 0.2,
            cosine: 0.99,
        };
        assert_eq!(flats(0.0, tilted, |_, _| true), [0, 0, 0, 0]);
        let level = Flatness {
            cosine: 0.999,
            ..tilted
        };
        assert_eq!(flats(0.0, level, |_, _| true), [1, 1, 0, 0]);
    }

    #[test]
    fn a_seed_without_area_is_alone() {
        let points = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, 3.0 * DVec3::X];
        let triangles = [[0, 1, 2], [1, 0, 3]];
        let across = Edges::new(&triangles).across();
        let flatness = Flatness {
            distance: 1.0,
            cosine: -1.0,
        };
        let flats = Flats::new(&points, &triangles, &across, |_| [flatness], |_, _| true);
        assert_eq!(flats.regions.seeds, [0, 1]);
    }

    #[test]
    fn a_region_does_not_creep_around_a_bend() {
        // A fan of facets that turn by a degree each, which are within two degrees of their neighbours.
        let rim = |i: u32| {
            let a = f64::from(i).to_radians();
            DVec3::new(libm::cos(a), libm::sin(a), 0.0)
        };
        let points: Vec<DVec3> = (0..=90).flat_map(|i| [rim(i), rim(i) + DVec3::Z]).collect();
        let quad = |i: u32| {
            [
                [2 * i, 2 * i + 2, 2 * i + 1],
                [2 * i + 1, 2 * i + 2, 2 * i + 3],
            ]
        };
        let triangles: Vec<[u32; 3]> = (0..90).flat_map(quad).collect();
        let across = Edges::new(&triangles).across();
        let flatness = Flatness {
            distance: f64::INFINITY,
            cosine: libm::cos(2.5_f64.to_radians()),
        };
        let flats = Flats::new(&points, &triangles, &across, |_| [flatness], |_, _| true);
        assert!(flats.regions.seeds.len() >= 90 / 5);
    }
}
