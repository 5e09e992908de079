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

/// Puts the tetrahedra of each region of a template together, in the order of region ids, for
/// formats that list elements by region. The order within a region stays.
pub fn sort_by_region(document: &mut Document) {
    for template in &mut document.templates {
        if !template.tets.is_sorted_by_key(|tet| tet.region) {
            template.tets.sort_by_key(|tet| tet.region);
        }
    }
}
