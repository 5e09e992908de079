//! The guide: the surface of a template after TetGen refined it freely, walls included.

use glam::DVec3;
use mesher::{
    Answer, Asks, Cells, Climb, Error, Facets, Judged, PROJECTIONS, Place, ROUNDING, label,
};

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
}

/// How much the radius-edge bound is eased for the guide. What is asked for is reached afterwards, when
/// the template is filled and its worst elements are improved, and a guide that insists on it only multiplies
/// points: on wheels of saw teeth (orders 2 to 30, bound 1.4) this takes up to a quarter of the elements away
/// and leaves at most 1.7 % past the bound.
pub const EASED: f64 = 1.12;

/// With this part of the guide's tetrahedra past the eased bound and more, the shape does not allow
/// much better elements near its sharp places, and the bound itself leaves fewer past it ...
const SHARP: f64 = 0.005;

/// ... up to this part: of such shapes the mesh of the whole body has a tenth of its elements past the
/// bound too, and insisting only multiplies points.
const HARD: f64 = 0.05;

/// Fewer tetrahedra past the bound are not worth another guide.
const FEW: f64 = 4.0;

/// Meshes a template as asked for, but free to put points on every facet, and gives
/// the surface of that mesh. No facet joins wall faces with anything else, nor the two faces of a
/// seam.
///
/// # Errors
/// See [`Error`].
pub fn refine(climb: &Climb<'_>) -> Result<Refined, Error> {
    let free = Climb {
        preserve: false,
        ..*climb
    };
    let take = |answer: Answer| {
        // Bounds that were eased already are not eased once more.
        let past = match &answer.advice {
            Some(advice) => {
                (climb.log)(&format!("template {}: {advice}", climb.template));
                0.0
            }
            None => answer.outside()[0],
        };
        let count = answer.mesh.tetrahedra().len();
        let made = surface_of(climb, answer)?;
        let many = (SHARP..HARD).contains(&past) && past * (count as f64) >= FEW;
        let short = many.then(|| {
            format!(
                "{:.1} % of the guide's elements are past the radius-edge bound eased by {EASED}",
                100.0 * past
            )
        });
        Ok(Judged { made, short })
    };
    free.climb(Asks::Eased([EASED, 1.0]), take, |_, _| true)
}

/// The surface of the mesher's answer.
fn surface_of(climb: &Climb<'_>, answer: Answer) -> Result<Refined, Error> {
    let unusable = |what: String| Error::Unusable {
        template: climb.template,
        what,
    };
    if !answer.keeps_points() {
        return Err(unusable("input points were moved or left out".to_owned()));
    }
    let Answer { plc, mesh, .. } = answer;
    let Cells { surface, .. } = label(&plc, &*mesh).map_err(|c| {
        let place = Place(plc.to_model(c.place));
        unusable(format!("there are {} near {place}", c.what))
    })?;
    let template = &climb.document.templates[climb.template];
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
    };
    put_back(&mut refined, plc.shift);
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
    let extent = (refined.vertices.iter()).fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
    for of_vertex in pairs.chunk_by(|a, b| a.0 == b.0) {
        // What is on several facets is on an edge.
        let &[(v, f)] = of_vertex else { continue };
        let facet = &refined.facets.facets[f as usize];
        let p = &mut refined.vertices[v as usize];
        let off = (*p - facet.origin).dot(facet.normal);
        if off.abs() > facet.deviation + ROUNDING * extent {
            *p -= facet.normal * off;
        }
    }
    if shift == 0.0 {
        return;
    }
    // Facets more uneven than the shift have no plane to be put back onto.
    pairs.retain(|&(_, f)| refined.facets.facets[f as usize].deviation <= shift);
    for _ in 0..PROJECTIONS {
        for &(v, f) in &pairs {
            let facet = &refined.facets.facets[f as usize];
            let p = &mut refined.vertices[v as usize];
            *p -= facet.normal * (*p - facet.origin).dot(facet.normal);
        }
    }
}
