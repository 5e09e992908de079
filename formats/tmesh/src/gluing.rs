//! Where a template meets its own images or another template.

use crate::{FixedSet, Isometry};
use glam::DVec3;

/// A plane `normal . x = 0` through the origin; the normal has unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal.
    pub normal: DVec3,
}

impl Plane {
    /// The plane that a reflection fixes; `None` for other isometries. The normal is the one for which
    /// the template of a wedge between the angle 0 and that of the plane lies behind it, where it is
    /// vertical, and points downwards where it is horizontal.
    pub fn of_reflection(reflection: Isometry) -> Option<Self> {
        if reflection == Isometry::FLIP {
            return Some(Self {
                normal: DVec3::NEG_Z,
            });
        }
        // The reflection by k / n of a turn fixes the plane at half that angle.
        reflection.is_reflection().then(|| {
            let (cos, sin) = reflection.half_angle();
            Self {
                normal: DVec3::new(-sin, cos, 0.0),
            }
        })
    }

    /// Signed distance of a point, positive on the side the normal points to.
    #[inline]
    pub fn distance(&self, p: DVec3) -> f64 {
        self.normal.dot(p)
    }
}

/// A face at which instance `g` of a template meets instance `g * step` of the template `other`.
///
/// One relation serves for all faces inside the body, by one invariant: `step` takes the face there
/// onto the face here, `step.apply(other.vertices[there]) == vertices[here]` for every pair
/// `[here, there]`, to the bit in the canonical frame where both are different vertices of one
/// template, and within rounding elsewhere (a mirror plane at an arbitrary angle; the face of another
/// template of which two copies meet in a vertex here). Usual are:
///
/// - a *mirror wall*: `other` is the template itself, `step` the reflection in the face's plane, and
///   everything is paired with itself. Whoever divides the face divides its image with it;
/// - a *seam*: two faces of the template, of which `step` takes the low one (there) onto the high one
///   (here). It is listed once: across the low face instance `g` meets `g * step^-1`. What lies on the
///   axis of the step is paired with itself. The two halves of a face that a half turn exchanges are
///   a seam;
/// - a *hub wall*: a face of another template.
#[derive(Clone, Debug, PartialEq)]
pub struct Gluing {
    /// Such as `wall-a`.
    pub name: String,
    /// Index of the template on the other side, which may be the same.
    pub other: u32,
    /// Takes the face there onto the face here.
    pub step: Isometry,
    /// Vertices here and there, increasing in the first.
    pub vertex_pairs: Vec<[u32; 2]>,
    /// Triangles here and there, increasing in the first. Both face out of their templates, so the
    /// image of the one there has the vertices of the one here in reverse orientation.
    pub triangle_pairs: Vec<[u32; 2]>,
}

impl Gluing {
    /// A mirror wall of template `own`; vertices and triangles increasing.
    pub fn mirror(
        name: &str,
        own: u32,
        reflection: Isometry,
        vertices: impl IntoIterator<Item = u32>,
        triangles: impl IntoIterator<Item = u32>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            other: own,
            step: reflection,
            vertex_pairs: vertices.into_iter().map(|v| [v, v]).collect(),
            triangle_pairs: triangles.into_iter().map(|t| [t, t]).collect(),
        }
    }

    /// A seam of template `own`, whose step takes the low face onto the high one; pairs `[low, high]` in
    /// any order.
    pub fn seam(
        name: &str,
        own: u32,
        step: Isometry,
        vertex_pairs: impl IntoIterator<Item = [u32; 2]>,
        triangle_pairs: impl IntoIterator<Item = [u32; 2]>,
    ) -> Self {
        let turned = |[low, high]: [u32; 2]| [high, low];
        let mut seam = Self {
            name: name.to_owned(),
            other: own,
            step,
            vertex_pairs: vertex_pairs.into_iter().map(turned).collect(),
            triangle_pairs: triangle_pairs.into_iter().map(turned).collect(),
        };
        seam.sort();
        seam
    }

    /// Puts the pairs in order.
    pub fn sort(&mut self) {
        self.vertex_pairs.sort_unstable();
        self.triangle_pairs.sort_unstable();
    }

    /// Whether the face is its own image, point by point. `own` is the template that lists it.
    pub fn is_mirror(&self, own: usize) -> bool {
        self.other as usize == own && self.step.is_reflection()
    }

    /// Whether both faces are of the template `own`, and different ones.
    pub fn is_seam(&self, own: usize) -> bool {
        self.other as usize == own && !self.step.is_reflection()
    }

    /// Whether it joins copies of the template, number `own`, at the axis: vertices there are paired with themselves.
    pub fn joins_at_axis(&self, own: usize) -> bool {
        self.is_seam(own) && FixedSet::of(self.step) == FixedSet::Axis
    }

    /// The template beyond if it is not `own`, the one that lists the face.
    pub fn other_than(&self, own: usize) -> Option<usize> {
        let other = self.other as usize;
        (other != own).then_some(other)
    }

    /// Vertices of the face here, increasing.
    pub fn vertices_here(&self) -> impl ExactSizeIterator<Item = u32> {
        self.vertex_pairs.iter().map(|p| p[0])
    }

    /// Vertices of the face there, in the order of their partners.
    pub fn vertices_there(&self) -> impl ExactSizeIterator<Item = u32> {
        self.vertex_pairs.iter().map(|p| p[1])
    }

    /// Triangles of the face here, increasing.
    pub fn triangles_here(&self) -> impl ExactSizeIterator<Item = u32> {
        self.triangle_pairs.iter().map(|p| p[0])
    }

    /// Triangles of the face there, in the order of their partners.
    pub fn triangles_there(&self) -> impl ExactSizeIterator<Item = u32> {
        self.triangle_pairs.iter().map(|p| p[1])
    }

    /// All triangles of the template `own` that the gluing is about, each once: both faces of a seam.
    pub fn triangles_of(&self, own: usize) -> impl Iterator<Item = u32> {
        let both = self.is_seam(own);
        let there = self.triangles_there().filter(move |_| both);
        self.triangles_here().chain(there)
    }

    /// All vertices of the template `own` that the gluing is about; those that a seam pairs with
    /// themselves come twice.
    pub fn vertices_of(&self, own: usize) -> impl Iterator<Item = u32> {
        let both = self.is_seam(own);
        let there = self.vertices_there().filter(move |_| both);
        self.vertices_here().chain(there)
    }

    /// The mirror plane of a mirror wall of template `own`, its normal out of the template if that is a
    /// wedge with angles from 0, or lies above z = 0.
    pub fn mirror_plane(&self, own: usize) -> Option<Plane> {
        if !self.is_mirror(own) {
            return None;
        }
        let plane = Plane::of_reflection(self.step)?;
        // The wedge begins at the plane y = 0.
        let first = self.step == Isometry::MIRROR;
        let normal = if first { -plane.normal } else { plane.normal };
        Some(Plane { normal })
    }
}
