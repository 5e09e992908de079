//! Stanford PLY: ASCII, binary little-endian and big-endian.

use crate::ReadError;
use crate::binary::{Order, Scalar};
use crate::parsed::{Group, Parsed, Soup};
use crate::text::{DOUBLE, SINGLE, Tokens, number, shown};
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

fn scalar_of(name: &[u8]) -> Option<Scalar> {
    Some(match name {
        b"char" | b"int8" => Scalar::Signed(1),
        b"uchar" | b"uint8" => Scalar::Unsigned(1),
        b"short" | b"int16" => Scalar::Signed(2),
        b"ushort" | b"uint16" => Scalar::Unsigned(2),
        b"int" | b"int32" => Scalar::Signed(4),
        b"uint" | b"uint32" => Scalar::Unsigned(4),
        b"float" | b"float32" => Scalar::Float,
        b"double" | b"float64" => Scalar::Double,
        _ => return None,
    })
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
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let (encoding, elements, mut values) = header(bytes)?;
    let position = Position::of(&elements)?;
    let mut soup = Soup {
        points: Vec::with_capacity(position.count.min(values.left() / 3)),
        groups: vec![Group::default()],
        group_word: "group",
        ..Soup::default()
    };
    let mut polygon = Vec::new();
    for element in &elements {
        if element.properties.is_empty() {
            continue;
        }
        let list = polygon_list(element)?;
        for row in 0..element.count {
            let at = Row { element, row };
            let point = read_row(&mut values, &at, &position, list, &mut polygon)?;
            soup.points.extend(point);
            if list.is_some() {
                soup.faces.add(&polygon);
            }
        }
    }
    if soup.points.len() < position.count {
        return Err(malformed("its vertices are missing"));
    }
    soup.relative_precision = match encoding {
        Encoding::Ascii => values.tokens.precision().relative(),
        _ if position.double => DOUBLE,
        _ => SINGLE,
    };
    if encoding == Encoding::Ascii {
        soup.printed_precision = values.tokens.precision().printed();
    }
    Ok(Parsed::Soup(soup))
}

/// Where the coordinates of vertices are.
struct Position {
    /// Properties of a vertex that are x, y and z.
    columns: [usize; 3],
    /// Number of vertices announced.
    count: usize,
    /// Whether all three are of double precision.
    double: bool,
}

impl Position {
    fn of(elements: &[Element]) -> Result<Self, ReadError> {
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
        let is_double = |c: &usize| vertices.properties[*c].scalar == Scalar::Double;
        Ok(Self {
            count: vertices.count,
            double: columns.iter().all(is_double),
            columns,
        })
    }
}

/// The property that lists the corners of a face; none of other elements.
fn polygon_list(element: &Element) -> Result<Option<usize>, ReadError> {
    if element.name != "face" {
        return Ok(None);
    }
    let is_list = |p: &Property| {
        p.length.is_some() && (p.name == "vertex_indices" || p.name == "vertex_index")
    };
    match element.properties.iter().position(is_list) {
        Some(list) => Ok(Some(list)),
        None => Err(malformed("its faces have no list 'vertex_indices'")),
    }
}

/// One of the items of an element.
struct Row<'a> {
    element: &'a Element,
    row: usize,
}

/// Reads one item: the position of a vertex, or the corners of a face, which replace those in `polygon`.
/// Faces may come before vertices, so corners are checked against the number announced.
fn read_row(
    values: &mut Values<'_>,
    at: &Row<'_>,
    position: &Position,
    list: Option<usize>,
    polygon: &mut Vec<u32>,
) -> Result<Option<DVec3>, ReadError> {
    let is_vertex = at.element.name == "vertex";
    let count = position.count;
    let mut point = [0.0; 3];
    polygon.clear();
    for (i, property) in at.element.properties.iter().enumerate() {
        let n = match property.length {
            None => 1,
            Some(length) => {
                let n = values.next(length, at)?;
                if !(n >= 0.0 && n.fract() == 0.0) {
                    return Err(values.error(at, format!("a list of {n} items")));
                }
                n as usize
            }
        };
        for _ in 0..n {
            let value = values.next(property.scalar, at)?;
            if list == Some(i) {
                if !(value >= 0.0 && value < count as f64 && value.fract() == 0.0) {
                    let reason =
                        format!("vertex {value} does not exist; there are {count}, counted from 0");
                    return Err(values.error(at, reason));
                }
                polygon.push(value as u32);
            } else if is_vertex && let Some(axis) = position.columns.iter().position(|&c| c == i) {
                point[axis] = value;
                values.note_precision(value);
            }
        }
    }
    if !is_vertex {
        return Ok(None);
    }
    let [x, y, z] = point;
    let point = DVec3::from(point);
    if !point.is_finite() {
        return Err(values.error(at, format!("the position is ({x}, {y}, {z})")));
    }
    Ok(Some(point))
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
        scalar_of(word)
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

    fn error(&self, at: &Row<'_>, reason: impl std::fmt::Display) -> ReadError {
        if self.encoding == Encoding::Ascii {
            self.tokens.error(reason)
        } else {
            let (name, of) = (&at.element.name, at.element.count);
            malformed(format!("{name} {} of {of}: {reason}", at.row + 1))
        }
    }

    fn next(&mut self, scalar: Scalar, at: &Row<'_>) -> Result<f64, ReadError> {
        let cut_off = "the file ends here";
        if self.encoding == Encoding::Ascii {
            let Some(word) = self.tokens.next_word() else {
                let (name, of) = (&at.element.name, at.element.count);
                let reason = format!("{cut_off}, at {name} {} of {of}", at.row + 1);
                return Err(self.tokens.error(reason));
            };
            self.word = word;
            return number(word).ok_or_else(|| {
                self.tokens
                    .error(format!("'{}' is not a number", shown(word)))
            });
        }
        let Some((item, rest)) = self.data.split_at_checked(scalar.size()) else {
            return Err(self.error(at, cut_off));
        };
        self.data = rest;
        let order = if self.encoding == Encoding::Big {
            Order::Big
        } else {
            Order::Little
        };
        Ok(scalar.value(item, order))
    }

    fn note_precision(&mut self, value: f64) {
        if self.encoding == Encoding::Ascii {
            self.tokens.note(self.word, value);
        }
    }
}
