//! From a piecewise linear complex to a document.
//!
//! Facets have no orientation: they are triangulated so that they fit together along common
//! segments, and what lies on either side of a triangle follows from the cells the facets divide
//! space into, and from the hole and region points in those cells.

use super::facets::{check_crossing, triangulate_facets};
use super::regions::regions;
use crate::HealError;
use crate::document::{Imported, Labelled, check_scale, document};
use crate::leak::leak;
use crate::sides::sided;
use crate::words::dropped;
use geom::cells::Cells;
use geom::edges::Edges;
use interchange::parsed::Plc;
use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Template};

/// Builds the document of a piecewise linear complex.
///
/// # Errors
/// Facets that are not planar subdivisions, that cross, or that leave a region open; hole and region
/// points that contradict each other.
pub fn build(plc: Plc, format: &'static str) -> Result<Imported, HealError> {
    check_scale(&plc.points)?;
    let mut notices = Vec::new();
    let facets = triangulate_facets(&plc, &mut notices)?;
    let (points, triangles) = (facets.points, &facets.triangles);
    if triangles.is_empty() {
        return Err(HealError::BadSurface(
            "it has no facets with an area".to_owned(),
        ));
    }
    check_crossing(&points, triangles, &facets.facet_of)?;
    let edges = Edges::new(triangles);
    let cells = Cells::new(&points, triangles, &edges);
    let (one, many) = ("edge has one facet only", "edges have one facet only");
    let leak = || leak(&points, &edges, one, many);
    if cells.count() == 1 {
        return Err(HealError::BadSurface(format!(
            "the facets enclose nothing{}",
            leak()
        )));
    }
    let (region_of, regions) = regions(&plc, &cells, &leak, &mut notices)?;
    let (marker_ids, markers) = markers(&plc);
    let facet = |t: usize| &plc.facets[facets.facet_of[t] as usize];
    let sided = sided(triangles, &cells, &region_of, |t| {
        marker_ids[&facet(t).marker]
    });
    let (one, many) = ("triangle of a facet", "triangles of facets");
    if sided.inner > 0 {
        notices.push(dropped(sided.inner, one, many, "within one region"));
    }
    if sided.outer > 0 {
        let why = "with no region on either side";
        notices.push(dropped(sided.outer, one, many, why));
    }
    if sided.triangles.is_empty() {
        return Err(HealError::BadSurface(
            "no region is left: all cells are holes".to_owned(),
        ));
    }
    drop(cells);
    document(
        Labelled {
            template: Template {
                vertices: points,
                triangles: sided.triangles,
                ..Template::default()
            },
            regions,
            markers,
            relative_precision: plc.relative_precision,
            notices,
            repairs: Vec::new(),
        },
        format,
    )
}

/// Id of each facet marker, and the names: the number itself where it can be an id.
fn markers(plc: &Plc) -> (FxHashMap<i64, u32>, Vec<(u32, String)>) {
    let mut values: Vec<i64> = plc.facets.iter().map(|f| f.marker).collect();
    values.sort_unstable();
    values.dedup();
    let fits = |m: i64| u32::try_from(m).ok().filter(|&id| id != OUTSIDE);
    let mut ids: FxHashMap<i64, u32> = FxHashMap::default();
    let mut next = 1;
    for &m in &values {
        let id = fits(m).unwrap_or_else(|| {
            while values.binary_search(&i64::from(next)).is_ok() {
                next += 1;
            }
            next += 1;
            next - 1
        });
        ids.insert(m, id);
    }
    let mut names: Vec<(u32, String)> = values.iter().map(|m| (ids[m], m.to_string())).collect();
    names.sort_unstable();
    (ids, names)
}
