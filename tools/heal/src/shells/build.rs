//! From labelled triangles that may bound several regions to a document.
//!
//! Where every edge has an even number of triangles, the labels are solids or pieces of one boundary,
//! as in other surface formats. Otherwise pieces meet along edges, as CAD programs write the surfaces of
//! touching parts, each once: then the cells that they divide space into are the regions.

use crate::document::{Imported, Labelled, check_scale, document};
use crate::leak::leak;
use crate::meeting::meetings;
use crate::sides::sided;
use crate::soup;
use crate::welded::welded;
use crate::words::{dropped, place};
use crate::{HealError, Repairing};
use geom::cells::Cells;
use geom::edges::Edges;
use glam::DVec3;
use interchange::parsed::{Faces, Group, Shells, Soup, Volume};
use rustc_hash::FxHashSet;
use std::collections::{BTreeMap, BTreeSet};
use tmesh::{OUTSIDE, Region, Template};

/// Builds the document.
///
/// # Errors
/// Surfaces that enclose nothing, and triangles that cross.
pub fn build(
    shells: Shells,
    format: &'static str,
    repairing: Repairing,
) -> Result<Imported, HealError> {
    check_scale(&shells.points)?;
    let distinct = Distinct::of(&shells);
    let edges = Edges::new(&distinct.triangles);
    if soup::odd_edges(&edges).is_empty() {
        return as_solids(shells, format, repairing);
    }
    let Distinct {
        points,
        triangles,
        markers,
        pieces,
    } = distinct;
    let mut notices = shells.notices.clone();
    let (one, many) = ("triangle", "triangles");
    let repeated = shells.triangles.len() - triangles.len();
    if repeated > 0 {
        notices.push(dropped(repeated, one, many, "flat or there twice"));
    }
    check_crossing(&points, &triangles)?;
    let cells = Cells::new(&points, &triangles, &edges);
    if cells.count() == 1 {
        let leak = leak(&points, &edges, "open edge", "open edges");
        return Err(HealError::BadSurface(format!(
            "the triangles enclose nothing{leak}"
        )));
    }
    let content = contents(&shells, &cells, &pieces);
    let sided = sided(&triangles, &cells, &content.of_cell, |t| markers[t]);
    let inner = sided.inner + sided.outer;
    if inner > 0 {
        notices.push(dropped(inner, one, many, "with the same on both sides"));
    }
    drop(cells);
    document(
        Labelled {
            template: Template {
                vertices: points,
                triangles: sided.triangles,
                ..Template::default()
            },
            regions: content.regions,
            markers: shells.markers,
            relative_precision: shells.relative_precision,
            notices,
            repairs: Vec::new(),
        },
        format,
    )
}

/// The triangles by distinct points, each once, without those that name a point twice.
struct Distinct {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    markers: Vec<u32>,
    pieces: Vec<i64>,
}

impl Distinct {
    fn of(shells: &Shells) -> Self {
        let all = shells.points.iter().copied();
        let (points, ids) = welded(all, shells.points.len());
        let mut distinct = Self {
            points,
            triangles: Vec::new(),
            markers: Vec::new(),
            pieces: Vec::new(),
        };
        let mut seen = FxHashSet::default();
        for &(t, marker, piece) in &shells.triangles {
            let t = t.map(|v| ids[v as usize]);
            let mut key = t;
            key.sort_unstable();
            if key[0] != key[1] && key[1] != key[2] && seen.insert(key) {
                distinct.triangles.push(t);
                distinct.markers.push(marker);
                distinct.pieces.push(piece);
            }
        }
        distinct
    }
}

/// Groups as other surface formats have them.
fn as_solids(
    shells: Shells,
    format: &'static str,
    repairing: Repairing,
) -> Result<Imported, HealError> {
    let group = |marker: u32| shells.markers.partition_point(|m| m.0 < marker) as u32;
    let triangles = shells.triangles.iter();
    let soup = Soup {
        group_of: triangles.clone().map(|t| group(t.1)).collect(),
        faces: Faces::Triangles(triangles.map(|t| t.0).collect()),
        groups: (shells.markers.iter())
            .map(|(_, name)| Group { name: name.clone() })
            .collect(),
        group_word: "surface",
        points: shells.points,
        relative_precision: shells.relative_precision,
        // Meshes of other programs, whose solids share triangles.
        printed_precision: 0.0,
        notices: shells.notices,
    };
    let mut imported = soup::build(soup, format, repairing.into())?;
    if let ([region], [volume]) = (&mut imported.document.regions[..], &shells.volumes[..]) {
        region.name.clone_from(&volume.name);
    }
    Ok(imported)
}

struct Contents {
    /// Region in each cell.
    of_cell: Vec<u32>,
    regions: Vec<Region>,
}

/// Each bounded cell is a region, called as the volume with the same surfaces around it. Where volumes
/// are known by their surfaces, a cell that is none of them is a void.
fn contents(shells: &Shells, cells: &Cells<'_>, pieces: &[i64]) -> Contents {
    let mut around = vec![BTreeSet::new(); cells.count()];
    for (i, &piece) in pieces.iter().enumerate() {
        around[cells.front(i) as usize].insert(piece);
        around[cells.back(i) as usize].insert(piece);
    }
    let volumes = shells.volumes.iter().filter(|v| !v.around.is_empty());
    let named: BTreeMap<&BTreeSet<i64>, &Volume> = volumes.map(|v| (&v.around, v)).collect();
    let known = around.iter().any(|cell| named.contains_key(cell));
    let mut regions: BTreeMap<u32, Region> = BTreeMap::new();
    let mut next = 0;
    let of_cell = (0_u32..).zip(&around).map(|(cell, surfaces)| {
        let found = named.get(surfaces);
        if cell == Cells::UNBOUNDED || (known && found.is_none()) {
            return OUTSIDE;
        }
        let (id, name) = found.map_or_else(
            || {
                next += 1;
                (next, format!("region{next}"))
            },
            |v| (v.id, v.name.clone()),
        );
        // Volumes of one group are one region.
        regions.entry(id).or_insert(Region {
            id,
            name,
            size: None,
            volume: None,
        });
        id
    });
    let of_cell = of_cell.collect();
    Contents {
        of_cell,
        regions: regions.into_values().collect(),
    }
}

fn check_crossing(points: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), HealError> {
    match meetings(points, triangles, |t| t, |_| true).lowest {
        None => Ok(()),
        Some(contact) => Err(HealError::BadSurface(format!(
            "two triangles cross or touch at {}, away from common points and edges",
            place(contact.point)
        ))),
    }
}
