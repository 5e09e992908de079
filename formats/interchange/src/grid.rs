//! From an unstructured grid, as the VTK formats hold it, to a document.

use crate::document::{Labelled, check_scale, document, dropped, plain};
use crate::place::counted;
use crate::polygon::Polygons;
use crate::soup::Group;
use crate::{Imported, ReadError, parse_promise, skin, surface};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use tmesh::{Document, Marker, OUTSIDE, Region, Template, Tet, Triangle};

pub const TRIANGLE: u8 = 5;
const TRIANGLE_STRIP: u8 = 6;
const POLYGON: u8 = 7;
const QUADRILATERAL: u8 = 9;
pub const TETRA: u8 = 10;
const QUADRATIC_TRIANGLE: u8 = 22;
const QUADRATIC_TETRA: u8 = 24;

/// Points and cells with integers on them.
#[derive(Debug, Default)]
pub struct Grid {
    /// Title line.
    pub title: String,
    /// Points.
    pub points: Vec<DVec3>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// VTK's cell type of each cell.
    pub types: Vec<u8>,
    /// Where each cell's points end in `connectivity`.
    pub ends: Vec<usize>,
    /// Points of all cells.
    pub connectivity: Vec<u32>,
    /// Integers on cells, by array name; -1 is [`OUTSIDE`].
    pub cell_data: FxHashMap<String, Vec<u32>>,
    /// Texts in the field data, by array name.
    pub texts: FxHashMap<String, String>,
}

impl Grid {
    fn cell(&self, i: usize) -> &[u32] {
        let begin = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.connectivity[begin..self.ends[i]]
    }

    /// Adds a cell.
    pub fn add(&mut self, kind: u8, corners: &[u32]) {
        self.types.push(kind);
        self.connectivity.extend(corners);
        self.ends.push(self.connectivity.len());
    }

    /// Replaces triangles and tetrahedra of second order by those of their corners, and drops points
    /// that nothing names then. Returns how many there were.
    fn keep_corners(&mut self, format: &'static str) -> Result<usize, ReadError> {
        let curved = |kind: u8| matches!(kind, QUADRATIC_TRIANGLE | QUADRATIC_TETRA);
        let count = self.types.iter().filter(|&&t| curved(t)).count();
        if count == 0 {
            return Ok(0);
        }
        let old = std::mem::take(self);
        self.connectivity.reserve(old.connectivity.len());
        let mut begin = 0;
        for (i, (&kind, &end)) in old.types.iter().zip(&old.ends).enumerate() {
            let (kind, wanted, corners) = match kind {
                QUADRATIC_TRIANGLE => (TRIANGLE, Some(6), 3),
                QUADRATIC_TETRA => (TETRA, Some(10), 4),
                kind => (kind, None, usize::MAX),
            };
            let cell = old.connectivity.get(begin..end);
            let Some(cell) = cell.filter(|c| wanted.is_none_or(|n| c.len() == n)) else {
                return Err(ReadError::Malformed {
                    format,
                    reason: format!("cell {i} has the wrong number of points"),
                });
            };
            self.add(kind, &cell[..cell.len().min(corners)]);
            begin = end;
        }
        let types = std::mem::take(&mut self.types);
        let ends = std::mem::take(&mut self.ends);
        let connectivity = std::mem::take(&mut self.connectivity);
        *self = Self {
            types,
            ends,
            connectivity,
            ..old
        };
        self.drop_unused_points();
        Ok(count)
    }

    /// Drops points that no cell names.
    pub fn drop_unused_points(&mut self) {
        let mut used = vec![false; self.points.len()];
        for &v in &self.connectivity {
            if let Some(u) = used.get_mut(v as usize) {
                *u = true;
            }
        }
        let mut next = 0;
        let new_id: Vec<u32> = used
            .iter()
            .map(|&u| {
                next += u32::from(u);
                next.saturating_sub(1)
            })
            .collect();
        for v in &mut self.connectivity {
            if let Some(&id) = new_id.get(*v as usize) {
                *v = id;
            }
        }
        let mut used = used.into_iter();
        self.points.retain(|_| used.next() == Some(true));
    }

