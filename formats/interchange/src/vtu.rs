//! VTK XML unstructured grid: ASCII, base64 and raw appended arrays, plain or compressed with zlib; one
//! piece.
//!
//! Format: "VTK File Formats", section "XML File Formats".

use crate::ReadError;
use crate::grid::Grid;
use crate::soup::{DOUBLE, SINGLE};
use crate::tokens::{number, shown};
use flate2::{Decompress, FlushDecompress, Status};
use glam::DVec3;
use std::cell::Cell;
use std::collections::BTreeSet;

/// Whether the bytes begin like a file of this format.
pub fn looks_like(head: &[u8]) -> bool {
    find(head, b"<VTKFile", 0).is_some_and(|at| {
        let tag = &head[at..head.len().min(at + 400)];
        find(tag, b"\"UnstructuredGrid\"", 0).is_some()
    })
}

fn malformed(reason: impl Into<String>) -> ReadError {
    ReadError::Malformed {
        format: "vtu",
        reason: reason.into(),
    }
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<Grid, ReadError> {
    let begin =
        find(bytes, b"<VTKFile", 0).ok_or_else(|| malformed("it has no element 'VTKFile'"))?;
    let root = Tag::at(bytes, begin)?;
    if root.get("type") != Some("UnstructuredGrid") {
        let found = root.get("type").unwrap_or_default();
        return Err(malformed(format!(
            "only the type UnstructuredGrid is read, this is '{}'",
            shown(found.as_bytes())
        )));
    }
    let compressed = match root.get("compressor") {
        None | Some("") => false,
        Some("vtkZLibDataCompressor") => true,
        Some(other) => {
            return Err(malformed(format!(
                "arrays compressed by {} are not read; those by zlib are",
                shown(other.as_bytes())
            )));
        }
    };
    let big = root.get("byte_order") == Some("BigEndian");
    let wide = root.get("header_type") == Some("UInt64");
    let appended = find(bytes, b"<AppendedData", root.end);
    let (xml_end, appended) = match appended {
        None => (bytes.len(), Appended::default()),
        Some(at) => {
            let tag = Tag::at(bytes, at)?;
            let mark = find(bytes, b"_", tag.end)
                .ok_or_else(|| malformed("the appended data do not begin with '_'"))?;
            let appended = Appended {
                data: &bytes[mark + 1..],
                raw: tag.get("encoding") != Some("base64"),
            };
            (at, appended)
        }
    };
    let reader = Reader {
        xml: &bytes[..xml_end],
        appended,
        big,
        wide,
        compressed,
        budget: Cell::new(bytes.len().saturating_mul(EXPANSION).saturating_add(SLACK)),
    };
    reader.grid(root.end)
}

#[derive(Clone, Copy, Default)]
struct Appended<'a> {
    data: &'a [u8],
    raw: bool,
}

struct Reader<'a> {
    xml: &'a [u8],
    appended: Appended<'a>,
    big: bool,
    wide: bool,
    compressed: bool,
    /// Bytes that compressed arrays may still expand to.
    budget: Cell<usize>,
}

/// All arrays together expand to no more than this many times the file, and [`SLACK`] bytes: more than
/// any mesh does, and little enough for memory.
const EXPANSION: usize = 30;
const SLACK: usize = 1 << 22;

