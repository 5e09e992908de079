//! Where a template meets its own images or another template.

use crate::Isometry;
use glam::DVec3;

/// A plane `normal . x = offset`; the normal has unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal, pointing out of the template.
    pub normal: DVec3,
    /// Signed distance of the plane from the canonical origin along the normal, in model units.
    pub offset: f64,
}

impl Plane {
    /// Signed distance of a point, positive on the side the normal points to.
    #[inline]
    pub fn distance(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}

/// A cut face on a mirror plane. Its points are their own images, so the mesher may refine it.
#[derive(Clone, Debug, PartialEq)]
pub struct MirrorWall {
    /// Such as `wall-a`.
    pub name: String,
    /// The mirror plane in the canonical frame, normal out of the template.
    pub plane: Plane,
    /// The reflection: instance `g` meets instance `g * reflection` here.
    pub reflection: Isometry,
    /// Vertices on the wall, increasing.
    pub vertices: Vec<u32>,
    /// Triangles on the wall (indices into [`crate::Template::triangles`]), increasing.
    pub triangles: Vec<u32>,
}

/// Two cut faces, low and high, of which the high one is the image of the low one.
///
/// `rotation.apply(vertices[low])` equals `vertices[high]` to the bit in the canonical frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// Such as `seam`; the low face is called `<name>-a`, the high face `<name>-b` on export, those of
    /// `seam` `wall-a` and `wall-b`.
    pub name: String,
    /// Maps the low face onto the high face: instance `g` meets instance `g * rotation` across its
    /// high face.
    pub rotation: Isometry,
    /// Pairs (low vertex, high vertex), increasing in the low vertex. Vertices on the axis are
    /// paired with themselves.
    pub vertex_pairs: Vec<[u32; 2]>,
    /// Pairs (low triangle, high triangle). Both face out of the template, so the image of the low
    /// triangle has the vertices of the high one in reverse orientation.
    pub triangle_pairs: Vec<[u32; 2]>,
}

/// A face shared with another template.
///
/// `placement.apply(other.vertices[b])` equals `vertices[a]` for each pair `[a, b]`, but for rounding:
/// where two copies of the other template meet, a vertex here has two images there.
#[derive(Clone, Debug, PartialEq)]
pub struct HubWall {
    /// Such as `hub`.
    pub name: String,
    /// Index of the other template.
    pub other: u32,
    /// Instance `g` of this template meets instance `g * placement` of the other one.
    pub placement: Isometry,
    /// Pairs (vertex here, vertex of the other template), increasing in the first.
    pub vertex_pairs: Vec<[u32; 2]>,
    /// Pairs (triangle here, triangle of the other template), opposite in orientation.
    pub triangle_pairs: Vec<[u32; 2]>,
}

/// One wall of a template.
#[derive(Clone, Debug, PartialEq)]
pub enum Wall {
    /// A cut face on a mirror plane.
    Mirror(MirrorWall),
    /// A pair of cut faces mapped onto each other by a rotation.
    Seam(Seam),
    /// A face shared with another template.
    Hub(HubWall),
}

impl Wall {
    /// The wall's name.
    pub fn name(&self) -> &str {
        match self {
            Self::Mirror(w) => &w.name,
            Self::Seam(w) => &w.name,
            Self::Hub(w) => &w.name,
        }
    }

    /// All triangles of the template that lie on the wall (both faces of a seam).
    pub fn triangles(&self) -> Box<dyn Iterator<Item = u32> + '_> {
        match self {
            Self::Mirror(w) => Box::new(w.triangles.iter().copied()),
            Self::Seam(w) => Box::new(w.triangle_pairs.iter().flatten().copied()),
            Self::Hub(w) => Box::new(w.triangle_pairs.iter().map(|p| p[0])),
        }
    }

    /// All vertices of the template that lie on the wall; an axis vertex of a seam comes twice.
    pub fn vertices(&self) -> Box<dyn Iterator<Item = u32> + '_> {
        match self {
            Self::Mirror(w) => Box::new(w.vertices.iter().copied()),
            Self::Seam(w) => Box::new(w.vertex_pairs.iter().flatten().copied()),
            Self::Hub(w) => Box::new(w.vertex_pairs.iter().map(|p| p[0])),
        }
    }
}
