//! Gmsh meshes, versions 2.0 to 2.2 and 4.1, binary and text: tetrahedral meshes, and surfaces.
//!
//! Format: Gmsh reference manual, "MSH file format" and "Legacy formats". Physical volumes are
//! regions, physical surfaces are markers; entities without a physical group count by themselves. Of
//! second-order elements the corners are read.

use super::file::{File, Group};
use super::node_data::node_data;
use super::scan::Scanner;
use crate::ReadError;
use crate::parsed::{Parsed, PointMesh};
use crate::text::{DOUBLE, plain, shown};
use glam::DVec3;
use std::collections::BTreeSet;

const MAGIC: &[u8] = b"$MeshFormat";

/// Whether the bytes begin like a file of this format.
pub fn looks_like(head: &[u8]) -> bool {
    let head = head.trim_ascii_start();
    head.starts_with(MAGIC)
        || (head.starts_with(b"$Comments") && head.windows(MAGIC.len()).any(|part| part == MAGIC))
}

/// Reads a file.
///
/// # Errors
/// Bytes that do not follow the format; elements other than triangles, quadrilaterals and tetrahedra
/// in surfaces and volumes.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut reader = Reader::new(bytes);
    reader.read()?;
    let precision = if reader.scan.binary {
        DOUBLE
    } else {
        reader.scan.tokens.precision().relative()
    };
    reader.file.build(precision)
}

/// Reads the mesh of a file with the numbers at its nodes. Cells of volume may be hexahedra, prisms and pyramids as well.
///
/// # Errors
/// Bytes that do not follow the format, and elements of other kinds.
pub fn read_points(bytes: &[u8]) -> Result<PointMesh, ReadError> {
    let mut reader = Reader::new(bytes);
    reader.file.views = Some(Vec::new());
    reader.read()?;
    Ok(reader.file.points())
}

/// Vertices of each element type, by its number.
const NODES: [usize; 32] = [
    0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,
    6, 20, 35, 56,
];

struct Reader<'a> {
    scan: Scanner<'a>,
    /// Version 2.
    old: bool,
    file: File,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            scan: Scanner::new(bytes),
            old: false,
            file: File::default(),
        }
    }
}

