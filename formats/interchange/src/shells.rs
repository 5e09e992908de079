//! From labelled triangles that may bound several regions to a document.
//!
//! Where every edge has an even number of triangles, the labels are solids or pieces of one boundary,
//! as in other surface formats. Otherwise pieces meet along edges, as CAD programs write the surfaces of
//! touching parts, each once: then the cells that they divide space into are the regions.

use crate::closure::odd_edges;
use crate::document::{Labelled, check_scale, document, dropped};
use crate::place::{counted, place};
use crate::polygon::Polygons;
use crate::soup::Group;
use crate::weld::Welder;
use crate::{Imported, ReadError, surface};
use geom::cells::Cells;
use geom::contacts::contacts;
use geom::edges::Edges;
use glam::DVec3;
use rustc_hash::FxHashSet;
use std::collections::{BTreeMap, BTreeSet};
use tmesh::{OUTSIDE, Region, Template, Triangle};

/// Triangles with labels.
pub struct Shell {
    /// Points; any may be there several times.
    pub points: Vec<DVec3>,
    /// Three points of each triangle, its marker, and the piece of surface it is on.
    pub triangles: Vec<([u32; 3], u32, i64)>,
    /// Names of the markers, increasing in id.
    pub markers: Vec<(u32, String)>,
    /// What the file says of volumes.
    pub volumes: Vec<Volume>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
}

/// A named volume.
pub struct Volume {
    /// Region id.
    pub id: u32,
    /// Name.
    pub name: String,
    /// The pieces of surface around it; empty when the file does not say.
    pub around: BTreeSet<i64>,
}

/// Builds the document.
///
/// # Errors
/// Surfaces that enclose nothing, and triangles that cross.
pub fn build(shell: Shell, format: &'static str) -> Result<Imported, ReadError> {
    check_scale(&shell.points)?;
    let mut welder = Welder::new(shell.points.len());
    let ids: Vec<u32> = shell.points.iter().map(|&p| welder.id(p)).collect();
    let mut points = welder.into_points();
    let mut seen = FxHashSet::default();
    let (mut triangles, mut markers, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
    for &(t, marker, piece) in &shell.triangles {
        let t = t.map(|v| ids[v as usize]);
        let mut key = t;
        key.sort_unstable();
        if key[0] != key[1] && key[1] != key[2] && seen.insert(key) {
            triangles.push(t);
            markers.push(marker);
            pieces.push(piece);
        }
    }
    let edges = Edges::new(&triangles);
    if odd_edges(&edges).is_empty() {
        return as_solids(shell, format);
    }
    let repeated = shell.triangles.len() - triangles.len();
    let mut notices = Vec::new();
    if repeated > 0 {
        let (one, many) = ("triangle", "triangles");
        notices.push(dropped(repeated, one, many, "flat or there twice"));
    }
    check_crossing(&points, &triangles)?;
    let cells = Cells::new(&points, &triangles, &edges);
    if cells.count() == 1 {
        let open: Vec<usize> = odd_edges(&edges)
            .into_iter()
            .filter(|&e| edges.around(e).len() == 1)
            .collect();
        let leak = open.first().map_or_else(String::new, |&e| {
            let [a, b] = edges.ends[e].map(|v| place(points[v as usize]));
            format!(
                "; {} (the first from {a} to {b})",
                counted(open.len(), "open edge", "open edges")
            )
        });
        return Err(ReadError::BadSurface(format!(
            "the triangles enclose nothing{leak}"
        )));
    }
    let content = contents(&shell, &cells, &pieces);
    let mut labelled = Vec::with_capacity(triangles.len());
    let mut inner = 0;
    for (i, &[a, b, c]) in triangles.iter().enumerate() {
        let front = content.of_cell[cells.front(i) as usize];
        let back = content.of_cell[cells.back(i) as usize];
        if front == back {
            inner += 1;
            continue;
        }
        // Boundaries face outwards, interfaces towards the higher region id. OUTSIDE is the highest.
        let turned = front < back;
        labelled.push(Triangle {
            vertices: if turned { [a, c, b] } else { [a, b, c] },
            marker: markers[i],
            front: front.max(back),
            back: front.min(back),
        });
    }
    if inner > 0 {
        let (one, many) = ("triangle", "triangles");
        notices.push(dropped(inner, one, many, "with the same on both sides"));
    }
    document(
        Labelled {
            template: Template {
                vertices: std::mem::take(&mut points),
                triangles: labelled,
                ..Template::default()
            },
            regions: content.regions,
            markers: shell.markers,
            relative_precision: shell.relative_precision,
            notices,
        },
        format,
    )
}

/// Groups as other surface formats have them.
fn as_solids(shell: Shell, format: &'static str) -> Result<Imported, ReadError> {
    let mut polygons = Polygons::new(shell.points.len());
    for &p in &shell.points {
        polygons.point(p);
    }
    for &(t, marker, _) in &shell.triangles {
        let group = shell.markers.partition_point(|m| m.0 < marker);
        polygons.polygon(&t, group as u32);
    }
    let names = shell.markers.iter();
    let groups = names
        .map(|(_, name)| Group { name: name.clone() })
        .collect();
    let soup = polygons.into_soup(groups, "surface", shell.relative_precision);
    let mut imported = surface::build(soup, format)?;
    if let ([region], [volume]) = (&mut imported.document.regions[..], &shell.volumes[..]) {
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
fn contents(shell: &Shell, cells: &Cells<'_>, pieces: &[i64]) -> Contents {
    let mut around = vec![BTreeSet::new(); cells.count()];
    for (i, &piece) in pieces.iter().enumerate() {
        around[cells.front(i) as usize].insert(piece);
        around[cells.back(i) as usize].insert(piece);
    }
    let volumes = shell.volumes.iter().filter(|v| !v.around.is_empty());
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
            max_volume: None,
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

fn check_crossing(points: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ReadError> {
    let mut found = None;
    contacts(
        points,
        triangles,
        |t| t,
        |contact| {
            found = Some(contact);
            false
        },
    );
    match found {
        None => Ok(()),
        Some(contact) => Err(ReadError::BadSurface(format!(
            "two triangles cross or touch at {}, away from common points and edges",
            place(contact.point)
        ))),
    }
}
