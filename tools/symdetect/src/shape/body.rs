//! The body, made ready for symmetry tests: centred, scaled to unit size, sampled, and searchable.

use crate::shape::directional::DirectionalMoment;
use crate::shape::flat::{Exactness, Faces, Surface};
use crate::shape::interfaces::Interfaces;
use crate::shape::moments::Moments;
use crate::shape::motion::Target;
use crate::shape::regions::Permutation;
use crate::shape::samples::Samples;
use crate::shape::smooth::{BENT, SmoothSurface, Told};
use crate::shape::trees::{Part, Trees};
use crate::threads::both;
use crate::tolerance::{ARITHMETIC, ROUNDINGS};
use geom::measure::double_area_vector;
use geom::smooth::SMOOTH_COSINE;
use geom::tree::{Nearest, closest_point};
use glam::DVec3;
use std::sync::OnceLock;
use tmesh::{Frame, Template};

/// A surface in coordinates where its centre is the origin and its farthest point is at distance 1.
pub struct Shape {
    /// Vertex positions; those no triangle uses are at the origin.
    pub vertices: Vec<DVec3>,
    /// Vertex ids.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals; zero for triangles without area.
    pub normals: Vec<DVec3>,
    /// Regions on the sides of the triangles.
    pub interfaces: Interfaces,
    /// World position of the origin.
    pub origin: DVec3,
    /// World length of 1.
    pub scale: f64,
    /// Absolute error of a coordinate in this frame.
    pub precision: f64,
    /// Moments, in this frame.
    pub moments: Moments,
    /// Test points.
    pub samples: Samples,
    /// Whether operations may exchange regions of one shape.
    pub may_exchange: bool,
    /// What tells of the shape behind the facets.
    pub told: Told,
    drawn: Trees,
    critical: OnceLock<Vec<DVec3>>,
    /// By what tells of it.
    behind: [Behind; 2],
    faces: OnceLock<Option<Faces>>,
}

/// The shape behind the facets, and trees that find what it may be on.
#[derive(Default)]
struct Behind {
    smooth: OnceLock<SmoothSurface>,
    trees: OnceLock<Trees>,
}

/// Triangles up to which flat faces are looked for. Finding them takes some 0.3 microseconds a triangle and a test of
/// them as long again, where samples take the same time however many triangles there are: with more, samples tell
/// sooner; with fewer, faces tell more.
const FACES_LOOKED_FOR: usize = 100_000;

/// Distance, in the units of the shape, up to which corners may be images of each other where the precision of
/// coordinates does not explain more: coordinates written with ten digits. With less, corners from text are told by
/// samples; with more, corners that are no images of each other may be as near.
const SAME_CORNER: f64 = 1e-10;
/// Rounding, in the units of the shape, up to which flat faces are looked for: a tenth of the default tolerance. Of
/// coarser coordinates, as far away from the origin, corners that are no images of each other may be as near; of
/// finer ones, faces prove what samples can only support.
const COARSEST: f64 = 1e-4;

