//! Templates whose surface has the lengths asked for already, which may be filled with no vertices added to it.
//!
//! The mesher keeps all edges of a curved surface, and refuses any vertex inside of the sphere around one of them: it halves the
//! edge instead. Of triangles with sides of one length, the middle of a side is inside of the spheres around the longer ones, so that a
//! single obtuse triangle, or a single vertex wanted near a thin wall, has most of the edges of the surface halved.

use mesher::{Climb, Description, Plc};
use surface::{Divided, Shared, divided, lengths, mean_edge};
use tmesh::Template;

/// The surface to keep, where a filled template has shorter edges than asked for in the mean, so that the mesher may have halved edges
/// for nothing: what is flat has the lengths asked for then.
pub fn to_keep(climb: &Climb<'_>, filled: &Template) -> Option<Divided> {
    let piece = climb.piece;
    let lengths = lengths(piece.document, climb.sizes, piece.index)?;
    // Otherwise the mesher has not halved edges for nothing.
    mean_edge(&lengths, &filled.vertices, &filled.tets).filter(|&mean| mean < 1.0)?;
    let plc = Plc::new(piece, climb.sizes, Description::PLAIN).ok()?;
    match plc.faces.preserve() {
        true => None,
        false => divided(climb.piece, &plc, &lengths, Shared::Stay),
    }
}
