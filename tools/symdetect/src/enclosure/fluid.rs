//! The space around a body without the body: what flows through the passages between blades.

use super::surface::Part;
use rustc_hash::FxHashSet;
use tmesh::{Document, Group, OUTSIDE, Symmetry};

/// What a part of the outer boundary is called, where flow is to enter and to leave: the ends have one name if the group
/// takes either to the other.
pub fn name_of(part: Part, group: Group) -> &'static str {
    let turns_over = group.elements().any(|g| g.flipped());
    match part {
        Part::Side => "side",
        _ if turns_over => "ends",
        Part::Below => "below",
        Part::Above => "above",
    }
}

/// Leaves out all regions but one. Triangles that have it on one side become its boundary and keep their markers; the
/// others, vertices that none of those has, and markers of nothing are dropped. The region goes to itself under every
/// operation.
pub fn keep_only(document: &mut Document, symmetry: &mut Symmetry, region: u32) {
    let template = &mut document.templates[0];
    for t in &mut template.triangles {
        for side in [&mut t.front, &mut t.back] {
            if *side != region {
                *side = OUTSIDE;
            }
        }
    }
    template.triangles.retain(|t| t.front != t.back);
    let mut new = vec![None; template.vertices.len()];
    let mut kept = Vec::new();
    for v in template.triangles.iter_mut().flat_map(|t| &mut t.vertices) {
        let id = *new[*v as usize].get_or_insert_with(|| {
            kept.push(template.vertices[*v as usize]);
            kept.len() as u32 - 1
        });
        *v = id;
    }
    template.vertices = kept;
    document.regions.retain(|r| r.id == region);
    let used: FxHashSet<u32> = template.triangles.iter().map(|t| t.marker).collect();
    document.markers.retain(|m| used.contains(&m.id));
    for map in &mut symmetry.regions {
        map.pairs.clear();
    }
}