impl Reader<'_> {
    fn grid(&self, mut at: usize) -> Result<Grid, ReadError> {
        let mut grid = Grid::default();
        let mut section = String::new();
        let mut pieces = 0;
        let mut types = None;
        let mut seen = BTreeSet::new();
        while let Some(open) = find(self.xml, b"<", at) {
            let tag = Tag::at(self.xml, open)?;
            at = tag.end;
            match tag.name {
                b"Piece" => pieces += 1,
                b"FieldData" | b"Points" | b"Cells" | b"CellData" | b"PointData" => {
                    section = String::from_utf8_lossy(tag.name).into_owned();
                }
                b"DataArray" => {
                    let name = tag.get("Name").unwrap_or_default().to_owned();
                    let (wanted, single) = match (section.as_str(), name.as_str()) {
                        ("Points", _) => (true, tag.get("type") == Some("Float32")),
                        ("Cells", "connectivity" | "offsets" | "types") => (true, false),
                        ("CellData", "region" | "marker" | "front" | "back") => (true, false),
                        ("FieldData", "title" | "region_names" | "marker_names") => (true, false),
                        _ => (false, false),
                    };
                    if !wanted {
                        continue;
                    }
                    // Each array is decoded once: no file makes more work than its size.
                    let key = if section == "Points" {
                        ""
                    } else {
                        name.as_str()
                    };
                    if !seen.insert((section.clone(), key.to_owned())) {
                        return Err(malformed(format!("array '{name}' is there twice")));
                    }
                    let values = self.values(&tag, &name)?;
                    match (section.as_str(), name.as_str()) {
                        ("Points", _) => {
                            if values.len() % 3 != 0 {
                                return Err(malformed("the points do not have three coordinates"));
                            }
                            grid.relative_precision = if single { SINGLE } else { DOUBLE };
                            let point = |p: &[f64]| DVec3::new(p[0], p[1], p[2]);
                            grid.points = values.chunks_exact(3).map(point).collect();
                        }
                        ("Cells", "connectivity") => {
                            grid.connectivity = values.iter().map(|&x| id(x)).collect();
                        }
                        ("Cells", "offsets") => {
                            grid.ends = values.iter().map(|&x| x as usize).collect();
                        }
                        ("Cells", _) => {
                            types = Some(values.iter().map(|&x| x as u8).collect());
                        }
                        ("FieldData", "title") => grid.title = text(&values),
                        ("FieldData", _) => {
                            grid.texts.insert(name, text(&values));
                        }
                        _ => {
                            let values = values.iter().map(|&x| id(x)).collect();
                            grid.cell_data.insert(name, values);
                        }
                    }
                }
                _ => {}
            }
        }
        if pieces != 1 {
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
        Ok(grid)
    }

    fn values(&self, tag: &Tag<'_>, name: &str) -> Result<Vec<f64>, ReadError> {
        let kind = Kind::from_name(tag.get("type").unwrap_or_default())
            .ok_or_else(|| malformed(format!("array '{name}' has a type that is not known")))?;
        let content = &self.xml[tag.end..];
        let content = &content[..find(content, b"<", 0).unwrap_or(content.len())];
        match tag.get("format") {
            Some("appended") => {
                let offset: usize = tag
                    .get("offset")
                    .and_then(|o| o.parse().ok())
                    .ok_or_else(|| malformed(format!("array '{name}' has no offset")))?;
                let data = self.appended.data.get(offset..).unwrap_or_default();
                if self.appended.raw {
                    self.block(data, kind, name)
                } else {
                    self.block(&base64(data), kind, name)
                }
            }
            Some("binary") => self.block(&base64(content.trim_ascii()), kind, name),
            _ => content
                .split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty())
                .map(|w| {
                    number(w).ok_or_else(|| {
                        malformed(format!("array '{name}': '{}' is not a number", shown(w)))
                    })
                })
                .collect(),
        }
    }

    /// Numbers of a block: its size in bytes, then the bytes.
    fn block(&self, data: &[u8], kind: Kind, name: &str) -> Result<Vec<f64>, ReadError> {
        let header = if self.wide { 8 } else { 4 };
        if self.compressed {
            let items = self.inflate(data, header, name)?;
            return Ok(items
                .chunks_exact(kind.size())
                .map(|b| kind.value(b, self.big))
                .collect());
        }
        let header_kind = Kind::Unsigned(header);
        let items = data.split_at_checked(header).and_then(|(size, rest)| {
            let size = header_kind.value(size, self.big);
            (size <= rest.len() as f64).then(|| &rest[..size as usize])
        });
        let Some(items) = items else {
            return Err(malformed(format!(
                "array '{name}' goes beyond the end of the file"
            )));
        };
        Ok(items
            .chunks_exact(kind.size())
            .map(|b| kind.value(b, self.big))
            .collect())
    }
}

impl Reader<'_> {
    /// Bytes of a compressed block: the number of parts, the size of a part, that of the last one if it is
    /// smaller, the compressed sizes; then the parts.
    fn inflate(&self, data: &[u8], header: usize, name: &str) -> Result<Vec<u8>, ReadError> {
        let beyond = || malformed(format!("array '{name}' goes beyond the end of the file"));
        let number = |i: usize| {
            let at = i.checked_mul(header)?;
            let bytes = data.get(at..at.checked_add(header)?)?;
            Some(Kind::Unsigned(header).value(bytes, self.big) as usize)
        };
        let head = number(0).zip(number(1)).zip(number(2));
        let ((parts, size), last) = head.ok_or_else(beyond)?;
        if parts > data.len() / header {
            return Err(beyond());
        }
        let total = match (parts, last) {
            (0, _) => Some(0),
            (n, 0) => n.checked_mul(size),
            (n, last) => (n - 1).checked_mul(size).and_then(|t| t.checked_add(last)),
        };
        let left = total.and_then(|total| self.budget.get().checked_sub(total));
        let (Some(total), Some(left)) = (total, left) else {
            return Err(malformed(format!(
                "array '{name}' claims to expand to more than {EXPANSION} times the file"
            )));
        };
        self.budget.set(left);
        let mut at = (3 + parts) * header;
        let mut out = Vec::with_capacity(total);
        let damaged = || malformed(format!("array '{name}' is not compressed as it says"));
        for part in 0..parts {
            let compressed = number(3 + part).ok_or_else(beyond)?;
            let end = at.checked_add(compressed).ok_or_else(beyond)?;
            let bytes = data.get(at..end).ok_or_else(beyond)?;
            let expected = if part + 1 == parts && last != 0 {
                last
            } else {
                size
            };
            let before = out.len();
            // Never more than the total is written, for there is no capacity for it.
            let status = Decompress::new(true)
                .decompress_vec(bytes, &mut out, FlushDecompress::Finish)
                .map_err(|_| damaged())?;
            if status == Status::BufError || out.len() - before != expected {
                return Err(damaged());
            }
            at = end;
        }
        Ok(out)
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Signed(usize),
    Unsigned(usize),
    Float,
    Double,
}

