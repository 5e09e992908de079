//! An unstructured grid as the VTK formats hold it: cells of several types with integers on them.

use super::{Finding, Group, Mesh, MeshTriangles, Parsed, PointArray, PointMesh, Soup};
use crate::ReadError;
use crate::text::{counted, plain};
use crate::title::{parse_promise, parse_sector};
use glam::DVec3;
use rustc_hash::FxHashMap;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Tet, Triangle};

/// Name of the text with the symmetry found in a body.
pub const SYMMETRY: &str = "symmetry";
/// Name of the text with what is known of the file that a body was read from.
pub const SOURCE: &str = "source";

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
    /// Numbers at points, of readers that are asked for them.
    pub point_data: Vec<PointArray>,
    /// What the user should know about the file.
    pub notices: Vec<String>,
}

/// The corners of a cell that a [`PointMesh`] has: what they are corners of, and how many the cell lists in all.
fn shape_of(kind: u8) -> Option<(Shape, usize)> {
    Some(match kind {
        5 => (Shape::Face(3), 3),
        22 => (Shape::Face(3), 6),
        34 => (Shape::Face(3), 7),
        9 => (Shape::Face(4), 4),
        23 => (Shape::Face(4), 8),
        28 => (Shape::Face(4), 9),
        10 => (Shape::Volume(4), 4),
        24 => (Shape::Volume(4), 10),
        12 => (Shape::Volume(8), 8),
        25 => (Shape::Volume(8), 20),
        29 => (Shape::Volume(8), 27),
        13 => (Shape::Volume(6), 6),
        26 => (Shape::Volume(6), 15),
        14 => (Shape::Volume(5), 5),
        27 => (Shape::Volume(5), 13),
        PIXEL => (Shape::Face(4), 4),
        VOXEL => (Shape::Volume(8), 8),
        _ => return None,
    })
}

/// A quadrilateral and a hexahedron whose corners are numbered along the axes.
const PIXEL: u8 = 8;
const VOXEL: u8 = 11;

#[derive(Clone, Copy)]
enum Shape {
    Face(usize),
    Volume(usize),
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

    /// A value of JSON among the texts.
    fn json<T: DeserializeOwned>(&self, field: &str) -> Option<T> {
        serde_json::from_str(self.texts.get(field)?).ok()
    }

    /// What the grid is: a mesh where there are tetrahedra, or triangles with both sides named; else
    /// polygons.
    ///
    /// Triangles keep their sides and markers where the file has the arrays `front`, `back` and `marker`
    /// on cells; tetrahedra their regions from the array `region`.
    ///
    /// # Errors
    /// Cells of other types, and cells that name missing points or have another number of points.
    pub fn parsed(mut self, format: &'static str) -> Result<Parsed, ReadError> {
        let mut notices = std::mem::take(&mut self.notices);
        let curved = self.keep_corners(format)?;
        notices.extend(by_corners(curved));
        self.check(format)?;
        let sided = self.array("front").is_some() && self.array("back").is_some();
        if sided || self.types.contains(&TETRA) {
            Ok(Parsed::Mesh(self.into_mesh(notices)))
        } else {
            Ok(Parsed::Soup(self.into_soup(notices)))
        }
    }

    /// Cells of known types that name points that are there, all finite.
    fn check(&self, format: &'static str) -> Result<(), ReadError> {
        let malformed = |reason: String| Err(ReadError::Malformed { format, reason });
        if let Some(i) = self.points.iter().position(|p| !p.is_finite()) {
            let p = self.points[i];
            return malformed(format!("point {i} is ({}, {}, {})", p.x, p.y, p.z));
        }
        // Triangles of other surfaces may name a point twice: they are dropped later.
        let sided = self.array("front").is_some() && self.array("back").is_some();
        let region = self.array("region");
        let mut begin = 0;
        for (i, &kind) in self.types.iter().enumerate() {
            let (n, wanted) = (
                self.ends[i].saturating_sub(begin),
                match kind {
                    1..=4 | TRIANGLE_STRIP | POLYGON => None,
                    TRIANGLE => Some(3),
                    QUADRILATERAL | TETRA => Some(4),
                    other => {
                        return malformed(format!(
                            "cell {i} has the type {other}; only vertices, lines, triangles, \
                             quadrilaterals, polygons and tetrahedra are read"
                        ));
                    }
                },
            );
            if self.ends[i] < begin || self.ends[i] > self.connectivity.len() {
                return malformed(format!("cell {i} has no place in the list of points"));
            }
            if wanted.is_some_and(|w| w != n) {
                return malformed(format!("cell {i} of type {kind} has {n} points"));
            }
            begin = self.ends[i];
            let corners = self.cell(i);
            if let Some(&v) = corners.iter().find(|&&v| v as usize >= self.points.len()) {
                let count = self.points.len();
                return malformed(format!("cell {i} names point {v}, and there are {count}"));
            }
            let simplex = kind == TETRA || (kind == TRIANGLE && sided);
            if simplex && (1..n).any(|k| corners[..k].contains(&corners[k])) {
                return malformed(format!("cell {i} of type {kind} names a point twice"));
            }
            if kind == TETRA && region.is_some_and(|r| r[i] == OUTSIDE) {
                return malformed(format!("cell {i} is a tetrahedron with region -1"));
            }
        }
        Ok(())
    }

