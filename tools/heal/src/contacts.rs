//! How solids that touch or overlap are taken, and what was done to them.

use tmesh::{Document, Template};

/// Which of two solids keeps the space that both claim, where neither lies inside the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overlap {
    /// The one that the file lists later.
    #[default]
    Later,
    /// The one that the file lists earlier.
    Earlier,
    /// None: files with such solids are refused.
    Refuse,
}

/// How solids that touch or overlap are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contacts {
    /// Which of two solids keeps the space that both claim.
    pub overlap: Overlap,
    /// How far apart solids may be, or into each other, that touch, model units; `None` for what their facets explain.
    pub gap: Option<f64>,
}

impl Contacts {
    /// The same, where facets explain no gap.
    pub(crate) fn flat(self) -> Self {
        Self {
            gap: Some(0.0),
            ..self
        }
    }
}

/// What was done to make one body of solids that touch or overlap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joined {
    /// Triangles between solids.
    pub interfaces: usize,
    /// The farthest that a vertex was moved, or a face to a vertex, model units.
    pub largest: f64,
    /// Points that were added where faces cross.
    pub points: usize,
    /// Pairs of solids that claimed the same space.
    pub overlaps: Vec<Claimed>,
    /// The volumes of all solids.
    pub volumes: Vec<Changed>,
    /// The solids as they are drawn, each closed by itself and with its region behind its triangles, where they are
    /// oriented alike. What is symmetric among them need not be so to the bit where they were joined.
    pub drawn: Option<Template>,
    /// Whether the solids are closed shells that were one solid in the file, and are one again.
    pub is_united: bool,
}

/// Space that two solids claimed.
#[derive(Clone, Debug, PartialEq)]
pub struct Claimed {
    /// The solid that has it.
    pub by: String,
    /// The one that it was taken from.
    pub from: String,
    /// Its volume, model units cubed.
    pub volume: f64,
    /// Whether it has it as it lies inside the other one; else as one comes before the other in the file.
    pub nested: bool,
}

/// The volume of a solid before and after.
#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    /// Its name.
    pub name: String,
    /// Its volume in the file, model units cubed.
    pub before: f64,
    /// The volume of its region.
    pub after: f64,
}

impl Joined {
    /// Fills in what volumes have become.
    pub(crate) fn tell_volumes(&mut self, document: &Document) {
        for solid in &mut self.volumes {
            let region = document.regions.iter().find(|r| r.name == solid.name);
            solid.after = region.and_then(|r| r.volume).unwrap_or(solid.before);
        }
    }
}
