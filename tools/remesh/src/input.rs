//! What is to be remeshed, and what must stay.

use glam::DVec3;
use std::sync::Arc;

/// A surface: a complex of triangles, in which more than two may meet at an edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Positions, model units.
    pub points: Vec<DVec3>,
    /// Vertex ids.
    pub triangles: Vec<[u32; 3]>,
    /// What each triangle belongs to: what has different labels stays apart.
    pub labels: Vec<u32>,
}

impl Surface {
    /// Positions of the corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.points[v as usize])
    }
}

/// Links that there may be at most.
pub const MOST_LINKS: usize = u64::BITS as usize;

/// Two faces of a surface of which one is the image of the other, vertex by vertex: what is done to one is done to both.
pub struct Link {
    /// Each vertex with its image.
    pub pairs: Vec<[u32; 2]>,
    /// Labels of the triangles of both faces.
    pub labels: Vec<u32>,
    /// The image of a point.
    pub image: Place,
    /// What a point is the image of.
    pub back: Place,
}

/// Where an isometry takes a point.
pub type Place = Arc<dyn Fn(DVec3) -> DVec3 + Send + Sync>;

/// What must stay, and how far the rest may move.
#[derive(Clone, Copy)]
pub struct Rules<'a> {
    /// Of each vertex, whether it stays as it is; triangles with three such vertices stay, too.
    pub held: &'a [bool],
    /// Of each vertex, the planes and lines that it stays on, a bit each.
    pub bound: &'a [u32],
    /// The nearest point on the plane or line of a bit.
    pub onto: &'a (dyn Fn(u32, DVec3) -> DVec3 + Sync),
    /// Faces that stay images of each other.
    pub links: &'a [Link],
    /// Of each label, the space that its triangles are in: those in different ones never meet. Empty for one of all.
    pub spaces: &'a [u32],
    /// How far the surface may move at most, model units.
    pub deviation: f64,
    /// Of each vertex, how far the surface may move there if that is less, but not less than what may be noise; empty for no less
    /// anywhere.
    pub nearer: &'a [f64],
    /// What is less than this off a plane, or away from each other, may be noise, model units; the deviation at most.
    pub noise: f64,
    /// Within this of a plane, triangles are in one plane, model units.
    pub flat: f64,
    /// Within this of a plane, triangles that hardly fold off it are in one plane, too, model units.
    pub folds: f64,
    /// Cosine of the angle between the normals at a feature edge, from which on it is one.
    pub feature: f64,
    /// The smallest angle asked of elements, radians: no change leaves triangles that meet at an edge in a smaller one where there was none, as no
    /// element at the edge has a larger one.
    pub sharp: f64,
    /// What the triangles of curved patches stand for.
    pub drawn: Drawn,
    /// How long edges are to be.
    pub sizes: Sizes<'a>,
}

/// What the triangles of curved patches stand for, where no lengths are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// Themselves, but for vertices that no facet needs.
    Kept,
    /// Themselves: they stay, unless some are detail beside the edges wanted or narrower than the deviation, and curved patches take less than half of the
    /// triangles without.
    Exactly,
    /// The same in a wedge of several steps of a symmetry about the z axis, whose facets may be there for its sake, as the sides of a prism are: only
    /// triangles that are longest around the axis count among those that the drawing takes.
    ExactlyAbout,
    /// Themselves, but for needles: patches where facets have sharp corners are remeshed, and what is detail.
    WithNeedles,
    /// A shape, which gets edges as long as is wanted.
    Roughly,
}

/// How long edges are to be.
#[derive(Clone, Copy)]
pub struct Sizes<'a> {
    /// The angle by which edges turn along a curved surface, radians; less where the surface has to stay nearer.
    pub turn: f64,
    /// Whether that angle was asked for: then edges get as short as that even where the input's are longer.
    pub turn_is_asked: bool,
    /// Of each label, the length of edges asked for at its triangles, model units; infinite, or not there, for none.
    pub lengths: &'a [f64],
    /// The length of edges asked for at a point, if that changes from place to place.
    pub local: Option<&'a (dyn Fn(DVec3) -> f64 + Sync)>,
    /// By how much lengths of edges grow over a distance, relative to it.
    pub growth: f64,
}

impl Drawn {
    /// Whether the triangles stand for themselves unless that costs too much.
    pub fn is_exact(self) -> bool {
        matches!(self, Self::Exactly | Self::ExactlyAbout)
    }
}

impl Sizes<'_> {
    /// Whether lengths were asked for anywhere.
    pub fn are_asked(&self) -> bool {
        let somewhere = self.lengths.iter().any(|length| length.is_finite());
        self.turn_is_asked || self.local.is_some() || somewhere
    }

    /// Whether lengths were asked for at triangles of a label, so that its curved patches are to have them.
    pub fn are_asked_at(&self, label: u32) -> bool {
        self.turn_is_asked || self.local.is_some() || self.length(label).is_finite()
    }

    /// Longest edge at triangles of a label.
    fn length(&self, label: u32) -> f64 {
        let length = self.lengths.get(label as usize);
        length.copied().unwrap_or(f64::INFINITY)
    }

    /// Longest edge at a point.
    pub fn at(&self, p: DVec3) -> f64 {
        self.local.map_or(f64::INFINITY, |local| local(p))
    }

    /// Longest edge at each vertex of a surface.
    pub fn longest(&self, surface: &Surface) -> Vec<f64> {
        let mut longest: Vec<f64> = surface.points.iter().map(|&p| self.at(p)).collect();
        for (corners, &label) in surface.triangles.iter().zip(&surface.labels) {
            for &v in corners {
                longest[v as usize] = longest[v as usize].min(self.length(label));
            }
        }
        longest
    }
}

impl Rules<'_> {
    /// Whether curved patches of a label get edges as long as is wanted, however they are drawn.
    pub fn remakes(&self, label: u32) -> bool {
        self.drawn == Drawn::Roughly || self.sizes.are_asked_at(label)
    }

    /// How far the surface may move at a vertex of the input, model units.
    pub fn deviation_at(&self, v: usize) -> f64 {
        let nearer = self.nearer.get(v).map(|nearer| nearer.max(self.noise));
        nearer.map_or(self.deviation, |nearer| nearer.min(self.deviation))
    }

    /// The height that triangles have at least whose direction coordinates tell, model units: that of lower ones is uncertain by more than half the angle of
    /// features, so that two of them make one by chance.
    pub fn told(&self) -> f64 {
        self.flat / libm::tan(0.5 * libm::acos(self.feature))
    }

    /// The space that triangles of a label are in.
    pub fn space(&self, label: u32) -> u32 {
        self.spaces.get(label as usize).copied().unwrap_or(0)
    }

    /// The point on all planes and lines of these bits, if one projection to each gets there: to planes that are upright to
    /// each other, and at last to the line that planes meet at.
    pub fn put(&self, bound: u32, p: DVec3) -> Option<DVec3> {
        let bits = (0..u32::BITS).filter(|bit| bound & 1 << bit != 0);
        let place = bits.clone().fold(p, |p, bit| (self.onto)(bit, p));
        let mut each = bits.map(|bit| (self.onto)(bit, place));
        let is_there = each.all(|on| on.distance(place) <= self.flat);
        is_there.then_some(place)
    }
}