impl Shape {
    /// Prepares a surface. `precision` is the absolute error of a coordinate, world units. Returns
    /// `None` when the surface has no triangles or no extent.
    pub fn new(template: &Template, precision: Option<f64>) -> Option<Self> {
        let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let interfaces = Interfaces::new(template);
        let placed = Placed::new(template, &triangles, &interfaces)?;
        let vertices = placed.vertices;
        // Without better knowledge, single precision.
        let precision = precision.unwrap_or(placed.largest * f64::from(f32::EPSILON) / 2.0);
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            double_area_vector(a, b, c).normalize_or_zero()
        };
        let normals = triangles.iter().map(normal).collect();
        let corners = |t: u32| triangles[t as usize].map(|v| vertices[v as usize]);
        let (drawn, samples) = both(
            || Trees::new(&interfaces, corners, |_| 0.0),
            || Samples::new(&vertices, &triangles, &interfaces),
        );
        Some(Self {
            origin: placed.origin,
            scale: placed.scale,
            precision: precision / placed.scale,
            moments: placed.moments,
            samples,
            may_exchange: true,
            told: Told::ByFolds,
            drawn,
            critical: OnceLock::new(),
            behind: Default::default(),
            faces: OnceLock::new(),
            vertices,
            triangles,
            normals,
            interfaces,
        })
    }

    /// Regions in use, outside included.
    pub fn region_count(&self) -> usize {
        self.interfaces.regions.len()
    }

    /// Corners and material sign of every triangle, as the moments want them.
    pub fn signed_triangles(&self) -> impl Iterator<Item = ([DVec3; 3], f64)> + '_ {
        let corners = |t: &[u32; 3]| t.map(|v| self.vertices[v as usize]);
        let signed = self.triangles.iter().enumerate();
        signed.map(move |(i, t)| (corners(t), self.interfaces.sign(i)))
    }

    /// Largest distance of a vertex from the z axis of a frame.
    pub fn radius(&self, frame: &Frame) -> f64 {
        let axis = frame.rotation.z_axis;
        self.vertices
            .iter()
            .map(|p| {
                let d = *p - frame.origin;
                (d - axis * d.dot(axis)).length_squared()
            })
            .fold(0.0, f64::max)
            .sqrt()
    }

    /// The nearest point of the surface to the image of a sample, if nearer than `within`.
    #[inline]
    pub fn nearest(
        &self,
        image: DVec3,
        triangle: u32,
        target: &Target,
        within: f64,
    ) -> Option<Nearest> {
        self.near_enough((image, triangle), target, within, 0.0)
    }

    /// The same, content with any point no farther than `enough`.
    #[inline]
    pub fn near_enough(
        &self,
        (image, triangle): (DVec3, u32),
        target: &Target,
        within: f64,
        enough: f64,
    ) -> Option<Nearest> {
        let part = self.drawn.part(&self.interfaces, triangle, target)?;
        part.answer(part.tree.near_enough(image, within, enough))
    }

    /// The nearest point of the surface to the image of a triangle, whose normal is given, where it faces as that does, up to
    /// the angle between facets of one surface: of solids that touch, each has triangles of its own there. Within the limit
    /// of the shape behind the facets, or of the facets themselves.
    pub fn nearest_alike(
        &self,
        (image, normal): (DVec3, DVec3),
        triangle: u32,
        (limit, is_behind): (f64, bool),
    ) -> Option<Nearest> {
        let target = &Target::Any;
        let (part, within) = match is_behind {
            true => self.part_behind(triangle, target, limit)?,
            false => (self.drawn.part(&self.interfaces, triangle, target)?, limit),
        };
        let alike = |t| self.faces_within(part.triangle(t), (normal, triangle), BENT);
        part.answer(part.tree.nearest_of(image, within, alike))
    }

    /// The nearest point of those facets that the image of a sample may be on, whose shape may be within `limit` of what
    /// the sample's facet hides, and whose normal is about that of the image where one is given.
    pub fn nearest_behind(
        &self,
        (image, normal): (DVec3, Option<DVec3>),
        triangle: u32,
        target: &Target,
        limit: f64,
    ) -> Option<Nearest> {
        let (part, within) = self.part_behind(triangle, target, limit)?;
        part.answer(match normal {
            None => part.tree.nearest(image, within),
            Some(normal) => (part.tree).nearest_of(image, within, |t| {
                self.faces_like(part.triangle(t), (normal, triangle))
            }),
        })
    }

    /// The same of any normal where a triangle is known that did for about the same image, which saves time.
    pub fn nearest_behind_again(
        &self,
        (image, known): (DVec3, u32),
        triangle: u32,
        target: &Target,
        limit: f64,
    ) -> Option<Nearest> {
        let (part, within) = self.part_behind(triangle, target, limit)?;
        let distance = closest_point(image, &self.corners(known)).distance(image) + ARITHMETIC;
        let found = part.tree.nearest_below(image, within, distance);
        // It may be too far by now.
        part.answer(found.or_else(|| part.tree.nearest(image, within)))
    }

    /// The facets that the image of a triangle may be on, and how far from them it may be.
    fn part_behind(&self, triangle: u32, target: &Target, limit: f64) -> Option<(&Part, f64)> {
        let smooth = self.smooth();
        let trees = self.behind[self.told.index()]
            .trees
            .get_or_init(|| Trees::new(&self.interfaces, |t| self.corners(t), |t| smooth.most(t)));
        let part = trees.part(&self.interfaces, triangle, target)?;
        Some((part, limit + smooth.most(triangle)))
    }

    /// Whether a triangle faces where the image of another one does, whose normal then is given: where there is material on
    /// one side only, that is where it is in the image.
    pub fn faces_like(&self, t: u32, image: (DVec3, u32)) -> bool {
        self.faces_within(t, image, SMOOTH_COSINE)
    }

    /// The same up to an angle with this cosine.
    fn faces_within(&self, t: u32, (normal, triangle): (DVec3, u32), least: f64) -> bool {
        let cosine = self.normals[t as usize].dot(normal);
        match self.interfaces.sign(t as usize) * self.interfaces.sign(triangle as usize) {
            0.0 => cosine.abs() >= least,
            sign => sign * cosine >= least,
        }
    }

    /// Critical points of the directional moment of high degree.
    pub fn critical_directions(&self) -> &[DVec3] {
        self.critical
            .get_or_init(|| DirectionalMoment::new(self.signed_triangles()).critical_directions())
    }

    /// The smooth shape that the facets stand for.
    pub fn smooth(&self) -> &SmoothSurface {
        self.behind[self.told.index()].smooth.get_or_init(|| {
            let surface = (&self.vertices[..], &self.triangles[..]);
            SmoothSurface::new(surface, &self.normals, self.told)
        })
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.vertices[v as usize])
    }

    /// Flat faces, where there are any that tell more than samples do.
    pub fn faces(&self) -> Option<&Faces> {
        let make = || {
            let surface = Surface {
                vertices: &self.vertices,
                triangles: &self.triangles,
                sides: &self.interfaces.sides,
                class: &self.interfaces.class,
            };
            let few = self.triangles.len() <= FACES_LOOKED_FOR;
            let told = few && self.rounding() <= COARSEST;
            let exact = Exactness {
                flat: self.rounding(),
                reach: self.same_corner(),
            };
            told.then(|| Faces::new(&surface, &self.normals, exact))?
        };
        self.faces.get_or_init(make).as_ref()
    }

    /// Where images may land before it is known which regions an operation exchanges.
    pub fn target_of_any_exchange(&self) -> Target {
        match self.may_exchange {
            true => Target::Any,
            false => self.target_in_place(),
        }
    }

    /// The target that a permutation of regions asks for.
    pub fn target(&self, permutation: &Permutation) -> Target {
        self.interfaces.target(permutation)
    }

    /// Every region stays where it is.
    pub fn target_in_place(&self) -> Target {
        self.target(&Permutation::identity(self.region_count()))
    }

    /// Deviation that the rounding of coordinates explains.
    pub fn rounding(&self) -> f64 {
        ROUNDINGS * self.precision + ARITHMETIC
    }

    /// Distance up to which corners may be images of each other.
    pub fn same_corner(&self) -> f64 {
        self.rounding().max(SAME_CORNER)
    }

    /// World position of a point.
    pub fn to_world(&self, p: DVec3) -> DVec3 {
        self.origin + self.scale * p
    }

    /// Position of a world point in this frame.
    pub fn of_world(&self, p: DVec3) -> DVec3 {
        (p - self.origin) / self.scale
    }
}