    /// The mesh with the numbers at its points. Of cells of second order the corners count.
    ///
    /// # Errors
    /// Cells of unknown types, and those that name missing points or have another number of points; points that are not finite.
    pub fn point_mesh(self, format: &'static str) -> Result<PointMesh, ReadError> {
        let malformed = |reason: String| ReadError::Malformed { format, reason };
        if let Some(i) = self.points.iter().position(|p| !p.is_finite()) {
            let p = self.points[i];
            return Err(malformed(format!(
                "point {i} is ({}, {}, {})",
                p.x, p.y, p.z
            )));
        }
        let mut mesh = PointMesh::default();
        let mut begin = 0;
        for (i, (&kind, &end)) in self.types.iter().zip(&self.ends).enumerate() {
            let cell = self.connectivity.get(begin..end);
            let cell = cell
                .ok_or_else(|| malformed(format!("cell {i} has no place in the list of points")))?;
            begin = end;
            let count = self.points.len();
            if let Some(&v) = cell.iter().find(|&&v| v as usize >= count) {
                return Err(malformed(format!(
                    "cell {i} names point {v}, and there are {count}"
                )));
            }
            match (kind, shape_of(kind)) {
                // Points and lines have neither faces nor volume.
                (1..=4 | 21 | 35, _) => {}
                (TRIANGLE_STRIP, _) => cell.windows(3).for_each(|t| mesh.add_face(t)),
                (POLYGON, _) => mesh.add_face(cell),
                (_, None) => {
                    return Err(malformed(format!(
                        "cell {i} has the type {kind}; only tetrahedra, hexahedra, prisms, pyramids, triangles, quadrilaterals \
                         and polygons are read"
                    )));
                }
                (_, Some((_, n))) if n != cell.len() => {
                    let n = cell.len();
                    return Err(malformed(format!("cell {i} of type {kind} has {n} points")));
                }
                (PIXEL, _) => mesh.add_face(&[0, 1, 3, 2].map(|k| cell[k])),
                (VOXEL, _) => mesh.add_volume(&[0, 1, 3, 2, 4, 5, 7, 6].map(|k| cell[k])),
                (_, Some((Shape::Face(n), _))) => mesh.add_face(&cell[..n]),
                (_, Some((Shape::Volume(n), _))) => mesh.add_volume(&cell[..n]),
            }
        }
        mesh.points = self.points;
        mesh.arrays = self.point_data;
        Ok(mesh)
    }

    /// Takes numbers at points, if there are as many for each.
    pub fn take_point_data(&mut self, name: String, values: Vec<f64>) {
        let points = self.points.len();
        if points > 0 && !values.is_empty() && values.len().is_multiple_of(points) {
            self.point_data.push(PointArray {
                name,
                components: values.len() / points,
                values,
            });
        }
    }

    fn into_mesh(self, mut notices: Vec<String>) -> Mesh {
        let region = self.array("region");
        let marker = self.array("marker");
        let sides = self.array("front").zip(self.array("back"));
        let mut regions = self.names("region_names");
        let mut markers = self.names("marker_names");
        let (mut tets, mut sided, mut marked) = (Vec::new(), Vec::new(), Vec::new());
        let mut others = 0;
        for i in 0..self.types.len() {
            match (self.types[i], self.cell(i), sides) {
                (TETRA, &[a, b, c, d], _) => {
                    let region = region.map_or(1, |r| r[i]);
                    tets.push(Tet {
                        vertices: [a, b, c, d],
                        region,
                    });
                    name(&mut regions, region, "region");
                }
                (TRIANGLE, &[a, b, c], Some((front, back))) => {
                    let marker = marker.map_or(1, |m| m[i]);
                    // The reserved id cannot be in the table.
                    let marker = if marker == OUTSIDE { 0 } else { marker };
                    sided.push(Triangle {
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
                    marked.push(([a, b, c], marker));
                    name(&mut markers, marker, "marker");
                }
                _ => others += 1,
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
        let is_sided = sides.is_some();
        Mesh {
            finding: self.finding(&mut notices),
            promise: parse_promise(&self.title),
            sector_of: parse_sector(&self.title),
            points: self.points,
            tets,
            triangles: if is_sided {
                MeshTriangles::Sided(sided)
            } else {
                MeshTriangles::Marked(marked)
            },
            regions,
            markers,
            relative_precision: self.relative_precision,
            notices,
        }
    }

    /// What was found in the surface before it was written.
    fn finding(&self, notices: &mut Vec<String>) -> Option<Box<Finding>> {
        let source = self.json(SOURCE);
        let symmetry = self.json(SYMMETRY);
        if symmetry.is_none() && self.texts.contains_key(SYMMETRY) {
            notices.push(format!(
                "its array '{SYMMETRY}' is not as expected: ignored"
            ));
        }
        symmetry.map(|symmetry| Box::new(Finding { symmetry, source }))
    }

    /// A surface of another program: groups, orientation and regions are not in the file.
    fn into_soup(self, notices: Vec<String>) -> Soup {
        let mut soup = Soup {
            groups: vec![Group::default()],
            group_word: "grid",
            relative_precision: self.relative_precision,
            notices,
            ..Soup::default()
        };
        for i in 0..self.types.len() {
            let corners = self.cell(i);
            match self.types[i] {
                TRIANGLE | QUADRILATERAL | POLYGON => soup.faces.add(corners),
                TRIANGLE_STRIP => {
                    for (k, w) in corners.windows(3).enumerate() {
                        let t = if k % 2 == 0 {
                            [w[0], w[1], w[2]]
                        } else {
                            [w[1], w[0], w[2]]
                        };
                        soup.faces.add(&t);
                    }
                }
                _ => {}
            }
        }
        soup.points = self.points;
        soup
    }
}

fn name(table: &mut BTreeMap<u32, String>, id: u32, word: &str) {
    table.entry(id).or_insert_with(|| format!("{word}{id}"));
}

/// The notice about elements of second order whose corners alone are read; none where there are none.
pub fn by_corners(count: usize) -> Option<String> {
    let (one, many) = ("element of second order is", "elements of second order are");
    (count > 0).then(|| format!("{} read by their corners", counted(count, one, many)))
}
