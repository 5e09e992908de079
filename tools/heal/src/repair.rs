//! What is done to a surface that is not as it should be.

use crate::contacts::Contacts;
use crate::words::{place, short};
use glam::DVec3;
use interchange::text::counted;

/// Whether what a file holds may be changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Repairing {
    /// What is wrong is repaired where that needs no guess, and solids that touch or overlap become one body.
    Auto(Contacts),
    /// Nothing is moved, stitched or dropped: what would have to be is an error.
    Off,
}

impl Default for Repairing {
    fn default() -> Self {
        Self::Auto(Contacts::default())
    }
}

/// A kind of repair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RepairKind {
    /// Triangles with two equal corners, dropped.
    Collapsed,
    /// Triangles that a solid has more than once, dropped but for one, or all where they cancel.
    Repeated,
    /// Points joined to others across gaps of the surface.
    Joined,
    /// Edges divided at the corners that lie on them, across gaps of the surface.
    Stitched,
    /// Triangles without area, removed without opening the surface.
    Flat,
}

/// The words for each kind: its name, what there is one of or many of, and what was done.
type Words = (&'static str, &'static str, &'static str, &'static str);

impl RepairKind {
    fn words(self) -> Words {
        match self {
            Self::Collapsed => (
                "collapsed-triangles",
                "triangle with two equal corners",
                "triangles with two equal corners",
                "dropped",
            ),
            Self::Repeated => (
                "repeated-triangles",
                "triangle that the surface has twice",
                "triangles that the surface has twice",
                "dropped",
            ),
            Self::Joined => (
                "joined-points",
                "point beside another one",
                "points beside other ones",
                "joined, which closes the surface",
            ),
            Self::Stitched => (
                "stitched-corners",
                "corner on an edge",
                "corners on edges",
                "stitched, which closes the surface",
            ),
            Self::Flat => (
                "flat-triangles",
                "triangle without area",
                "triangles without area",
                "removed",
            ),
        }
    }
}

/// One kind of repair of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Repair {
    /// What was repaired.
    pub kind: RepairKind,
    /// How many there were.
    pub count: usize,
    /// The farthest that a point of the surface was moved, model units.
    pub largest: f64,
    /// Where that was, or where the first one was if nothing moved.
    pub place: DVec3,
}

impl Repair {
    /// A repair that moves nothing, the first of them at `place`.
    pub fn in_place(kind: RepairKind, count: usize, place: DVec3) -> Self {
        Self {
            kind,
            count,
            largest: 0.0,
            place,
        }
    }

    /// Adds what was done of the same kind elsewhere.
    pub fn add(&mut self, other: &Self) {
        self.count += other.count;
        if other.largest > self.largest {
            (self.largest, self.place) = (other.largest, other.place);
        }
    }

    /// A name for reports.
    pub fn name(&self) -> &'static str {
        self.kind.words().0
    }

    /// What was found: how many, how wide and where.
    fn found(&self) -> String {
        let (_, one, many, _) = self.kind.words();
        let what = counted(self.count, one, many);
        match self.largest > 0.0 {
            true => format!(
                "{what} (the widest gap is {} at {})",
                short(self.largest),
                place(self.place)
            ),
            false => what,
        }
    }

    /// What was found and what was done.
    pub fn sentence(&self) -> String {
        format!("{}: {}", self.found(), self.kind.words().3)
    }

    /// Why a file that needs this is refused where nothing may be changed.
    pub fn refusal(&self) -> String {
        let (_, one, many, done) = self.kind.words();
        format!(
            "{}, the first at {}, and with --repair off none is {}",
            counted(self.count, one, many),
            place(self.place),
            done.split(',').next().unwrap_or(done)
        )
    }
}