/// A surface moved and scaled into the unit ball.
struct Placed {
    vertices: Vec<DVec3>,
    moments: Moments,
    origin: DVec3,
    scale: f64,
    /// The largest coordinate, world units.
    largest: f64,
}

impl Placed {
    fn new(template: &Template, triangles: &[[u32; 3]], interfaces: &Interfaces) -> Option<Self> {
        let mut used = vec![false; template.vertices.len()];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &v in triangles.iter().flatten() {
            used[v as usize] = true;
            low = low.min(template.vertices[v as usize]);
            high = high.max(template.vertices[v as usize]);
        }
        let half = 0.5 * (high - low).length();
        // Halving before adding keeps enormous coordinates finite.
        let middle = 0.5 * low + 0.5 * high;
        if triangles.is_empty() || !half.is_finite() || half <= 0.0 {
            return None;
        }
        let moments_of = |vertices: &[DVec3]| {
            let corners = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
            let signed = triangles.iter().enumerate();
            Moments::new(signed.map(|(i, t)| (corners(t), interfaces.sign(i))))
        };
        let mut vertices: Vec<DVec3> = (template.vertices.iter().zip(&used))
            .map(|(p, used)| {
                if *used {
                    (*p - middle) / half
                } else {
                    DVec3::ZERO
                }
            })
            .collect();
        let centre = moments_of(&vertices).centre();
        let reach = (vertices.iter().zip(&used))
            .filter(|(_, used)| **used)
            .map(|(p, _)| (*p - centre).length())
            .fold(0.0, f64::max);
        for (p, used) in vertices.iter_mut().zip(&used) {
            if *used {
                *p = (*p - centre) / reach;
            }
        }
        Some(Self {
            moments: moments_of(&vertices),
            vertices,
            origin: middle + half * centre,
            scale: half * reach,
            largest: low.abs().max(high.abs()).max_element(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::prism;

    #[test]
    fn corners_are_told_by_coordinates_that_are_good_enough() {
        let document = prism(12, 1.0, 1.0);
        let has_faces = |precision| {
            let shape = Shape::new(&document.templates[0], Some(precision)).unwrap();
            shape.faces().is_some()
        };
        assert!(has_faces(1e-15) && has_faces(1e-7));
        // A grid would be searched far and wide.
        assert!(!has_faces(1e-3) && !has_faces(1.0));
    }
}
