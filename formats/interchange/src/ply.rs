//! Stanford PLY: ASCII, binary little-endian and big-endian.

use crate::ReadError;
use crate::polygon::Polygons;
use crate::soup::{DOUBLE, Group, SINGLE, Soup};
use crate::tokens::{Tokens, shown};
use glam::DVec3;

/// Whether the bytes begin like a file of this format.
pub fn looks_like(head: &[u8]) -> bool {
    head.starts_with(b"ply\n") || head.starts_with(b"ply\r")
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn from_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value of little-endian bytes, as many as [`Scalar::size`]; exact.
    fn value(self, b: &[u8]) -> f64 {
        match self {
            Self::I8 => f64::from(b[0] as i8),
            Self::U8 => f64::from(b[0]),
            Self::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Self::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            Self::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::F64 => f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]),
        }
    }
}

struct Property {
    name: String,
    /// Type of the list's length, for a list.
    length: Option<Scalar>,
    scalar: Scalar,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<Soup, ReadError> {
    let (encoding, elements, mut values) = header(bytes)?;
    let vertices = elements
        .iter()
        .find(|e| e.name == "vertex")
        .ok_or_else(|| malformed("it has no vertices"))?;
    let column = |name: &str| {
        vertices
            .properties
            .iter()
            .position(|p| p.name == name && p.length.is_none())
            .ok_or_else(|| malformed(format!("its vertices have no property '{name}'")))
    };
    let columns = [column("x")?, column("y")?, column("z")?];
    let double = columns
        .iter()
        .all(|&c| vertices.properties[c].scalar == Scalar::F64);
    let count = vertices.count;
    let mut polygons = Polygons::new(count.min(values.left() / 3));
    // Faces may come before vertices: corner lists are kept until all is read.
    let mut corners: Vec<u32> = Vec::new();
    let mut sizes: Vec<u32> = Vec::new();
    for element in &elements {
        if element.properties.is_empty() {
            continue;
        }
        let is_vertex = element.name == "vertex";
        let list = element.properties.iter().position(|p| {
            p.length.is_some() && (p.name == "vertex_indices" || p.name == "vertex_index")
        });
        let list = list.filter(|_| element.name == "face");
        if element.name == "face" && list.is_none() {
            return Err(malformed("its faces have no list 'vertex_indices'"));
        }
        for row in 0..element.count {
            let mut point = [0.0; 3];
            for (i, property) in element.properties.iter().enumerate() {
                let n = match property.length {
                    None => 1,
                    Some(length) => {
                        let n = values.next(length, element, row)?;
                        if !(n >= 0.0 && n.fract() == 0.0) {
                            return Err(values.error(element, row, format!("a list of {n} items")));
                        }
                        n as usize
                    }
                };
                let is_list = list == Some(i);
                for _ in 0..n {
                    let value = values.next(property.scalar, element, row)?;
                    if is_list {
                        if !(value >= 0.0 && value < count as f64 && value.fract() == 0.0) {
                            let reason = format!(
                                "vertex {value} does not exist; there are {count}, counted from 0"
                            );
                            return Err(values.error(element, row, reason));
                        }
                        corners.push(value as u32);
                    } else if is_vertex && let Some(axis) = columns.iter().position(|&c| c == i) {
                        point[axis] = value;
                        values.note_precision(value);
                    }
                }
                if is_list {
                    sizes.push(n as u32);
                }
            }
            if is_vertex {
                let [x, y, z] = point;
                let point = DVec3::from(point);
                if !point.is_finite() {
                    return Err(values.error(
                        element,
                        row,
                        format!("the position is ({x}, {y}, {z})"),
                    ));
                }
                polygons.point(point);
            }
        }
    }
    if polygons.len() < count {
        return Err(malformed("its vertices are missing"));
    }
    let mut rest = corners.as_slice();
    for n in sizes {
        let (polygon, after) = rest.split_at(n as usize);
        polygons.polygon(polygon, 0);
        rest = after;
    }
    let precision = match encoding {
        Encoding::Ascii => values.tokens.precision().relative(),
        _ if double => DOUBLE,
        _ => SINGLE,
    };
    Ok(polygons.into_soup(vec![Group::default()], "group", precision))
}

fn malformed(reason: impl Into<String>) -> ReadError {
    ReadError::Malformed {
        format: "ply",
        reason: reason.into(),
    }
}

/// Encoding, elements, and what follows the header.
fn header(bytes: &[u8]) -> Result<(Encoding, Vec<Element>, Values<'_>), ReadError> {
    let mut tokens = Tokens::new(bytes, "ply", None);
    tokens.expect("ply")?;
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let Some(word) = tokens.next_word() else {
            return Err(tokens.error("the header has no 'end_header'"));
        };
        match word {
            b"format" => {
                encoding = Some(match tokens.word_on_line() {
                    Some(b"ascii") => Encoding::Ascii,
                    Some(b"binary_little_endian") => Encoding::Little,
                    Some(b"binary_big_endian") => Encoding::Big,
                    other => {
                        let other = shown(other.unwrap_or_default());
                        return Err(tokens.error(format!("the format '{other}' is not known")));
                    }
                });
            }
            b"comment" | b"obj_info" => {}
            b"element" => {
                let name = tokens.word_on_line().unwrap_or_default();
                let name = String::from_utf8_lossy(name).into_owned();
                let count = tokens.count("the number of elements")?;
                if elements.iter().any(|e| e.name == name) {
                    return Err(tokens.error(format!(
                        "element '{}' is there twice",
                        shown(name.as_bytes())
                    )));
                }
                elements.push(Element {
                    name,
                    count,
                    properties: Vec::new(),
                });
            }
            b"property" => {
                let property = property(&mut tokens)?;
                match elements.last_mut() {
                    Some(element) => element.properties.push(property),
                    None => return Err(tokens.error("a property before the first element")),
                }
            }
            b"end_header" => break,
            other => {
                return Err(tokens.error(format!("'{}' is not known in a header", shown(other))));
            }
        }
        tokens.rest_of_line();
    }
    tokens.rest_of_line();
    let Some(encoding) = encoding else {
        return Err(tokens.error("the header does not say the format"));
    };
    let data = &bytes[bytes.len() - tokens.left()..];
    // The line feed that ends the header.
    let data = data.get(1..).unwrap_or_default();
    let values = Values {
        encoding,
        data,
        tokens,
        word: b"",
    };
    Ok((encoding, elements, values))
}