impl Reader<'_> {
    fn read(&mut self) -> Result<(), ReadError> {
        let mut known = false;
        let mut seen = BTreeSet::new();
        while let Some(word) = self.scan.tokens.next_word() {
            let Some(section) = word.strip_prefix(b"$") else {
                return Err(self.scan.error(format!(
                    "a section that begins with '$' expected, found '{}'",
                    shown(word)
                )));
            };
            if section == b"NodeData" && self.file.views.is_some() {
                self.scan.end_line();
                let view = node_data(&mut self.scan)?;
                self.file.views.get_or_insert_default().push(view);
                self.scan.tokens.expect("$EndNodeData")?;
                continue;
            }
            let wanted = matches!(
                section,
                b"MeshFormat" | b"PhysicalNames" | b"Entities" | b"Nodes" | b"Elements"
            );
            if !wanted {
                let text = self.scan.skip_section(section)?;
                if section == b"Comments" {
                    self.file.title = String::from_utf8_lossy(text.trim_ascii()).into_owned();
                }
                continue;
            }
            if !seen.insert(section) {
                let name = shown(section);
                return Err(self.scan.error(format!("section '{name}' comes twice")));
            }
            if !known && section != b"MeshFormat" {
                return Err(self
                    .scan
                    .error("it does not begin with the section MeshFormat"));
            }
            self.scan.end_line();
            match section {
                b"MeshFormat" => {
                    self.format()?;
                    known = true;
                }
                b"PhysicalNames" => self.names()?,
                b"Entities" => self.entities()?,
                b"Nodes" if self.old => self.nodes_old()?,
                b"Nodes" => self.nodes()?,
                _ if self.old => self.elements_old()?,
                _ => self.elements()?,
            }
            self.scan
                .tokens
                .expect(&format!("$End{}", String::from_utf8_lossy(section)))?;
        }
        if !known {
            return Err(self.scan.error("it has no section MeshFormat"));
        }
        for section in [&b"Nodes"[..], b"Elements"] {
            if !seen.contains(section) {
                let name = shown(section);
                return Err(self.scan.error(format!("it has no section {name}")));
            }
        }
        Ok(())
    }

    fn format(&mut self) -> Result<(), ReadError> {
        let version = self.scan.tokens.next_word().unwrap_or_default();
        self.old = match version {
            b"2" | b"2.0" | b"2.1" | b"2.2" => true,
            b"4.1" => false,
            other => {
                return Err(self.scan.error(format!(
                    "version '{}' is not read; versions 2.2 and 4.1 are",
                    shown(other)
                )));
            }
        };
        self.scan.binary = match self.scan.tokens.integer("the file type")? {
            0 => false,
            1 => true,
            other => {
                return Err(self.scan.error(format!("file type {other}, not 0 or 1")));
            }
        };
        let size = self.scan.tokens.integer("the size of numbers")?;
        if size != 8 {
            return Err(self
                .scan
                .error(format!("numbers of {size} bytes; those of 8 are read")));
        }
        if self.scan.binary {
            self.scan.tokens.count_bytes();
            self.scan.end_line();
            let one = self.scan.raw::<4>("the mark of the byte order")?;
            self.scan.big = match (u32::from_le_bytes(one), u32::from_be_bytes(one)) {
                (1, _) => false,
                (_, 1) => true,
                _ => {
                    return Err(self.scan.error("the mark of the byte order is not 1"));
                }
            };
        }
        Ok(())
    }

    fn names(&mut self) -> Result<(), ReadError> {
        let count = self.scan.tokens.count("the number of names")?;
        for _ in 0..count {
            let dimension = self.scan.tokens.integer("a dimension")?;
            let tag = self.scan.tokens.integer("the number of a group")?;
            let rest = self.scan.tokens.rest_of_line();
            let name = rest.strip_prefix(b"\"").and_then(|r| r.strip_suffix(b"\""));
            let Some(name) = name else {
                return Err(self.scan.error(format!(
                    "a name in quotes expected, found '{}'",
                    shown(rest)
                )));
            };
            let name = plain(&String::from_utf8_lossy(name));
            self.file.names.insert((dimension, tag), name);
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<(), ReadError> {
        if self.old {
            return Err(self.scan.error("version 2 has no section Entities"));
        }
        let mut counts = [0; 4];
        for (count, what) in counts.iter_mut().zip([
            "the number of points",
            "the number of curves",
            "the number of surfaces",
            "the number of volumes",
        ]) {
            *count = self.scan.count(what, 2, 4)?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                let tag = self.scan.int("the number of an entity")?;
                let bounds = if dimension == 0 { 3 } else { 6 };
                for _ in 0..bounds {
                    // Entities without elements may have no proper bounds.
                    if self.scan.binary {
                        self.scan.raw::<8>("a bound")?;
                    } else {
                        self.scan.tokens.number()?;
                    }
                }
                let groups = self.scan.count("the number of groups", 2, 4)?;
                for i in 0..groups {
                    let group = self.scan.int("the number of a group")?;
                    if i == 0 {
                        self.file
                            .physical
                            .insert((dimension, tag), group.saturating_abs());
                    }
                }
                if dimension == 0 {
                    continue;
                }
                let around = self.scan.count("the number of bounding entities", 2, 4)?;
                let mut bounding = Vec::new();
                for _ in 0..around {
                    bounding.push(self.scan.int("a bounding entity")?.saturating_abs());
                }
                if dimension == 3 {
                    self.file.volumes.push((tag, bounding));
                }
            }
        }
        Ok(())
    }

    fn point(&mut self, tag: u64) -> Result<(), ReadError> {
        let index = self.file.points.len() as u32;
        let p = DVec3::new(
            self.scan.double()?,
            self.scan.double()?,
            self.scan.double()?,
        );
        self.file.points.push(p);
        self.number_node(tag, index)
    }

    /// Notes that a node has an index.
    fn number_node(&mut self, tag: u64, index: u32) -> Result<(), ReadError> {
        let file = &mut self.file;
        if file.index.is_none() {
            if tag == u64::from(index) + 1 {
                return Ok(());
            }
            let before = (0..index).map(|i| (u64::from(i) + 1, i));
            file.index = Some(before.collect());
        }
        let twice = file.index.as_mut().and_then(|all| all.insert(tag, index));
        match twice {
            Some(_) => Err(self.scan.error(format!("node {tag} comes twice"))),
            None => Ok(()),
        }
    }

    fn check_node_count(&self, count: u64) -> Result<(), ReadError> {
        if count >= u64::from(u32::MAX) {
            return Err(self.scan.error(format!("{count} nodes are too many")));
        }
        Ok(())
    }

    fn nodes_old(&mut self) -> Result<(), ReadError> {
        let count = self.scan.tokens.count("the number of nodes")? as u64;
        self.scan.end_line();
        self.scan.fits(count, "the number of nodes", 8, 28)?;
        self.check_node_count(count)?;
        self.file.points.reserve(count as usize);
        for _ in 0..count {
            let tag = self.scan.int("the number of a node")?;
            let Ok(tag) = u64::try_from(tag) else {
                return Err(self.scan.error(format!("{tag} as the number of a node")));
            };
            self.point(tag)?;
        }
        Ok(())
    }

    fn nodes(&mut self) -> Result<(), ReadError> {
        let blocks = self.scan.count("the number of blocks", 8, 20)?;
        let total = self.scan.count("the number of nodes", 8, 32)?;
        self.check_node_count(total)?;
        self.scan.size("the smallest number")?;
        self.scan.size("the largest number")?;
        self.file.points.reserve(total as usize);
        for _ in 0..blocks {
            let dimension = self.scan.int("a dimension")?;
            self.scan.int("the number of an entity")?;
            let parametric = self.scan.int("whether there are parameters")? != 0;
            let count = self.scan.count("the number of nodes", 8, 32)?;
            if self.file.points.len() as u64 + count > total {
                return Err(self.scan.error(format!(
                    "its blocks have more nodes than the {total} announced"
                )));
            }
            let first = self.file.points.len() as u32;
            let mut tags = Vec::with_capacity(count as usize);
            for _ in 0..count {
                tags.push(self.scan.size("the number of a node")?);
            }
            let parameters = if parametric { dimension.clamp(0, 3) } else { 0 };
            for (index, tag) in (first..).zip(tags) {
                let p = DVec3::new(
                    self.scan.double()?,
                    self.scan.double()?,
                    self.scan.double()?,
                );
                self.file.points.push(p);
                for _ in 0..parameters {
                    if self.scan.binary {
                        self.scan.raw::<8>("a parameter")?;
                    } else {
                        self.scan.tokens.number()?;
                    }
                }
                self.number_node(tag, index)?;
            }
        }
        Ok(())
    }

    fn vertex(&self, tag: i64) -> Result<u32, ReadError> {
        let tag = u64::try_from(tag).unwrap_or(u64::MAX);
        let count = self.file.points.len() as u64;
        let found = match &self.file.index {
            Some(index) => index.get(&tag).copied(),
            None => (1..=count).contains(&tag).then(|| (tag - 1) as u32),
        };
        found.ok_or_else(|| {
            self.scan
                .error(format!("an element names node {tag}, which is not there"))
        })
    }

    /// Nodes of an element of this type.
    fn node_count(&self, kind: i64) -> Result<usize, ReadError> {
        let known = usize::try_from(kind)
            .ok()
            .and_then(|k| NODES.get(k).copied());
        known
            .filter(|&n| n > 0)
            .ok_or_else(|| self.scan.error(format!("element type {kind} is not known")))
    }

    /// Takes an element whose nodes come next.
    fn element(
        &mut self,
        kind: i64,
        group: Group,
        mut node: impl FnMut(&mut Self) -> Result<i64, ReadError>,
    ) -> Result<(), ReadError> {
        let count = self.node_count(kind)?;
        let corners_of_other = match kind {
            5 | 12 | 17 => 8,
            6 | 13 | 18 => 6,
            7 | 14 | 19 => 5,
            _ => 0,
        };
        if corners_of_other > 0 && self.file.views.is_some() {
            let mut cell = Vec::with_capacity(corners_of_other);
            for i in 0..count {
                let tag = node(self)?;
                if i < corners_of_other {
                    cell.push(self.vertex(tag)?);
                }
            }
            self.file.others.push(cell);
            return Ok(());
        }
        let (corners, surface) = match kind {
            2 | 9 => (3, true),
            3 | 10 | 16 => (4, true),
            4 | 11 => (4, false),
            // Points and lines say nothing here.
            1 | 8 | 15 | 26..=28 => (0, true),
            other => {
                return Err(self.scan.error(format!(
                    "element type {other}: only points, lines, triangles, quadrilaterals and \
                     tetrahedra are read, of first and second order"
                )));
            }
        };
        let mut v = [0; 4];
        for corner in &mut v[..corners] {
            let tag = node(self)?;
            *corner = self.vertex(tag)?;
        }
        for _ in corners..count {
            node(self)?;
        }
        self.file.curved += usize::from(corners > 0 && count > corners);
        let [a, b, c, d] = v;
        match (corners, surface) {
            (3, _) => self.file.triangles.push(([a, b, c], group)),
            (4, true) => {
                self.file.triangles.push(([a, b, c], group));
                self.file.triangles.push(([a, c, d], group));
            }
            (4, false) => self.file.tets.push(([a, b, c, d], group)),
            _ => {}
        }
        Ok(())
    }

    fn elements_old(&mut self) -> Result<(), ReadError> {
        let count = self.scan.tokens.count("the number of elements")? as u64;
        self.scan.end_line();
        self.scan.fits(count, "the number of elements", 6, 8)?;
        let mut left = count;
        while left > 0 {
            let (kind, followers, tags);
            if self.scan.binary {
                kind = self.scan.int("an element type")?;
                followers = self.scan.int("the number of elements of one type")?;
                tags = self.scan.int("the number of tags")?;
                if followers <= 0 || followers as u64 > left {
                    return Err(self.scan.error(format!(
                        "{followers} elements of one type, and {left} are left"
                    )));
                }
            } else {
                self.scan.tokens.integer("the number of an element")?;
                kind = self.scan.tokens.integer("an element type")?;
                tags = self.scan.tokens.integer("the number of tags")?;
                followers = 1;
            }
            if !(0..=1_000_000).contains(&tags) {
                return Err(self.scan.error(format!("{tags} tags")));
            }
            for _ in 0..followers {
                if self.scan.binary {
                    self.scan.int("the number of an element")?;
                }
                let mut group = Group {
                    physical: 0,
                    entity: 0,
                };
                for i in 0..tags {
                    let tag = self.scan.int("a tag")?.saturating_abs();
                    match i {
                        0 => group.physical = tag,
                        1 => group.entity = tag,
                        _ => {}
                    }
                }
                self.element(kind, group, |reader| reader.scan.int("a node"))?;
            }
            left -= followers as u64;
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<(), ReadError> {
        let blocks = self.scan.count("the number of blocks", 8, 20)?;
        for what in [
            "the number of elements",
            "the smallest number",
            "the largest number",
        ] {
            self.scan.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = self.scan.int("a dimension")?;
            let entity = self.scan.int("the number of an entity")?;
            let kind = self.scan.int("an element type")?;
            let each = self.node_count(kind)? as u64 + 1;
            let count = self
                .scan
                .count("the number of elements", 2 * each, 8 * each)?;
            let physical = self.file.physical.get(&(dimension, entity));
            let group = Group {
                physical: physical.copied().unwrap_or(0),
                entity,
            };
            for _ in 0..count {
                self.scan.size("the number of an element")?;
                self.element(kind, group, |reader| {
                    let tag = reader.scan.size("a node")?;
                    Ok(i64::try_from(tag).unwrap_or(-1))
                })?;
            }
        }
        Ok(())
    }
}
