//! Stereolithography files: binary, and ASCII with any number of solids.

use crate::ReadError;
use crate::parsed::{Faces, Group, Parsed, Soup};
use crate::text::{SINGLE, Tokens, shown};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Bytes before the facets: a comment of 80 and their number.
const HEADER: usize = 84;
/// Bytes of a facet: twelve numbers of four bytes, and two bytes of attributes.
const FACET: usize = 50;
/// Facets that sniffing looks at: each has nine numbers that random bytes pass for coordinates with a
/// chance of about 3 in 4, so that one facet in 13 would do; 64 leave no doubt, and fewer are in the head.
const LOOKED_AT: usize = 64;
/// Bytes of a text that are looked at; binary files have zeros among the first hundred.
const TEXT_HEAD: usize = 1024;

/// Whether the bytes begin like a file of either kind.
pub fn looks_like(head: &[u8]) -> bool {
    looks_ascii(head) || looks_binary(head)
}

/// Whether the bytes are the beginning of a binary file, as far as they show it: no magic number
/// exists, so this looks at the facets.
fn looks_binary(head: &[u8]) -> bool {
    if head.len() < HEADER + FACET {
        return false;
    }
    let count = facet_count(head) as usize;
    let facets = (head.len() - HEADER) / FACET;
    if count == 0 || is_text(head) {
        return false;
    }
    head[HEADER..]
        .chunks_exact(FACET)
        .take(facets.min(count).min(LOOKED_AT))
        .all(|facet| {
            // Normals may be anything, and some writers leave them undefined.
            let [_, corners @ ..] = vectors(facet);
            let largest = corners.map(|c| c.abs().max_element());
            let largest = largest.into_iter().fold(0.0, f64::max);
            corners.iter().all(|c| c.is_finite()) && (largest == 0.0 || is_size(largest))
        })
}

/// Whether a number can be the largest coordinate of a facet, in any unit: single precision, in which
/// the file is written, holds its square, as an area or the square of a distance needs. Small integers,
/// of which other formats consist, are far below, and a quarter of random numbers is above.
fn is_size(largest: f64) -> bool {
    let squares = f64::from(f32::MIN_POSITIVE)..f64::from(f32::MAX);
    squares.contains(&(largest * largest))
}

/// Whether the bytes are those of an ASCII file.
fn looks_ascii(head: &[u8]) -> bool {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let text = text.trim_ascii_start();
    text.len() >= 5
        && text[..5].eq_ignore_ascii_case(b"solid")
        && text.get(5).is_none_or(u8::is_ascii_whitespace)
        && is_text(text)
}

/// No control bytes but white space; binary files have zeros early.
fn is_text(bytes: &[u8]) -> bool {
    bytes
        .iter()
        .take(TEXT_HEAD)
        .all(|&b| b >= b' ' || b.is_ascii_whitespace())
}

/// Reads a file of either kind.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    soup(bytes).map(Parsed::Soup)
}

fn soup(bytes: &[u8]) -> Result<Soup, ReadError> {
    let fits = bytes.len() >= HEADER && bytes.len() as u64 == length(facet_count(bytes));
    if !fits && looks_ascii(bytes) {
        read_ascii(bytes)
    } else {
        read_binary(bytes)
    }
}

fn facet_count(bytes: &[u8]) -> u32 {
    u32::from_le_bytes([bytes[80], bytes[81], bytes[82], bytes[83]])
}

fn length(facets: u32) -> u64 {
    HEADER as u64 + FACET as u64 * u64::from(facets)
}

/// Normal and three corners.
fn vectors(facet: &[u8]) -> [DVec3; 4] {
    let float = |i: usize| {
        let b = &facet[4 * i..4 * i + 4];
        f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
    };
    std::array::from_fn(|k| DVec3::new(float(3 * k), float(3 * k + 1), float(3 * k + 2)))
}

fn read_binary(bytes: &[u8]) -> Result<Soup, ReadError> {
    let malformed = |reason: String| ReadError::Malformed {
        format: "stl",
        reason,
    };
    if bytes.len() < HEADER {
        return Err(malformed(format!(
            "{} bytes are too few for a binary file (84 for the header) and it does not begin with \
             'solid'",
            bytes.len()
        )));
    }
    let count = facet_count(bytes);
    if bytes.len() as u64 != length(count) {
        return Err(malformed(format!(
            "the header announces {count} facets, which is {} bytes, but the file has {}",
            length(count),
            bytes.len()
        )));
    }
    if count > u32::MAX / 3 {
        return Err(malformed(format!("{count} facets are too many")));
    }
    let count = count as usize;
    let mut points = Vec::with_capacity(3 * count);
    for (index, facet) in bytes[HEADER..].chunks_exact(FACET).enumerate() {
        let [_, corners @ ..] = vectors(facet);
        if let Some(bad) = corners.iter().find(|c| !c.is_finite()) {
            return Err(malformed(format!(
                "facet {} of {count} has the corner ({}, {}, {})",
                index + 1,
                bad.x,
                bad.y,
                bad.z
            )));
        }
        points.extend(corners);
    }
    let first = (0..3 * count as u32).step_by(3);
    Ok(Soup {
        points,
        faces: Faces::Triangles(first.map(|v| [v, v + 1, v + 2]).collect()),
        groups: vec![Group::default()],
        group_word: "solid",
        relative_precision: SINGLE,
        ..Soup::default()
    })
}

