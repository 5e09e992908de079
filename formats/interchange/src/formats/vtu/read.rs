//! Reader of VTK XML unstructured grids of one piece: the tags, by way of `quick-xml`.

use super::arrays::{Appended, Array, Arrays, Encoding, Place, malformed};
use crate::ReadError;
use crate::binary::{Order, Scalar, id};
use crate::formats::vtk::fields::{NAMES, take_names};
use crate::parsed::{Grid, Parsed, PointMesh, SOURCE, SYMMETRY};
use crate::text::{DOUBLE, SINGLE, shown};
use glam::DVec3;
use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};
use std::borrow::Cow;

/// Bytes of the first tag within which its attribute `type` is looked for: writers put it first, and
/// the tag with all attributes that the format has is shorter.
const FIRST_TAG: usize = 400;

/// Whether the bytes begin like a file of this format.
pub fn looks_like(head: &[u8]) -> bool {
    find(head, b"<VTKFile").is_some_and(|at| {
        let tag = &head[at..head.len().min(at + FIRST_TAG)];
        find(tag, b"\"UnstructuredGrid\"").is_some()
    })
}

fn find(bytes: &[u8], what: &[u8]) -> Option<usize> {
    bytes.windows(what.len()).position(|part| part == what)
}

/// Reads a file.
///
/// # Errors
/// Tags that are no XML, several pieces, arrays of unknown types or beyond the end of the file.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    grid(bytes, false)?.parsed("vtu")
}

/// Reads the mesh of a file with the numbers at its points.
///
/// # Errors
/// As [`read`].
pub fn read_points(bytes: &[u8]) -> Result<PointMesh, ReadError> {
    grid(bytes, true)?.point_mesh("vtu")
}

fn grid(bytes: &[u8], keeps_points: bool) -> Result<Grid, ReadError> {
    let mut tags = Tags::new(bytes);
    tags.keeps_points = keeps_points;
    let root = tags.root()?;
    let listed = tags.arrays()?;
    let is_compressed = root.compressed;
    let arrays = Arrays::new(root, listed.appended, bytes.len());
    let mut grid = Grid::default();
    let mut types = None;
    let mut on_points = Vec::new();
    // Arrays that share their data could be any number; compressed ones have a bound of their own.
    let mut left = match is_compressed {
        true => usize::MAX,
        false => bytes.len(),
    };
    for array in &listed.arrays {
        let values = arrays.values(array)?;
        if array.section == "PointData" {
            left = left.checked_sub(values.len()).ok_or_else(|| {
                malformed("its arrays at points have more numbers than the file has bytes")
            })?;
            // The points may come later.
            on_points.push((array, values));
            continue;
        }
        take(&mut grid, &mut types, array, values)?;
    }
    if listed.pieces != 1 {
        let pieces = listed.pieces;
        return Err(malformed(format!(
            "it has {pieces} pieces; files with one are read"
        )));
    }
    grid.types = types.unwrap_or_default();
    if grid.types.len() != grid.ends.len() {
        return Err(malformed(format!(
            "{} cells have {} types",
            grid.ends.len(),
            grid.types.len()
        )));
    }
    for (array, values) in on_points {
        grid.take_point_data(array.name.clone(), values);
    }
    Ok(grid)
}