    /// Whether an array is there with one value per cell.
    fn array(&self, name: &str) -> Option<&[u32]> {
        let values = self.cell_data.get(name)?;
        (values.len() == self.types.len()).then_some(values)
    }

    /// Names of a table such as `region_names`: a line `id name` each.
    fn names(&self, field: &str) -> BTreeMap<u32, String> {
        let text = self.texts.get(field).map_or("", String::as_str);
        text.lines()
            .filter_map(|line| {
                let (id, name) = line.split_once(' ')?;
                Some((id.parse().ok()?, plain(name)))
            })
            .collect()
    }
}

/// Builds the document: a tetrahedral mesh where there are tetrahedra, else a surface.
///
/// Triangles keep their sides and markers where the file has the arrays `front`, `back` and `marker`
/// on cells; tetrahedra their regions from the array `region`.
///
/// # Errors
/// Cells that name missing points or have another shape; a surface that is not closed.
pub fn build(grid: Grid, format: &'static str) -> Result<Imported, ReadError> {
    let mut grid = grid;
    let mut notices = Vec::new();
    let curved = grid.keep_corners(format)?;
    if curved > 0 {
        let (one, many) = ("element of second order is", "elements of second order are");
        notices.push(format!(
            "{} read by their corners",
            counted(curved, one, many)
        ));
    }
    check(&grid, format)?;
    check_scale(&grid.points)?;
    let count = |kind: u8| grid.types.iter().filter(|&&t| t == kind).count();
    let (tets, triangles) = (count(TETRA), count(TRIANGLE));
    let sides = grid.array("front").zip(grid.array("back"));
    if tets == 0 && sides.is_none() {
        return as_soup(grid, format);
    }
    if tets == 0 && triangles == 0 {
        return Err(ReadError::BadSurface(
            "it has neither tetrahedra nor triangles".to_owned(),
        ));
    }
    let region = grid.array("region");
    let marker = grid.array("marker");
    let mut template = Template {
        triangles: Vec::with_capacity(if sides.is_some() { triangles } else { 0 }),
        tets: Vec::with_capacity(tets),
        ..Template::default()
    };
    let mut regions = grid.names("region_names");
    let mut markers = grid.names("marker_names");
    let mut others = 0;
    let mut bare = Vec::new();
    for i in 0..grid.types.len() {
        match (grid.types[i], grid.cell(i), sides) {
            (TETRA, &[a, b, c, d], _) => {
                let region = region.map_or(1, |r| r[i]);
                if region == OUTSIDE {
                    return Err(ReadError::Malformed {
                        format,
                        reason: format!("cell {i} is a tetrahedron with region -1"),
                    });
                }
                template.tets.push(Tet {
                    vertices: [a, b, c, d],
                    region,
                });
                name(&mut regions, region, "region");
            }
            (TRIANGLE, &[a, b, c], Some((front, back))) => {
                let marker = marker.map_or(1, |m| m[i]);
                // The reserved id cannot be in the table.
                let marker = if marker == OUTSIDE { 0 } else { marker };
                template.triangles.push(Triangle {
                    vertices: [a, b, c],
                    marker,
                    front: front[i],
                    back: back[i],
                });
                name(&mut markers, marker, "marker");
                for side in [front[i], back[i]] {
                    if side != OUTSIDE {
                        name(&mut regions, side, "region");
                    }
                }
            }
            (TRIANGLE, &[a, b, c], None) if marker.is_some() => {
                let marker = marker.map_or(OUTSIDE, |m| m[i]);
                bare.push(([a, b, c], marker));
                name(&mut markers, marker, "marker");
            }
            _ => others += 1,
        }
    }
    if !bare.is_empty() {
        let (triangles, inside) = skin::surface(&template.tets, &bare);
        template.triangles = triangles;
        if inside > 0 {
            notices.push(dropped(
                inside,
                "triangle",
                "triangles",
                "with the same region on both sides",
            ));
        }
    }
    if others > 0 {
        notices.push(format!(
            "{} ignored",
            counted(
                others,
                "cell that is no tetrahedron",
                "cells that are no tetrahedra"
            )
        ));
    }
    regions.remove(&OUTSIDE);
    markers.remove(&OUTSIDE);
    let promise = parse_promise(&grid.title);
    template.vertices = grid.points;
    let regions: Vec<Region> = regions
        .into_iter()
        .map(|(id, name)| Region {
            id,
            name,
            max_volume: None,
            volume: None,
        })
        .collect();
    let mut imported = if tets == 0 {
        // Regions that no triangle bounds have no volume to speak of.
        let bounded: FxHashSet<u32> = template
            .triangles
            .iter()
            .flat_map(|t| [t.front, t.back])
            .collect();
        let regions = regions
            .into_iter()
            .filter(|r| bounded.contains(&r.id))
            .collect();
        let labelled = Labelled {
            regions,
            markers: markers.into_iter().collect(),
            template,
            relative_precision: grid.relative_precision,
            notices,
        };
        document(labelled, format)?
    } else {
        let mut document = Document::single(template);
        document.regions = regions;
        document.markers = markers
            .into_iter()
            .map(|(id, name)| Marker {
                id,
                name,
                area: None,
            })
            .collect();
        Imported { document, notices }
    };
    imported.document.promise = promise;
    Ok(imported)
}

