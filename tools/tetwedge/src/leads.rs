//! Which template leads, and which follows.

use mesher::leads;
use tmesh::Document;

/// The template that has to be meshed before this one, whose hub walls are given what came of it.
pub fn leader(document: &Document, index: usize) -> Option<usize> {
    let mut others = document.templates[index]
        .gluings
        .iter()
        .filter_map(|gluing| gluing.other_than(index));
    let first = others.next()?;
    (others.all(|o| o == first) && leads(document, first)).then_some(first)
}
