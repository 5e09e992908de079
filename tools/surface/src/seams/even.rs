//! The guide of a surface with the lengths asked for.

use super::guide::Refined;
use crate::lengths::{Divided, Shared, divided, lengths};
use glam::DVec3;
use mesher::{Climb, Description, Piece, Plc};

/// A template's surface divided into the lengths asked for. `None` where none are, and where facets cannot be triangulated.
pub fn even(climb: &Climb<'_>) -> Option<Refined> {
    let Piece {
        document, index, ..
    } = climb.piece;
    let lengths = lengths(document, climb.sizes, index)?;
    let plc = Plc::new(climb.piece, climb.sizes, Description::PLAIN).ok()?;
    let Divided { template, parents } = divided(climb.piece, &plc, &lengths, Shared::Follow)?;
    let given = climb.piece.template.vertices.len();
    let mut number = vec![u32::MAX; template.vertices.len()];
    let used = plc.vertex_of_point.iter().copied();
    let of_point: Vec<u32> = used.chain(given as u32..number.len() as u32).collect();
    for (i, &v) in (0_u32..).zip(&of_point) {
        number[v as usize] = i;
    }
    let at = |&v: &u32| template.vertices[v as usize];
    let corners = template.triangles.iter().map(|t| t.vertices);
    let parents = parents.iter();
    Some(Refined {
        vertices: of_point.iter().map(at).collect::<Vec<DVec3>>(),
        triangles: corners.map(|t| t.map(|v| number[v as usize])).collect(),
        facet: parents
            .map(|&t| plc.facets.of_triangle[t as usize])
            .collect(),
        vertex_of_point: plc.vertex_of_point,
        facets: plc.facets,
        rounding: plc.rounding,
        advice: None,
        is_uneven: plc.relief.is_there(),
    })
}
