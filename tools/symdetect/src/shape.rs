//! The body, made ready for symmetry tests: centred, scaled to unit size, sampled, and searchable.

use crate::faces::{Faces, Surface};
use crate::facets::Facets;
use crate::moments::Moments;
use crate::permutation::Permutation;
use crate::samples::Samples;
use geom::bvh::{Bvh, Nearest};
use glam::{DMat3, DVec3};
use kit::both;
use std::sync::{Arc, OnceLock};
use tmesh::{Frame, OUTSIDE, Template};

/// A surface in coordinates where its centre is the origin and its farthest point is at distance 1.
pub struct Shape {
    /// Vertex positions; those no triangle uses are at the origin.
    pub vertices: Vec<DVec3>,
    /// Vertex ids.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals; zero for triangles without area.
    pub normals: Vec<DVec3>,
    /// Regions before and behind each triangle, as indices into `regions`.
    pub sides: Vec<[u32; 2]>,
    /// Kind of interface of each triangle, an index into `classes`.
    pub class: Vec<u32>,
    /// Pairs of regions that triangles separate, lower index first, increasing.
    pub classes: Vec<[u32; 2]>,
    /// Region ids in use, increasing; the last is [`OUTSIDE`].
    pub regions: Vec<u32>,
    /// World position of the origin.
    pub origin: DVec3,
    /// World length of 1.
    pub scale: f64,
    /// Absolute error of a coordinate in this frame.
    pub precision: f64,
    /// Moments, in this frame.
    pub moments: Moments,
    /// Threads that tests may use.
    pub threads: usize,
    /// Test points.
    pub samples: Samples,
    all: Bvh,
    by_class: Vec<ClassSurface>,
    facets: OnceLock<Facets>,
    faces: OnceLock<Option<Faces>>,
}

/// The triangles of one class.
struct ClassSurface {
    bvh: Bvh,
    /// Index of each of them in the whole surface.
    triangles: Vec<u32>,
}

/// A rigid or improper motion that fixes a point.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Orthogonal matrix.
    pub linear: DMat3,
    /// The fixed point.
    pub centre: DVec3,
}

impl Motion {
    /// The motion that has matrix `canonical` in the frame.
    pub fn new(frame: &Frame, canonical: DMat3) -> Self {
        Self {
            linear: frame.rotation * canonical * frame.rotation.transpose(),
            centre: frame.origin,
        }
    }

    /// Image of a point.
    #[inline]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.centre + self.linear * (p - self.centre)
    }
}

/// What the image of a triangle may land on.
#[derive(Clone, Debug)]
pub enum Target {
    /// Any triangle.
    Any,
    /// Triangles of the class that the list gives for each class; [`NO_CLASS`] where there is none.
    Classes(Arc<[u32]>),
}

/// With fewer triangles, another thread takes longer to start than it saves.
const LARGE: usize = 500;

/// Triangles up to which flat faces are looked for: where there are more, samples tell sooner.
const FACES_LOOKED_FOR: usize = 100_000;
/// Rounding, in the units of the shape, up to which they are: of coarser coordinates, as far away from the origin,
/// corners that are no images of each other may be as near.
const FACES_TOLD: f64 = 1e-4;

/// No interface separates the two regions.
pub const NO_CLASS: u32 = u32::MAX;

impl Shape {
    /// Prepares a surface. `precision` is the absolute error of a coordinate, world units. Returns
    /// `None` when the surface has no triangles or no extent.
    pub fn new(template: &Template, precision: Option<f64>, threads: usize) -> Option<Self> {
        let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
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
        let (regions, sides) = dense_regions(template);
        let outside = regions.len() as u32 - 1;
        let sign = |t: usize| {
            let [front, back] = sides[t];
            f64::from(i8::from(back != outside) - i8::from(front != outside))
        };
        let moments_of = |vertices: &[DVec3]| {
            Moments::new((0..triangles.len()).map(|t| {
                let corners = triangles[t].map(|v| vertices[v as usize]);
                (corners, sign(t))
            }))
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
        let rough = moments_of(&vertices);
        let centre = rough.centre();
        let reach = (vertices.iter().zip(&used))
            .filter(|(_, used)| **used)
            .map(|(p, _)| (*p - centre).length())
            .fold(0.0, f64::max);
        for (p, used) in vertices.iter_mut().zip(&used) {
            if *used {
                *p = (*p - centre) / reach;
            }
        }
        let moments = moments_of(&vertices);
        let scale = half * reach;
        let largest = low.abs().max(high.abs()).max_element();
        // Without better knowledge, single precision.
        let precision = precision.unwrap_or(largest * f64::from(f32::EPSILON) / 2.0) / scale;

        let mut classes: Vec<[u32; 2]> = sides.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        let of_triangle = classes.clone();
        classes.sort_unstable();
        classes.dedup();
        let class: Vec<u32> = of_triangle
            .iter()
            .map(|c| classes.partition_point(|x| x < c) as u32)
            .collect();
        let normals = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| vertices[v as usize]);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect();
        let corners = |t: u32| triangles[t as usize].map(|v| vertices[v as usize]);
        let sample = || {
            let samples = Samples::new(&vertices, &triangles, &class, classes.len());
            (samples, Bvh::new((0..triangles.len() as u32).map(corners)))
        };
        let sort_out = || {
            // Of one kind are all.
            let kinds = if classes.len() > 1 { classes.len() } else { 0 };
            let mut members = vec![Vec::new(); kinds];
            for (t, &c) in class.iter().enumerate() {
                if let Some(members) = members.get_mut(c as usize) {
                    members.push(t as u32);
                }
            }
            let surface = |members: Vec<u32>| ClassSurface {
                bvh: Bvh::new(members.iter().map(|&t| corners(t))),
                triangles: members,
            };
            members.into_iter().map(surface).collect()
        };
        let few = triangles.len() < LARGE || classes.len() < 2;
        let (by_class, (samples, all)) = both(if few { 1 } else { threads }, sort_out, sample);
        Some(Self {
            origin: middle + half * centre,
            scale,
            precision,
            moments,
            threads,
            samples,
            all,
            by_class,
            facets: OnceLock::new(),
            faces: OnceLock::new(),
            vertices,
            triangles,
            normals,
            sides,
            class,
            classes,
            regions,
        })
    }