fn property(tokens: &mut Tokens<'_>) -> Result<Property, ReadError> {
    let scalar = |tokens: &Tokens<'_>, word: Option<&[u8]>| {
        let word = word.unwrap_or_default();
        Scalar::from_name(word)
            .ok_or_else(|| tokens.error(format!("the type '{}' is not known", shown(word))))
    };
    let first = tokens.word_on_line();
    let (length, scalar) = if first == Some(b"list") {
        let length = tokens.word_on_line();
        let length = scalar(tokens, length)?;
        let item = tokens.word_on_line();
        (Some(length), scalar(tokens, item)?)
    } else {
        (None, scalar(tokens, first)?)
    };
    let name = tokens.word_on_line().unwrap_or_default();
    Ok(Property {
        name: String::from_utf8_lossy(name).into_owned(),
        length,
        scalar,
    })
}

/// The values after the header, one by one.
struct Values<'a> {
    encoding: Encoding,
    data: &'a [u8],
    tokens: Tokens<'a>,
    /// The last word, in ASCII.
    word: &'a [u8],
}

impl Values<'_> {
    fn left(&self) -> usize {
        self.data.len()
    }

    fn error(&self, element: &Element, row: usize, reason: impl std::fmt::Display) -> ReadError {
        if self.encoding == Encoding::Ascii {
            self.tokens.error(reason)
        } else {
            let (name, of) = (&element.name, element.count);
            malformed(format!("{name} {} of {of}: {reason}", row + 1))
        }
    }

    fn next(&mut self, scalar: Scalar, element: &Element, row: usize) -> Result<f64, ReadError> {
        let cut_off = "the file ends here";
        if self.encoding == Encoding::Ascii {
            let Some(word) = self.tokens.next_word() else {
                let (name, of) = (&element.name, element.count);
                let reason = format!("{cut_off}, at {name} {} of {of}", row + 1);
                return Err(self.tokens.error(reason));
            };
            self.word = word;
            return crate::tokens::number(word).ok_or_else(|| {
                self.tokens
                    .error(format!("'{}' is not a number", shown(word)))
            });
        }
        let Some((item, rest)) = self.data.split_at_checked(scalar.size()) else {
            return Err(self.error(element, row, cut_off));
        };
        self.data = rest;
        let mut little = [0; 8];
        little[..item.len()].copy_from_slice(item);
        if self.encoding == Encoding::Big {
            little[..item.len()].reverse();
        }
        Ok(scalar.value(&little))
    }

    fn note_precision(&mut self, value: f64) {
        if self.encoding == Encoding::Ascii {
            self.tokens.note(self.word, value);
        }
    }
}
