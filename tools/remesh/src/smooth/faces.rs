//! Flat faces among facets.

use super::sheets::Sheets;
use crate::shape::{ALIKE, Beside, Beyond, Facets};
use geom::edges::EdgeUse;

/// Of each facet, whether it is a flat face of the shape and does not stand for something curved. As for remeshing
/// ([`crate::shape::Patches`]), but that a low ring of facets is curved as well, where little of the outline is smooth: facets
/// that go on smoothly on both sides, and with their like wherever they do. What turns by less than a degree is curved however wide it is, as
/// nothing tells here what may be noise: where it is flat, the points in the middles of its edges hardly move.
pub fn flat_faces(sheets: &Sheets<'_>, facet: &[u32], count: usize) -> Vec<bool> {
    let mate = |edge: usize, u: &EdgeUse| {
        let mate = sheets.mate(u.triangle, u.corner.into())?;
        let is_it = |v: &&EdgeUse| (v.triangle, v.corner.into()) == (mate.triangle, mate.corner);
        sheets.edges.around(edge).iter().find(is_it).copied()
    };
    let facets = Facets {
        points: sheets.points,
        triangles: sheets.triangles,
        normals: &sheets.normals,
        edges: &sheets.edges,
        of: facet,
        rise: f64::INFINITY,
    };
    let is_face = |beside: &Beside| match beside.triangles {
        1 => beside.smooth == 0.0,
        _ => {
            let in_ring = beside.more && beside.like == beside.smooth;
            beside.like <= ALIKE * beside.border && !in_ring
        }
    };
    let beside = facets.beside(count, mate, &Beyond::default());
    beside.iter().map(is_face).collect()
}
