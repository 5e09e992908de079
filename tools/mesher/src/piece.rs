//! What is meshed: a template where it stands in its document.

use crate::faces::face_key;
use tmesh::{Document, Template};

/// A template of a document, or a surface that is to take its place there.
#[derive(Clone, Copy)]
pub struct Piece<'a> {
    /// The document, for what surrounds the template.
    pub document: &'a Document,
    /// The template's number.
    pub index: usize,
    /// The template as it is to be meshed.
    pub template: &'a Template,
    /// Of each triangle, whether it is in a facet with others only where it is in a plane with them; empty where that is none.
    pub apart: &'a [bool],
}

impl<'a> Piece<'a> {
    /// A template as the document has it.
    pub fn of(document: &'a Document, index: usize) -> Self {
        Self {
            document,
            index,
            template: &document.templates[index],
            apart: &[],
        }
    }

    /// Whether a face, by its key, is one that another template has, too.
    pub fn shares(&self, face: u32) -> bool {
        face >= face_key(self.template.gluings.len(), false)
    }
}