fn name(table: &mut BTreeMap<u32, String>, id: u32, word: &str) {
    table.entry(id).or_insert_with(|| format!("{word}{id}"));
}

/// Cells of known shapes that name points that are there, all finite.
fn check(grid: &Grid, format: &'static str) -> Result<(), ReadError> {
    let malformed = |reason: String| Err(ReadError::Malformed { format, reason });
    if let Some(i) = grid.points.iter().position(|p| !p.is_finite()) {
        let p = grid.points[i];
        return malformed(format!("point {i} is ({}, {}, {})", p.x, p.y, p.z));
    }
    // Of other surfaces, such triangles are dropped.
    let sided = grid.array("front").is_some() && grid.array("back").is_some();
    let mut begin = 0;
    for (i, &kind) in grid.types.iter().enumerate() {
        let (n, wanted) = (
            grid.ends[i].saturating_sub(begin),
            match kind {
                1..=4 | TRIANGLE_STRIP | POLYGON => None,
                TRIANGLE => Some(3),
                QUADRILATERAL | TETRA => Some(4),
                other => {
                    return malformed(format!(
                        "cell {i} has the type {other}; only vertices, lines, triangles, quadrilaterals, \
                     polygons and tetrahedra are read"
                    ));
                }
            },
        );
        if grid.ends[i] < begin || grid.ends[i] > grid.connectivity.len() {
            return malformed(format!("cell {i} has no place in the list of points"));
        }
        if wanted.is_some_and(|w| w != n) {
            return malformed(format!("cell {i} of type {kind} has {n} points"));
        }
        begin = grid.ends[i];
        let corners = grid.cell(i);
        if let Some(&v) = corners.iter().find(|&&v| v as usize >= grid.points.len()) {
            let count = grid.points.len();
            return malformed(format!("cell {i} names point {v}, and there are {count}"));
        }
        let simplex = kind == TETRA || (kind == TRIANGLE && sided);
        if simplex && (1..n).any(|k| corners[..k].contains(&corners[k])) {
            return malformed(format!("cell {i} of type {kind} names a point twice"));
        }
    }
    Ok(())
}

/// A surface of another program: groups, orientation and regions are found out.
fn as_soup(grid: Grid, format: &'static str) -> Result<Imported, ReadError> {
    let mut polygons = Polygons::new(grid.points.len());
    for &p in &grid.points {
        polygons.point(p);
    }
    for i in 0..grid.types.len() {
        let corners = grid.cell(i);
        match grid.types[i] {
            TRIANGLE | QUADRILATERAL | POLYGON => polygons.polygon(corners, 0),
            TRIANGLE_STRIP => {
                for (k, w) in corners.windows(3).enumerate() {
                    let t = if k % 2 == 0 {
                        [w[0], w[1], w[2]]
                    } else {
                        [w[1], w[0], w[2]]
                    };
                    polygons.polygon(&t, 0);
                }
            }
            _ => {}
        }
    }
    let groups = vec![Group::default()];
    let soup = polygons.into_soup(groups, "grid", grid.relative_precision);
    surface::build(soup, format)
}
