//! Templates whose surface has the lengths asked for already, which may be filled with no vertices added to it.
//!
//! The mesher keeps all edges of a curved surface, and refuses any vertex inside of the sphere around one of them: it halves the
//! edge instead. Of triangles with sides of one length, the middle of a side is inside of the spheres around the longer ones, so that a
//! single obtuse triangle, or a single vertex wanted near a thin wall, has most of the edges of the surface halved.

use crate::draws::has_lengths;
use crate::lengths::{Divided, Lengths, divided};
use mesher::{Climb, Description, Plc};
use tmesh::Template;

/// The surface to keep, where a filled template has shorter edges than asked for in the mean, so that the mesher may have halved edges
/// for nothing: what is flat has the lengths asked for then.
pub fn to_keep(climb: &Climb<'_>, filled: &Template) -> Option<Divided> {
    let lengths = lengths(climb)?;
    // Otherwise the mesher has not halved edges for nothing.
    mean_edge(&lengths, filled).filter(|&mean| mean < 1.0)?;
    let plc = Plc::new(climb.piece, climb.sizes, Description::PLAIN).ok()?;
    match plc.faces.preserve() {
        true => None,
        false => divided(climb.piece, &plc, &lengths),
    }
}

/// Length asked for in each region, model units, unless sizes change from place to place, which may want the surface divided.
pub fn lengths(climb: &Climb<'_>) -> Option<Lengths> {
    let regions = climb.piece.document.regions.iter();
    let each = regions.zip(&climb.sizes.lengths);
    let known: Lengths = each
        .filter_map(|(r, &length)| Some((r.id, length?)))
        .collect();
    let is_even = climb.sizes.local[climb.piece.index].is_none();
    (is_even && has_lengths(climb)).then_some(known)
}

/// Mean length of edges over the one asked for, where all regions have one; elements count their six edges.
pub fn mean_edge(lengths: &Lengths, template: &Template) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for tet in &template.tets {
        let length = lengths.get(&tet.region)?;
        let corners = tet.vertices.map(|v| template.vertices[v as usize]);
        for i in 0..4 {
            for j in 0..i {
                sum += corners[i].distance(corners[j]) / length;
                count += 1.0;
            }
        }
    }
    (count > 0.0).then(|| sum / count)
}