fn read_ascii(bytes: &[u8]) -> Result<Soup, ReadError> {
    let mut tokens = Tokens::new(bytes, "stl", None);
    let mut soup = Soup {
        group_word: "solid",
        ..Soup::default()
    };
    let mut corners = Corners::default();
    let mut triangles = Vec::new();
    let mut open = false;
    while let Some(word) = tokens.next_word() {
        if word.eq_ignore_ascii_case(b"solid") {
            let name = String::from_utf8_lossy(tokens.rest_of_line()).into_owned();
            soup.groups.push(Group { name });
            open = true;
        } else if word.eq_ignore_ascii_case(b"endsolid") && open {
            tokens.rest_of_line();
            open = false;
        } else if word.eq_ignore_ascii_case(b"facet") && open {
            triangles.push(facet(&mut tokens, &mut corners)?);
            soup.group_of.push(soup.groups.len() as u32 - 1);
        } else {
            let wanted = if open {
                "'facet' or 'endsolid'"
            } else {
                "'solid'"
            };
            return Err(tokens.error(format!("{wanted} expected, found '{}'", shown(word))));
        }
    }
    if open {
        soup.notices
            .push("the last solid has no 'endsolid'; is the file complete?".to_owned());
    }
    soup.points = corners.points;
    soup.faces = Faces::Triangles(triangles);
    soup.relative_precision = tokens.precision().relative();
    soup.printed_precision = tokens.precision().printed();
    Ok(soup)
}

/// The corners of an ASCII file, each line of text once.
#[derive(Default)]
struct Corners<'a> {
    points: Vec<DVec3>,
    /// By what stands on their lines: most are written several times, and alike, and need to be parsed
    /// once only.
    known: FxHashMap<&'a [u8], u32>,
}

impl<'a> Corners<'a> {
    /// The index of the corner that comes next.
    fn read(&mut self, tokens: &mut Tokens<'a>) -> Result<u32, ReadError> {
        let Some(line) = tokens.line_ahead() else {
            let point = tokens.point()?;
            return Ok(self.add(point));
        };
        if let Some(&id) = self.known.get(line) {
            tokens.skip(line.len());
            return Ok(id);
        }
        let before = tokens.left();
        let point = tokens.point()?;
        let id = self.add(point);
        let rest = line.get(before - tokens.left()..);
        if rest.is_some_and(|r| r.trim_ascii().is_empty()) {
            self.known.insert(line, id);
        }
        Ok(id)
    }

    fn add(&mut self, point: DVec3) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }
}

/// A facet after its first word.
fn facet<'a>(tokens: &mut Tokens<'a>, all: &mut Corners<'a>) -> Result<[u32; 3], ReadError> {
    tokens.expect("normal")?;
    // Normals are often not numbers at all (`nan`); they are not used.
    for _ in 0..3 {
        if tokens.next_word().is_none() {
            return Err(tokens.error("a normal expected, but the file ends here"));
        }
    }
    tokens.expect("outer")?;
    tokens.expect("loop")?;
    let mut corners = [0; 3];
    for corner in &mut corners {
        tokens.expect("vertex")?;
        *corner = all.read(tokens)?;
    }
    tokens.expect("endloop")?;
    tokens.expect("endfacet")?;
    Ok(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit tetrahedron, oriented outwards.
    const TETRAHEDRON: [[[f32; 3]; 3]; 4] = {
        let [o, x, y, z] = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        [[o, y, x], [o, x, z], [x, y, z], [o, z, y]]
    };

    fn binary(header: &[u8], facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, 0);
        bytes.extend((facets.len() as u32).to_le_bytes());
        for facet in facets {
            bytes.extend([0; 12]);
            for x in facet.as_flattened() {
                bytes.extend(x.to_le_bytes());
            }
            bytes.extend([0; 2]);
        }
        bytes
    }

    #[test]
    fn a_binary_header_may_begin_with_solid() {
        let bytes = binary(b"solid of some exporter", &TETRAHEDRON);
        assert!(looks_binary(&bytes) && !looks_ascii(&bytes));
        let soup = soup(&bytes).unwrap();
        assert_eq!((soup.points.len(), soup.faces.len()), (12, 4));
    }

    #[test]
    fn facets_have_a_size_and_other_bytes_have_none() {
        let scaled =
            |scale: f32| TETRAHEDRON.map(|facet| facet.map(|corner| corner.map(|x| x * scale)));
        for scale in [1e-18, 1.0, 1e18] {
            assert!(looks_binary(&binary(b"any unit", &scaled(scale))));
        }
        // The cosine of a right angle, as programs compute it, times a millimetre.
        let mut noisy = TETRAHEDRON;
        noisy[0][0] = [6e-20, -6e-20, 1e-40];
        assert!(looks_binary(&binary(b"noise at the origin", &noisy)));
        let integers = [[[f32::from_bits(7), f32::from_bits(1000), 0.0]; 3]; 4];
        assert!(!looks_binary(&binary(b"small integers", &integers)));
        assert!(!looks_binary(&binary(b"beyond squares", &scaled(1e20))));
    }
}
