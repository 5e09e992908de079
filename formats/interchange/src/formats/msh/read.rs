//! Gmsh meshes, versions 2.0 to 2.2 and 4.1, binary and text: tetrahedral meshes, and surfaces.
//!
//! Format: Gmsh reference manual, "MSH file format" and "Legacy formats". Physical volumes are
//! regions, physical surfaces are markers; entities without a physical group count by themselves. Of
//! second-order elements the corners are read.

use super::node_data::{View, point_mesh};
use crate::ReadError;
use crate::parsed::{Grid, Parsed, PointMesh, Shells, TETRA, TRIANGLE, Volume, by_corners};
use crate::text::{DOUBLE, Tokens, plain, shown};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

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
    let precision = if reader.binary {
        DOUBLE
    } else {
        reader.tokens.precision().relative()
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
    let File {
        points,
        index,
        triangles,
        tets,
        others,
        views,
        ..
    } = reader.file;
    let mut mesh = PointMesh {
        points,
        ..PointMesh::default()
    };
    tets.iter().for_each(|(t, _)| mesh.add_volume(t));
    others.iter().for_each(|cell| mesh.add_volume(cell));
    triangles.iter().for_each(|(t, _)| mesh.add_face(t));
    Ok(point_mesh(mesh, index.as_ref(), views.unwrap_or_default()))
}

/// Vertices of each element type, by its number.
const NODES: [usize; 32] = [
    0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,
    6, 20, 35, 56,
];

/// What the file says, with points numbered from 0.
#[derive(Default)]
pub(super) struct File {
    points: Vec<DVec3>,
    /// Index of each node, unless nodes are numbered 1, 2, 3, ...
    index: Option<FxHashMap<u64, u32>>,
    triangles: Vec<([u32; 3], Group)>,
    tets: Vec<([u32; 4], Group)>,
    names: BTreeMap<(i64, i64), String>,
    /// Physical group of each entity, by dimension and number; of version 4.1.
    physical: FxHashMap<(i64, i64), i64>,
    /// Surfaces around each volume; of version 4.1.
    volumes: Vec<(i64, Vec<i64>)>,
    curved: usize,
    /// What a comment says, if anything.
    title: String,
    /// Numbers at nodes, if they are wanted.
    pub(super) views: Option<Vec<View>>,
    /// Cells of volume that are no tetrahedra, if numbers at nodes are wanted.
    others: Vec<Vec<u32>>,
}

/// Physical group, or 0, and entity of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Group {
    physical: i64,
    entity: i64,
}

impl Group {
    /// Elements with the same key belong together.
    fn key(self) -> (bool, i64) {
        if self.physical == 0 {
            (true, self.entity)
        } else {
            (false, self.physical)
        }
    }
}

pub(super) struct Reader<'a> {
    pub(super) tokens: Tokens<'a>,
    bytes: &'a [u8],
    pub(super) binary: bool,
    pub(super) big: bool,
    /// Version 2.
    old: bool,
    pub(super) file: File,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            tokens: Tokens::new(bytes, "msh", None),
            bytes,
            binary: false,
            big: false,
            old: false,
            file: File::default(),
        }
    }
}