/// Puts the values of an array where the grid has them.
fn take(
    grid: &mut Grid,
    types: &mut Option<Vec<u8>>,
    array: &Array<'_>,
    values: Vec<f64>,
) -> Result<(), ReadError> {
    let ids = |values: &[f64]| values.iter().map(|&x| id(x)).collect();
    match (array.section.as_str(), array.name.as_str()) {
        ("Points", _) => {
            if !values.len().is_multiple_of(3) {
                return Err(malformed("the points do not have three coordinates"));
            }
            let single = array.scalar == Some(Scalar::Float);
            grid.relative_precision = if single { SINGLE } else { DOUBLE };
            let point = |p: &[f64]| DVec3::new(p[0], p[1], p[2]);
            grid.points = values.chunks_exact(3).map(point).collect();
        }
        ("Cells", "connectivity") => grid.connectivity = ids(&values),
        ("Cells", "offsets") => grid.ends = values.iter().map(|&x| x as usize).collect(),
        ("Cells", _) => *types = Some(values.iter().map(|&x| x as u8).collect()),
        ("FieldData", "title") => grid.title = text(&values),
        ("FieldData", name) if NAMES.contains(&name) => {
            let ids: Vec<u32> = ids(&values);
            take_names(grid, name, &ids, &array.components);
        }
        ("FieldData", name) => {
            grid.texts.insert(name.to_owned(), text(&values));
        }
        (_, name) => {
            grid.cell_data.insert(name.to_owned(), ids(&values));
        }
    }
    Ok(())
}

fn text(values: &[f64]) -> String {
    let bytes: Vec<u8> = values.iter().map(|&x| x as u8).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The arrays of a section that the grid is made of. Points may have any name.
fn is_wanted(section: &str, name: &str) -> bool {
    match section {
        "Points" => true,
        "Cells" => matches!(name, "connectivity" | "offsets" | "types"),
        "CellData" => matches!(name, "region" | "marker" | "front" | "back"),
        "FieldData" => NAMES.contains(&name) || ["title", SYMMETRY, SOURCE].contains(&name),
        _ => false,
    }
}

/// What the elements list.
struct Listed<'a> {
    arrays: Vec<Array<'a>>,
    pieces: usize,
    appended: Appended<'a>,
}

/// The tags of a file, up to the appended data.
struct Tags<'a> {
    bytes: &'a [u8],
    xml: quick_xml::Reader<&'a [u8]>,
    /// Whether arrays on points are wanted.
    keeps_points: bool,
}

