//! One wedge taken out of its context.

use tmesh::{Document, Instance, Isometry};

/// Keeps of every template one instance, at the identity, with its walls and pairs: the piece that
/// was meshed, in its place in the world.
pub fn sector(document: Document) -> Document {
    let instances = (0..document.templates.len() as u32)
        .map(|template| Instance {
            template,
            isometry: Isometry::IDENTITY,
            region_map: 0,
        })
        .collect();
    Document {
        instances,
        region_maps: Vec::new(),
        ..document
    }
}