impl Kind {
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "Int8" => Self::Signed(1),
            "Int16" => Self::Signed(2),
            "Int32" => Self::Signed(4),
            "Int64" => Self::Signed(8),
            "UInt8" => Self::Unsigned(1),
            "UInt16" => Self::Unsigned(2),
            "UInt32" => Self::Unsigned(4),
            "UInt64" => Self::Unsigned(8),
            "Float32" => Self::Float,
            "Float64" => Self::Double,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::Signed(n) | Self::Unsigned(n) => n,
            Self::Float => 4,
            Self::Double => 8,
        }
    }

    fn value(self, b: &[u8], big: bool) -> f64 {
        let mut raw = 0_u64;
        for i in 0..b.len() {
            let byte = if big { b[i] } else { b[b.len() - 1 - i] };
            raw = raw << 8 | u64::from(byte);
        }
        match self {
            Self::Unsigned(_) => raw as f64,
            Self::Signed(n) => {
                let shift = 64 - 8 * n as u32;
                ((raw << shift) as i64 >> shift) as f64
            }
            Self::Float => f64::from(f32::from_bits(raw as u32)),
            Self::Double => f64::from_bits(raw),
        }
    }
}

/// An opening tag.
struct Tag<'a> {
    name: &'a [u8],
    inside: &'a [u8],
    /// Just behind the tag.
    end: usize,
}

impl<'a> Tag<'a> {
    fn at(bytes: &'a [u8], open: usize) -> Result<Self, ReadError> {
        let rest = &bytes[open + 1..];
        let close = find(rest, b">", 0)
            .ok_or_else(|| malformed(format!("the tag at byte {open} does not end")))?;
        let inside = &rest[..close];
        let length = inside
            .iter()
            .position(|&b| b.is_ascii_whitespace() || b == b'/')
            .unwrap_or(close);
        Ok(Self {
            name: &inside[..length],
            inside: &inside[length..],
            end: open + close + 2,
        })
    }

    fn get(&self, attribute: &str) -> Option<&'a str> {
        let mut rest = std::str::from_utf8(self.inside).ok()?;
        while let Some((name, after)) = rest.split_once('=') {
            let after = after.trim_start();
            let quote = after.chars().next().filter(|q| *q == '"' || *q == '\'')?;
            let (value, next) = after[1..].split_once(quote)?;
            if name.trim() == attribute {
                return Some(value);
            }
            rest = next;
        }
        None
    }
}

fn find(bytes: &[u8], what: &[u8], from: usize) -> Option<usize> {
    let first = what[0];
    let mut at = from;
    loop {
        at += bytes.get(at..)?.iter().position(|&b| b == first)?;
        if bytes[at..].starts_with(what) {
            return Some(at);
        }
        at += 1;
    }
}

/// Bytes of a base64 text up to the first character that is none; padding may come in between, after
/// a header of its own.
fn base64(text: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut bits, mut count) = (0_u32, 0);
    for &c in text {
        let value = match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => {
                // The rest of the group is nothing.
                (bits, count) = (0, 0);
                continue;
            }
            _ if c.is_ascii_whitespace() => continue,
            _ => break,
        };
        bits = bits << 6 | u32::from(value);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    bytes
}

fn text(values: &[f64]) -> String {
    let bytes: Vec<u8> = values.iter().map(|&x| x as u8).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A point or region id; -1 becomes the largest one.
fn id(x: f64) -> u32 {
    if x < 0.0 { x as i64 as u32 } else { x as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_with_padding_inside() {
        assert_eq!(base64(b"BAAAAA==AQID BA=="), [4, 0, 0, 0, 1, 2, 3, 4]);
        assert_eq!(base64(b"TWFu<"), b"Man");
    }
}
