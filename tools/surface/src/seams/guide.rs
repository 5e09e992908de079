//! The guide: the surface of a template after TetGen refined it freely, walls included.

use crate::coarse::{Left, coarsened};
use glam::DVec3;
use improve::Leaves;
use mesher::{
    Answer, Asks, Attempt, Climb, Description, EASING, Error, Facets, Place, label, settled,
};
use std::convert::Infallible;

/// What a surface is divided by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guide {
    /// A free pass of the mesher.
    Mesher,
    /// The lengths of edges asked for, where they can be had.
    Lengths,
}

/// A refined surface.
pub struct Refined {
    /// Positions, canonical frame, model units: those of the template's vertices that its triangles
    /// use, then new ones.
    pub vertices: Vec<DVec3>,
    /// Template vertex of each of the first vertices.
    pub vertex_of_point: Vec<u32>,
    /// Vertex ids, counter-clockwise seen from the front region.
    pub triangles: Vec<[u32; 3]>,
    /// Facet of each triangle.
    pub facet: Vec<u32>,
    /// Facets of the template's own triangles.
    pub facets: Facets,
    /// What computing may lose, model units.
    pub rounding: f64,
    /// What became of the bounds, if they could not be met.
    pub advice: Option<String>,
    /// Whether any facet is uneven.
    pub is_uneven: bool,
}

/// Meshes a template as asked for, but free to put points on every facet, and gives
/// the surface of that mesh. No facet joins wall faces with anything else, nor the two faces of a
/// seam. `description`: of the first attempt; others follow where the mesher fails.
///
/// # Errors
/// See [`Error`].
pub fn refine(climb: &Climb<'_>, description: Description) -> Result<Refined, Error> {
    let free = Climb {
        preserve: false,
        ..*climb
    };
    // The mesher is given eased bounds again when it fills this surface, and a guide that insists on more only multiplies
    // points.
    let [ratio, angle] = EASING;
    let asks = Asks::Eased([ratio * ratio, angle]);
    let first = Attempt {
        description,
        ..Attempt::new(asks)
    };
    free.climb(first, |answer| surface_of(climb, answer))
}

/// The surface of the mesher's answer.
fn surface_of(climb: &Climb<'_>, answer: Answer) -> Result<Refined, Error> {
    let unusable = |what: String| Error::Unusable {
        template: climb.piece.index,
        what,
    };
    if !answer.keeps_points() {
        return Err(unusable("input points were moved or left out".to_owned()));
    }
    let cells = label(&answer.plc, &*answer.mesh).map_err(|c| {
        let place = Place(answer.plc.to_model(c.place));
        unusable(format!("there are {} near {place}", c.what))
    })?;
    // This surface stays, so that what is past the bound at it does.
    let [ratio, _] = EASING;
    let Left { surface, .. } = coarsened(climb, &answer, cells, Leaves::Within(ratio));
    let Answer {
        plc, mesh, advice, ..
    } = answer;
    let template = climb.piece.template;
    let mut refined = Refined {
        vertices: mesh
            .points()
            .iter()
            .enumerate()
            .map(|(i, p)| match plc.vertex_of_point.get(i) {
                Some(&v) => template.vertices[v as usize],
                None => plc.to_model(*p),
            })
            .collect(),
        triangles: surface.iter().map(|s| s.triangle.vertices).collect(),
        facet: surface.iter().map(|s| s.facet as u32).collect(),
        vertex_of_point: plc.vertex_of_point,
        facets: plc.facets,
        rounding: plc.rounding,
        advice,
        is_uneven: plc.relief.is_there(),
    };
    put_back(&mut refined, plc.shift);
    let first_new = refined.vertex_of_point.len() as u32;
    let facets = refined.facet.iter().map(|&f| f as usize);
    let triangles = refined.triangles.iter().copied().zip(facets);
    for (v, there) in plc.relief.places(&refined.vertices, triangles) {
        if v >= first_new {
            refined.vertices[v as usize] = there;
        }
    }
    Ok(refined)
}

/// Puts new vertices back onto the planes of their facets: of those that the mesher got shifted by `shift` (model
/// units; see [`mesher::Plc`]), and of uneven ones where it has left them. The mesher takes circumcentres of
/// triangles there, and the plane of a needle between three points that are nearly in the facet's plane may be
/// any.
fn put_back(refined: &mut Refined, shift: f64) {
    let first_new = refined.vertex_of_point.len();
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for (t, &f) in refined.triangles.iter().zip(&refined.facet) {
        if refined.facets.facets[f as usize].normal != DVec3::ZERO {
            let new = t.iter().filter(|&&v| v as usize >= first_new);
            pairs.extend(new.map(|&v| (v, f)));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    for of_vertex in pairs.chunk_by(|a, b| a.0 == b.0) {
        // What is on several facets is on an edge.
        let &[(v, f)] = of_vertex else { continue };
        let facet = &refined.facets.facets[f as usize];
        let p = &mut refined.vertices[v as usize];
        let off = (*p - facet.origin).dot(facet.normal);
        if off.abs() > facet.deviation + refined.rounding {
            *p -= facet.normal * off;
        }
    }
    if shift == 0.0 {
        return;
    }
    // Facets more uneven than the shift have no plane to be put back onto.
    pairs.retain(|&(_, f)| refined.facets.facets[f as usize].deviation <= shift);
    for of_vertex in pairs.chunk_by(|a, b| a.0 == b.0) {
        let p = &mut refined.vertices[of_vertex[0].0 as usize];
        let onto = |i: usize, p: DVec3| -> Result<DVec3, Infallible> {
            let facet = &refined.facets.facets[of_vertex[i].1 as usize];
            Ok(p - facet.normal * (p - facet.origin).dot(facet.normal))
        };
        let Ok(there) = settled(*p, of_vertex.len(), onto);
        *p = there;
    }
}