impl<'a> Tags<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let mut xml = quick_xml::Reader::from_reader(bytes);
        // Only opening tags matter, and files that are cut off later may be read.
        xml.config_mut().check_end_names = false;
        Self {
            bytes,
            xml,
            keeps_points: false,
        }
    }

    /// The position behind what was read last.
    fn at(&self) -> usize {
        (self.xml.buffer_position() as usize).min(self.bytes.len())
    }

    /// The next opening tag, and whether its element has content; none at the end.
    fn open(&mut self) -> Result<Option<(BytesStart<'a>, bool)>, ReadError> {
        loop {
            match self.xml.read_event() {
                Ok(Event::Start(tag)) => return Ok(Some((tag, true))),
                Ok(Event::Empty(tag)) => return Ok(Some((tag, false))),
                Ok(Event::Eof) => return Ok(None),
                Ok(_) => {}
                Err(error) => {
                    let at = self.xml.error_position();
                    return Err(malformed(format!("byte {at}: {error}")));
                }
            }
        }
    }

    fn attribute(&self, tag: &BytesStart<'a>, name: &str) -> Result<Option<String>, ReadError> {
        let found = tag.try_get_attribute(name).map_err(|error| {
            let at = self.at();
            malformed(format!("the tag that ends at byte {at}: {error}"))
        })?;
        Ok(found.map(|attribute| attribute.value.into_owned()))
    }

    fn root(&mut self) -> Result<Encoding, ReadError> {
        let tag = loop {
            match self.open()? {
                Some((tag, _)) if tag.name().as_ref() == "VTKFile" => break tag,
                Some(_) => {}
                None => return Err(malformed("it has no element 'VTKFile'")),
            }
        };
        let kind = self.attribute(&tag, "type")?.unwrap_or_default();
        if kind != "UnstructuredGrid" {
            return Err(malformed(format!(
                "only the type UnstructuredGrid is read, this is '{}'",
                shown(kind.as_bytes())
            )));
        }
        let compressed = match self.attribute(&tag, "compressor")?.as_deref() {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                return Err(malformed(format!(
                    "arrays compressed by {} are not read; those by zlib are",
                    shown(other.as_bytes())
                )));
            }
        };
        let big = self.attribute(&tag, "byte_order")?.as_deref() == Some("BigEndian");
        let wide = self.attribute(&tag, "header_type")?.as_deref() == Some("UInt64");
        Ok(Encoding {
            order: if big { Order::Big } else { Order::Little },
            header: if wide { 8 } else { 4 },
            compressed,
        })
    }

    /// The arrays that are wanted, each once: no file makes more work than its size.
    fn arrays(&mut self) -> Result<Listed<'a>, ReadError> {
        let mut section = String::new();
        let mut listed = Listed {
            arrays: Vec::new(),
            pieces: 0,
            appended: Appended::default(),
        };
        while let Some((tag, has_content)) = self.open()? {
            let element = tag.name();
            match element.as_ref() {
                "Piece" => listed.pieces += 1,
                "FieldData" | "Points" | "Cells" | "CellData" | "PointData" => {
                    section = element.as_ref().to_owned();
                }
                "DataArray" => {
                    let name = self.attribute(&tag, "Name")?.unwrap_or_default();
                    let on_points = section == "PointData" && self.keeps_points;
                    if !on_points && !is_wanted(&section, &name) {
                        continue;
                    }
                    let same = |a: &Array<'_>| {
                        a.section == section && (section == "Points" || a.name == name)
                    };
                    if listed.arrays.iter().any(same) {
                        return Err(malformed(format!("array '{name}' is there twice")));
                    }
                    let array = self.array(&tag, &section, name, has_content)?;
                    // Texts at points are no numbers.
                    if on_points && array.scalar.is_none() {
                        continue;
                    }
                    listed.arrays.push(array);
                }
                "AppendedData" => {
                    let raw = self.attribute(&tag, "encoding")?.as_deref() != Some("base64");
                    let rest = &self.bytes[self.at()..];
                    let mark = rest.iter().position(|&b| b == b'_');
                    let mark =
                        mark.ok_or_else(|| malformed("the appended data do not begin with '_'"))?;
                    listed.appended = Appended {
                        data: &rest[mark + 1..],
                        raw,
                    };
                    // What follows is no XML.
                    break;
                }
                _ => {}
            }
        }
        Ok(listed)
    }

    fn array(
        &self,
        tag: &BytesStart<'a>,
        section: &str,
        name: String,
        has_content: bool,
    ) -> Result<Array<'a>, ReadError> {
        let rest = &self.bytes[self.at()..];
        let length = rest.iter().position(|&b| b == b'<').unwrap_or(rest.len());
        let content = if has_content { &rest[..length] } else { &[] };
        let place = match self.attribute(tag, "format")?.as_deref() {
            Some("appended") => {
                let offset = self.attribute(tag, "offset")?;
                Place::Appended(offset.and_then(|o| o.parse().ok()))
            }
            Some("binary") => Place::Base64(content),
            _ => Place::Text(content),
        };
        let mut components = Vec::new();
        while let Some(name) = self.attribute(tag, &format!("ComponentName{}", components.len()))? {
            components.push(unescape(&name).map_or(name.clone(), Cow::into_owned));
        }
        let kind = self.attribute(tag, "type")?.unwrap_or_default();
        Ok(Array {
            section: section.to_owned(),
            name,
            components,
            scalar: scalar(&kind),
            place,
        })
    }
}

fn scalar(name: &str) -> Option<Scalar> {
    Some(match name {
        "Int8" => Scalar::Signed(1),
        "Int16" => Scalar::Signed(2),
        "Int32" => Scalar::Signed(4),
        "Int64" => Scalar::Signed(8),
        "UInt8" => Scalar::Unsigned(1),
        "UInt16" => Scalar::Unsigned(2),
        "UInt32" => Scalar::Unsigned(4),
        "UInt64" => Scalar::Unsigned(8),
        "Float32" => Scalar::Float,
        "Float64" => Scalar::Double,
        _ => return None,
    })
}
