//! From a mesh with labels to a document.

use super::{found, skin};
use crate::HealError;
use crate::document::{Imported, Labelled, check_scale, document};
use crate::words::dropped;
use interchange::parsed::{Mesh, MeshTriangles};
use rustc_hash::FxHashSet;
use tmesh::{Document, Marker, Region, Template};

/// Builds the document: a tetrahedral mesh where there are tetrahedra, else a surface whose triangles
/// name the regions on both sides.
///
/// # Errors
/// Nothing in the file; a region without volume.
pub fn build(mesh: Mesh, format: &'static str) -> Result<Imported, HealError> {
    check_scale(&mesh.points)?;
    let mut notices = mesh.notices;
    let triangles = match mesh.triangles {
        MeshTriangles::Sided(triangles) => triangles,
        MeshTriangles::Marked(marked) if marked.is_empty() => Vec::new(),
        MeshTriangles::Marked(marked) => {
            let (triangles, inside) = skin::surface(&mesh.tets, &marked);
            if inside > 0 {
                let why = "with the same region on both sides";
                notices.push(dropped(inside, "triangle", "triangles", why));
            }
            triangles
        }
    };
    if mesh.tets.is_empty() && triangles.is_empty() {
        return Err(HealError::BadSurface(
            "it has neither tetrahedra nor triangles".to_owned(),
        ));
    }
    let regions = mesh.regions.into_iter().map(|(id, name)| Region {
        id,
        name,
        size: None,
        volume: None,
    });
    let template = Template {
        vertices: mesh.points,
        triangles,
        tets: mesh.tets,
        ..Template::default()
    };
    let mut imported = if template.tets.is_empty() {
        // Regions that no triangle bounds have no volume to speak of.
        let sides = template.triangles.iter().flat_map(|t| [t.front, t.back]);
        let bounded: FxHashSet<u32> = sides.collect();
        let labelled = Labelled {
            regions: regions.filter(|r| bounded.contains(&r.id)).collect(),
            markers: mesh.markers.into_iter().collect(),
            template,
            relative_precision: mesh.relative_precision,
            notices,
            repairs: Vec::new(),
        };
        document(labelled, format)?
    } else {
        let mut document = Document::single(template);
        document.regions = regions.collect();
        let markers = mesh.markers.into_iter().map(|(id, name)| Marker {
            id,
            name,
            area: None,
        });
        document.markers = markers.collect();
        Imported {
            document,
            notices,
            repairs: Vec::new(),
            joined: None,
            undrawn: None,
            is_apart: false,
        }
    };
    imported.document.promise = mesh.promise;
    if let Some(finding) = mesh.finding {
        found::restore(&mut imported, *finding);
    }
    if let Some(instances) = mesh.sector_of {
        imported.notices.push(format!(
            "the file holds one sector of a mesh of {instances} instances, without its symmetry: it is taken for a whole body"
        ));
        let source = imported.document.source.as_mut();
        source
            .into_iter()
            .for_each(|s| s.sector_of = Some(instances));
    }
    Ok(imported)
}
