//! Which template leads, and which follows.

use mesher::leads;
use tmesh::{Document, Wall};

/// The template that has to be meshed before this one, whose hub walls are given what came of it.
pub fn leader(document: &Document, index: usize) -> Option<usize> {
    let mut others = document.templates[index]
        .walls
        .iter()
        .filter_map(|w| match w {
            Wall::Hub(hub) => Some(hub.other as usize),
            _ => None,
        });
    let first = others.next()?;
    (others.all(|o| o == first) && leads(document, first)).then_some(first)
}
