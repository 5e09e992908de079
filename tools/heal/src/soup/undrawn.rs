//! Solids that can be made one body in another way than they were.

use super::imprinted::Divided;
use super::solids::{Labels, tables};
use super::surface::Surface;
use crate::contacts::Joined;
use crate::document::{Imported, document};
use crate::{HealError, Repair};
use tmesh::Document;

/// What is the same of a surface however its solids are made one body.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The name of the format.
    pub format: String,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// What the user should know, a sentence each.
    pub notices: Vec<String>,
    /// What was repaired.
    pub repairs: Vec<Repair>,
}

impl Reading {
    /// The document of a surface with its sides, and what was done for that.
    ///
    /// # Errors
    /// A region without volume.
    pub fn finished(
        mut self,
        (surface, mut labels): (Surface, Labels),
        mut joined: Option<Joined>,
    ) -> Result<Imported, HealError> {
        let is_apart = labels.is_apart;
        self.notices.append(&mut labels.notices);
        let mut labelled = tables(surface, labels);
        labelled.relative_precision = self.relative_precision;
        labelled.notices = self.notices;
        labelled.repairs = self.repairs;
        let mut imported = document(labelled, &self.format)?;
        if let Some(joined) = &mut joined {
            joined.tell_volumes(&imported.document);
        }
        imported.joined = joined;
        imported.is_apart = is_apart;
        Ok(imported)
    }
}

/// Solids with curved faces that touch, of which the facets of both were divided at each other. Where they are drawn alike all around, the outcome is as
/// well; otherwise those of one solid may stand for both, which leaves no finer detail.
#[derive(Clone, Debug)]
pub struct Undrawn {
    reading: Reading,
    divided: Divided,
    /// The single solid that the solids are parts of, if they are.
    whole: Option<Surface>,
}

impl Undrawn {
    /// Of solids that were read so; what was said of that is not said again.
    pub fn new(reading: &Reading, divided: Divided, whole: Option<Surface>) -> Self {
        let reading = Reading {
            notices: Vec::new(),
            repairs: Vec::new(),
            ..reading.clone()
        };
        Self {
            reading,
            divided,
            whole,
        }
    }

    /// A document as it was read of these solids, with the facets of one solid for both where curved faces touch, and what is told of that; `None` where
    /// that cannot be. Linear, but for the search for what is near.
    pub fn draw_once(&self, read: &Document) -> Option<Imported> {
        let mut made = self.divided.drawn_once()?;
        if let Some(whole) = &self.whole {
            made = made.united(whole);
        }
        let reading = self.reading.clone();
        let once = reading.finished((made.surface, made.labels), Some(made.joined));
        let mut once = once.ok()?;
        let Document {
            templates,
            mut regions,
            markers,
            source,
            ..
        } = once.document;
        for region in &mut regions {
            let known = read.regions.iter().find(|r| r.name == region.name);
            region.size = known.and_then(|r| r.size);
        }
        once.document = Document {
            templates,
            regions,
            markers,
            source,
            ..read.clone()
        };
        Some(once)
    }
}