impl Reader<'_> {
    fn read(&mut self) -> Result<(), ReadError> {
        let mut known = false;
        let mut seen = BTreeSet::new();
        while let Some(word) = self.tokens.next_word() {
            let Some(section) = word.strip_prefix(b"$") else {
                return Err(self.tokens.error(format!(
                    "a section that begins with '$' expected, found '{}'",
                    shown(word)
                )));
            };
            if section == b"NodeData" && self.file.views.is_some() {
                self.end_line();
                self.node_data()?;
                self.tokens.expect("$EndNodeData")?;
                continue;
            }
            let wanted = matches!(
                section,
                b"MeshFormat" | b"PhysicalNames" | b"Entities" | b"Nodes" | b"Elements"
            );
            if !wanted {
                let text = self.skip_section(section)?;
                if section == b"Comments" {
                    self.file.title = String::from_utf8_lossy(text.trim_ascii()).into_owned();
                }
                continue;
            }
            if !seen.insert(section) {
                let name = shown(section);
                return Err(self.tokens.error(format!("section '{name}' comes twice")));
            }
            if !known && section != b"MeshFormat" {
                return Err(self
                    .tokens
                    .error("it does not begin with the section MeshFormat"));
            }
            self.end_line();
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
            self.tokens
                .expect(&format!("$End{}", String::from_utf8_lossy(section)))?;
        }
        if !known {
            return Err(self.tokens.error("it has no section MeshFormat"));
        }
        for section in [&b"Nodes"[..], b"Elements"] {
            if !seen.contains(section) {
                let name = shown(section);
                return Err(self.tokens.error(format!("it has no section {name}")));
            }
        }
        Ok(())
    }

    /// Passes over a section whatever bytes it holds.
    fn skip_section(&mut self, section: &[u8]) -> Result<&[u8], ReadError> {
        let end = [b"\n$End", section].concat();
        let rest = &self.bytes[self.at()..];
        let ends = |at: &usize| {
            let next = rest.get(at + end.len());
            next.is_none_or(u8::is_ascii_whitespace)
        };
        let found = rest.windows(end.len()).enumerate();
        let found = found.filter(|(_, part)| *part == end).map(|(at, _)| at);
        let first = found.into_iter().find(ends);
        let Some(at) = first else {
            let name = shown(section);
            return Err(self.tokens.error(format!("section '{name}' does not end")));
        };
        self.tokens.skip(at + end.len());
        Ok(&rest[..at])
    }

    fn at(&self) -> usize {
        self.bytes.len() - self.tokens.left()
    }

    pub(super) fn end_line(&mut self) {
        self.tokens.rest_of_line();
        self.tokens.skip(1);
    }

    fn format(&mut self) -> Result<(), ReadError> {
        let version = self.tokens.next_word().unwrap_or_default();
        self.old = match version {
            b"2" | b"2.0" | b"2.1" | b"2.2" => true,
            b"4.1" => false,
            other => {
                return Err(self.tokens.error(format!(
                    "version '{}' is not read; versions 2.2 and 4.1 are",
                    shown(other)
                )));
            }
        };
        self.binary = match self.tokens.integer("the file type")? {
            0 => false,
            1 => true,
            other => return Err(self.tokens.error(format!("file type {other}, not 0 or 1"))),
        };
        let size = self.tokens.integer("the size of numbers")?;
        if size != 8 {
            return Err(self
                .tokens
                .error(format!("numbers of {size} bytes; those of 8 are read")));
        }
        if self.binary {
            self.tokens.count_bytes();
            self.end_line();
            let one = self.raw::<4>("the mark of the byte order")?;
            self.big = match (u32::from_le_bytes(one), u32::from_be_bytes(one)) {
                (1, _) => false,
                (_, 1) => true,
                _ => {
                    return Err(self.tokens.error("the mark of the byte order is not 1"));
                }
            };
        }
        Ok(())
    }

    pub(super) fn raw<const N: usize>(&mut self, what: &str) -> Result<[u8; N], ReadError> {
        let at = self.at();
        let found = self.bytes[at..].first_chunk::<N>();
        let Some(&bytes) = found else {
            return Err(self
                .tokens
                .error(format!("{what} expected, but the file ends here")));
        };
        // The line counter minds line feeds that are skipped one by one only.
        self.tokens.skip(N);
        Ok(bytes)
    }

    /// A 32-bit number of a binary file.
    pub(super) fn int(&mut self, what: &str) -> Result<i64, ReadError> {
        if !self.binary {
            return self.tokens.integer(what);
        }
        let bytes = self.raw::<4>(what)?;
        let value = if self.big {
            i32::from_be_bytes(bytes)
        } else {
            i32::from_le_bytes(bytes)
        };
        Ok(i64::from(value))
    }

    /// A 64-bit number of a binary file.
    fn size(&mut self, what: &str) -> Result<u64, ReadError> {
        if !self.binary {
            return Ok(self.tokens.count(what)? as u64);
        }
        let bytes = self.raw::<8>(what)?;
        Ok(if self.big {
            u64::from_be_bytes(bytes)
        } else {
            u64::from_le_bytes(bytes)
        })
    }

    fn double(&mut self) -> Result<f64, ReadError> {
        if !self.binary {
            return self.tokens.coordinate();
        }
        let bytes = self.raw::<8>("a coordinate")?;
        let value = if self.big {
            f64::from_be_bytes(bytes)
        } else {
            f64::from_le_bytes(bytes)
        };
        if !value.is_finite() {
            return Err(self
                .tokens
                .error(format!("the coordinate {value} is not finite")));
        }
        Ok(value)
    }

    /// A count of things that take so many bytes each at least, in either mode.
    fn count(&mut self, what: &str, text: u64, binary: u64) -> Result<u64, ReadError> {
        let count = self.size(what)?;
        self.fits(count, what, text, binary)?;
        Ok(count)
    }

    pub(super) fn fits(
        &self,
        count: u64,
        what: &str,
        text: u64,
        binary: u64,
    ) -> Result<(), ReadError> {
        let each = if self.binary { binary } else { text };
        let left = self.tokens.left() as u64;
        // The last word of a text needs no space after it.
        if count.saturating_mul(each) > left.saturating_add(1) {
            return Err(self
                .tokens
                .error(format!("{count} as {what}, and {left} bytes are left")));
        }
        Ok(())
    }

    fn names(&mut self) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of names")?;
        for _ in 0..count {
            let dimension = self.tokens.integer("a dimension")?;
            let tag = self.tokens.integer("the number of a group")?;
            let rest = self.tokens.rest_of_line();
            let name = rest.strip_prefix(b"\"").and_then(|r| r.strip_suffix(b"\""));
            let Some(name) = name else {
                return Err(self.tokens.error(format!(
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
            return Err(self.tokens.error("version 2 has no section Entities"));
        }
        let mut counts = [0; 4];
        for (count, what) in counts.iter_mut().zip([
            "the number of points",
            "the number of curves",
            "the number of surfaces",
            "the number of volumes",
        ]) {
            *count = self.count(what, 2, 4)?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                let tag = self.int("the number of an entity")?;
                let bounds = if dimension == 0 { 3 } else { 6 };
                for _ in 0..bounds {
                    // Entities without elements may have no proper bounds.
                    if self.binary {
                        self.raw::<8>("a bound")?;
                    } else {
                        self.tokens.number()?;
                    }
                }
                let groups = self.count("the number of groups", 2, 4)?;
                for i in 0..groups {
                    let group = self.int("the number of a group")?;
                    if i == 0 {
                        self.file
                            .physical
                            .insert((dimension, tag), group.saturating_abs());
                    }
                }
                if dimension == 0 {
                    continue;
                }
                let around = self.count("the number of bounding entities", 2, 4)?;
                let mut bounding = Vec::new();
                for _ in 0..around {
                    bounding.push(self.int("a bounding entity")?.saturating_abs());
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
        let p = DVec3::new(self.double()?, self.double()?, self.double()?);
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
            Some(_) => Err(self.tokens.error(format!("node {tag} comes twice"))),
            None => Ok(()),
        }
    }

    fn check_node_count(&self, count: u64) -> Result<(), ReadError> {
        if count >= u64::from(u32::MAX) {
            return Err(self.tokens.error(format!("{count} nodes are too many")));
        }
        Ok(())
    }

    fn nodes_old(&mut self) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of nodes")? as u64;
        self.end_line();
        self.fits(count, "the number of nodes", 8, 28)?;
        self.check_node_count(count)?;
        self.file.points.reserve(count as usize);
        for _ in 0..count {
            let tag = self.int("the number of a node")?;
            let Ok(tag) = u64::try_from(tag) else {
                return Err(self.tokens.error(format!("{tag} as the number of a node")));
            };
            self.point(tag)?;
        }
        Ok(())
    }

    fn nodes(&mut self) -> Result<(), ReadError> {
        let blocks = self.count("the number of blocks", 8, 20)?;
        let total = self.count("the number of nodes", 8, 32)?;
        self.check_node_count(total)?;
        self.size("the smallest number")?;
        self.size("the largest number")?;
        self.file.points.reserve(total as usize);
        for _ in 0..blocks {
            let dimension = self.int("a dimension")?;
            self.int("the number of an entity")?;
            let parametric = self.int("whether there are parameters")? != 0;
            let count = self.count("the number of nodes", 8, 32)?;
            if self.file.points.len() as u64 + count > total {
                return Err(self.tokens.error(format!(
                    "its blocks have more nodes than the {total} announced"
                )));
            }
            let first = self.file.points.len() as u32;
            let mut tags = Vec::with_capacity(count as usize);
            for _ in 0..count {
                tags.push(self.size("the number of a node")?);
            }
            let parameters = if parametric { dimension.clamp(0, 3) } else { 0 };
            for (index, tag) in (first..).zip(tags) {
                let p = DVec3::new(self.double()?, self.double()?, self.double()?);
                self.file.points.push(p);
                for _ in 0..parameters {
                    if self.binary {
                        self.raw::<8>("a parameter")?;
                    } else {
                        self.tokens.number()?;
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
            self.tokens
                .error(format!("an element names node {tag}, which is not there"))
        })
    }

    /// Nodes of an element of this type.
    fn node_count(&self, kind: i64) -> Result<usize, ReadError> {
        let known = usize::try_from(kind)
            .ok()
            .and_then(|k| NODES.get(k).copied());
        known.filter(|&n| n > 0).ok_or_else(|| {
            self.tokens
                .error(format!("element type {kind} is not known"))
        })
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
                return Err(self.tokens.error(format!(
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
        let count = self.tokens.count("the number of elements")? as u64;
        self.end_line();
        self.fits(count, "the number of elements", 6, 8)?;
        let mut left = count;
        while left > 0 {
            let (kind, followers, tags);
            if self.binary {
                kind = self.int("an element type")?;
                followers = self.int("the number of elements of one type")?;
                tags = self.int("the number of tags")?;
                if followers <= 0 || followers as u64 > left {
                    return Err(self.tokens.error(format!(
                        "{followers} elements of one type, and {left} are left"
                    )));
                }
            } else {
                self.tokens.integer("the number of an element")?;
                kind = self.tokens.integer("an element type")?;
                tags = self.tokens.integer("the number of tags")?;
                followers = 1;
            }
            if !(0..=1_000_000).contains(&tags) {
                return Err(self.tokens.error(format!("{tags} tags")));
            }
            for _ in 0..followers {
                if self.binary {
                    self.int("the number of an element")?;
                }
                let mut group = Group {
                    physical: 0,
                    entity: 0,
                };
                for i in 0..tags {
                    let tag = self.int("a tag")?.saturating_abs();
                    match i {
                        0 => group.physical = tag,
                        1 => group.entity = tag,
                        _ => {}
                    }
                }
                self.element(kind, group, |reader| reader.int("a node"))?;
            }
            left -= followers as u64;
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<(), ReadError> {
        let blocks = self.count("the number of blocks", 8, 20)?;
        for what in [
            "the number of elements",
            "the smallest number",
            "the largest number",
        ] {
            self.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = self.int("a dimension")?;
            let entity = self.int("the number of an entity")?;
            let kind = self.int("an element type")?;
            let each = self.node_count(kind)? as u64 + 1;
            let count = self.count("the number of elements", 2 * each, 8 * each)?;
            let physical = self.file.physical.get(&(dimension, entity));
            let group = Group {
                physical: physical.copied().unwrap_or(0),
                entity,
            };
            for _ in 0..count {
                self.size("the number of an element")?;
                self.element(kind, group, |reader| {
                    let tag = reader.size("a node")?;
                    Ok(i64::try_from(tag).unwrap_or(-1))
                })?;
            }
        }
        Ok(())
    }
}

impl File {
    fn build(self, precision: f64) -> Result<Parsed, ReadError> {
        if self.tets.is_empty() {
            Ok(Parsed::Shells(self.surface(precision)))
        } else {
            self.volume(precision)
        }
    }

    /// Ids of groups and their names: the physical group's number, or a free one.
    fn ids(
        &self,
        dimension: i64,
        word: &str,
        groups: impl Iterator<Item = Group>,
    ) -> (FxHashMap<Group, u32>, Vec<(u32, String)>) {
        let groups: BTreeSet<Group> = groups.collect();
        let fits = |tag: i64| u32::try_from(tag).ok().filter(|&t| t != u32::MAX);
        let physical = groups.iter().filter_map(|g| fits(g.physical));
        let any = groups.iter().any(|g| g.physical != 0);
        let mut next = if any { physical.max().unwrap_or(0) } else { 0 };
        let mut ids = FxHashMap::default();
        let mut of_key: BTreeMap<(bool, i64), u32> = BTreeMap::new();
        let mut names = BTreeMap::new();
        for group in groups {
            let id = *of_key.entry(group.key()).or_insert_with(|| {
                let own = if any { group.physical } else { group.entity };
                match fits(own) {
                    Some(id) if own != 0 || !any => id,
                    _ => {
                        next = next.saturating_add(1).min(u32::MAX - 1);
                        next
                    }
                }
            });
            ids.insert(group, id);
            let name = self.names.get(&(dimension, group.physical));
            let name = name
                .filter(|n| group.physical != 0 && !n.is_empty())
                .cloned();
            names
                .entry(id)
                .or_insert_with(|| name.unwrap_or_else(|| format!("{word}{id}")));
        }
        (ids, names.into_iter().collect())
    }

    /// A tetrahedral mesh, with surface where the file has triangles.
    fn volume(self, precision: f64) -> Result<Parsed, ReadError> {
        let (region, regions) = self.ids(3, "region", self.tets.iter().map(|t| t.1));
        let (marker, markers) = self.ids(2, "marker", self.triangles.iter().map(|t| t.1));
        let lines = |names: &[(u32, String)]| -> String {
            let line = |(id, name): &(u32, String)| {
                format!("{id} {}\n", name.replace(|c: char| c.is_control(), " "))
            };
            names.iter().map(line).collect()
        };
        let mut grid = Grid {
            title: self.title,
            relative_precision: precision,
            notices: by_corners(self.curved).into_iter().collect(),
            ..Grid::default()
        };
        grid.texts
            .insert("region_names".to_owned(), lines(&regions));
        grid.texts
            .insert("marker_names".to_owned(), lines(&markers));
        let (mut region_of, mut marker_of) = (Vec::new(), Vec::new());
        for &(t, group) in &self.tets {
            grid.add(TETRA, &t);
            region_of.push(region[&group]);
            marker_of.push(u32::MAX);
        }
        for &(t, group) in &self.triangles {
            grid.add(TRIANGLE, &t);
            region_of.push(u32::MAX);
            marker_of.push(marker[&group]);
        }
        grid.cell_data.insert("region".to_owned(), region_of);
        grid.cell_data.insert("marker".to_owned(), marker_of);
        grid.points = self.points;
        grid.drop_unused_points();
        grid.parsed("msh")
    }

    fn surface(self, precision: f64) -> Shells {
        let (marker, markers) = self.ids(2, "surface", self.triangles.iter().map(|t| t.1));
        let named = |(&(dimension, tag), name): (&(i64, i64), &String)| {
            let id = u32::try_from(tag).ok().filter(|&id| id != u32::MAX)?;
            (dimension == 3).then(|| (id, name.clone()))
        };
        let names: BTreeMap<u32, String> = self.names.iter().filter_map(named).collect();
        let mut volumes: Vec<Volume> = self
            .volumes
            .iter()
            .filter_map(|(tag, around)| {
                let physical = *self.physical.get(&(3, *tag))?;
                let id = u32::try_from(physical).ok()?;
                Some(Volume {
                    id,
                    name: names.get(&id)?.clone(),
                    around: around.iter().copied().collect(),
                })
            })
            .collect();
        if volumes.is_empty() {
            // Version 2 has no entities; names of volumes may be there all the same.
            volumes = names
                .into_iter()
                .map(|(id, name)| Volume {
                    id,
                    name,
                    around: BTreeSet::new(),
                })
                .collect();
        }
        let triangles = self.triangles.iter();
        Shells {
            triangles: triangles
                .map(|&(t, group)| (t, marker[&group], group.entity))
                .collect(),
            points: self.points,
            markers,
            volumes,
            relative_precision: precision,
            notices: by_corners(self.curved).into_iter().collect(),
        }
    }
}