    /// Corners and material sign of every triangle, as the moments want them.
    pub fn signed_triangles(&self) -> impl Iterator<Item = ([DVec3; 3], f64)> + '_ {
        let outside = self.regions.len() as u32 - 1;
        self.triangles.iter().zip(&self.sides).map(move |(t, s)| {
            let sign = f64::from(i8::from(s[1] != outside) - i8::from(s[0] != outside));
            (t.map(|v| self.vertices[v as usize]), sign)
        })
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
        self.near_enough(image, triangle, target, within, 0.0)
    }

    /// The same, content with any point no farther than `enough`.
    #[inline]
    pub fn near_enough(
        &self,
        image: DVec3,
        triangle: u32,
        target: &Target,
        within: f64,
        enough: f64,
    ) -> Option<Nearest> {
        match target {
            Target::Classes(map) if !self.by_class.is_empty() => {
                let class = map[self.class[triangle as usize] as usize];
                let surface = self.by_class.get(class as usize)?;
                let mut hit = surface.bvh.near_enough(image, within, enough)?;
                hit.triangle = surface.triangles[hit.triangle as usize];
                Some(hit)
            }
            _ => self.all.near_enough(image, within, enough),
        }
    }

    /// What the facets may hide.
    pub fn facets(&self) -> &Facets {
        let make = || Facets::new(&self.vertices, &self.triangles, &self.normals);
        self.facets.get_or_init(make)
    }

    /// Flat faces, where there are any that tell more than samples do.
    pub fn faces(&self) -> Option<&Faces> {
        let make = || {
            let surface = Surface {
                vertices: &self.vertices,
                triangles: &self.triangles,
                sides: &self.sides,
                class: &self.class,
            };
            let few = self.triangles.len() <= FACES_LOOKED_FOR;
            let told = few && self.rounding() <= FACES_TOLD;
            told.then(|| Faces::new(&surface, &self.normals, self.rounding()))?
        };
        self.faces.get_or_init(make).as_ref()
    }

    /// The target that a permutation of regions asks for.
    pub fn target(&self, permutation: &Permutation) -> Target {
        if self.by_class.is_empty() {
            return Target::Any;
        }
        let image = |c: &[u32; 2]| {
            let [a, b] = c.map(|r| permutation.get(r));
            let key = [a.min(b), a.max(b)];
            self.classes
                .binary_search(&key)
                .map_or(NO_CLASS, |i| i as u32)
        };
        Target::Classes(self.classes.iter().map(image).collect())
    }

    /// Deviation that the rounding of coordinates explains.
    pub fn rounding(&self) -> f64 {
        8.0 * self.precision + 1e-12
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

impl Moments {
    /// Centre of the volume, or of the surface when it encloses hardly any.
    pub fn centre(&self) -> DVec3 {
        if self.volume > 1e-9 * self.area {
            self.volume_centre
        } else {
            self.area_centre
        }
    }
}

/// Region ids in use, increasing and with [`OUTSIDE`] last, and the sides of every triangle as
/// indices into them.
fn dense_regions(template: &Template) -> (Vec<u32>, Vec<[u32; 2]>) {
    let mut regions: Vec<u32> = Vec::new();
    let mut last = OUTSIDE;
    for t in &template.triangles {
        for r in [t.front, t.back] {
            if r != last && r != OUTSIDE {
                regions.push(r);
                last = r;
            }
        }
    }
    regions.push(OUTSIDE);
    regions.sort_unstable();
    regions.dedup();
    let index = |r: u32| regions.partition_point(|&x| x < r) as u32;
    let sides = template
        .triangles
        .iter()
        .map(|t| [index(t.front), index(t.back)])
        .collect();
    (regions, sides)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::prism;

    #[test]
    fn corners_are_told_by_coordinates_that_are_good_enough() {
        let document = prism(12, 1.0, 1.0);
        let has_faces = |precision| {
            let shape = Shape::new(&document.templates[0], Some(precision), 1).unwrap();
            shape.faces().is_some()
        };
        assert!(has_faces(1e-15) && has_faces(1e-7));
        // A grid would be searched far and wide.
        assert!(!has_faces(1e-3) && !has_faces(1.0));
    }
}
