//! The surface of a template after TetGen refined it freely, walls included.

use crate::cells::{Cells, label};
use crate::error::Place;
use crate::facets::Facets;
use crate::mesher::{Answer, run};
use crate::{Error, Params, Sizes};
use glam::DVec3;
use tmesh::Document;

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

/// Meshes template `index` as asked by `params`, but free to put points on every facet, and gives
/// the surface of that mesh. No facet joins wall faces with anything else, nor the two faces of a
/// seam.
///
/// # Errors
/// See [`Error`].
pub fn refine(
    document: &Document,
    index: usize,
    params: &Params,
    log: &(dyn Fn(&str) + Sync),
) -> Result<Refined, Error> {
    let sizes = Sizes::new(document, params)?;
    let Answer { plc, mesh, .. } = run(document, index, params, &sizes, |_| false, log)?;
    let unusable = |what: String| Error::Unusable {
        template: index,
        what,
    };
    let kept = plc.points.len();
    if mesh.points().len() < kept || mesh.points()[..kept] != plc.points {
        return Err(unusable("input points were moved or left out".to_owned()));
    }
    let Cells { surface, .. } = label(&plc, &mesh).map_err(|c| {
        let place = Place(plc.to_model(c.place));
        unusable(format!("there are {} near {place}", c.what))
    })?;
    let template = &document.templates[index];
    let vertices = mesh
        .points()
        .iter()
        .enumerate()
        .map(|(i, p)| match plc.vertex_of_point.get(i) {
            Some(&v) => template.vertices[v as usize],
            None => plc.to_model(*p),
        })
        .collect();
    Ok(Refined {
        vertices,
        vertex_of_point: plc.vertex_of_point,
        triangles: surface.iter().map(|s| s.triangle.vertices).collect(),
        facet: surface.iter().map(|s| s.facet).collect(),
        facets: plc.facets,
    })
}
