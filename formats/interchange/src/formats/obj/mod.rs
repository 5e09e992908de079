//! Wavefront OBJ, read with `tobj`: positions and faces; groups and objects.

use crate::ReadError;
use crate::parsed::{Group, Parsed, Soup};
use crate::text::{TextPrecision, number};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::io::{self, BufRead, Read};
use tobj::{LoadError, LoadOptions};

/// Lines that sniffing looks at: a vertex comes behind comments and names of materials, of which files have
/// a few dozen at most. Without a limit, a long text would be searched to its end.
const LOOKED_AT: usize = 200;

/// Whether the bytes begin like a file of this format: no magic word exists, so this looks for
/// its statements.
pub fn looks_like(head: &[u8]) -> bool {
    let mut vertices = 0;
    for line in head.split(|&b| b == b'\n').take(LOOKED_AT) {
        let mut words = line
            .split(u8::is_ascii_whitespace)
            .filter(|w| !w.is_empty());
        match words.next() {
            Some(b"v") => {
                // The last line may be cut off.
                let good = words.take(3).filter(|w| number(w).is_some()).count();
                vertices += usize::from(good == 3);
            }
            None
            | Some(b"vn" | b"vt" | b"vp" | b"f" | b"g" | b"o" | b"s" | b"mtllib" | b"usemtl") => {}
            Some([b'#', ..]) => {}
            Some(_) => break,
        }
    }
    vertices > 0
}

/// Reads a file. Materials are ignored, and no other file is opened.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut lines = Geometry::new(bytes);
    let options = LoadOptions {
        ignore_points: true,
        ignore_lines: true,
        ..LoadOptions::default()
    };
    let loaded = tobj::load_obj_buf(&mut lines, &options, |_| {
        Ok((Vec::new(), Default::default()))
    });
    let models = match loaded {
        Ok((models, _)) => models,
        Err(error) => return Err(explain(&error, bytes, lines.line)),
    };
    let mut soup = Soup {
        group_word: "group",
        ..Soup::default()
    };
    let mut ids: FxHashMap<String, u32> = FxHashMap::default();
    for model in models {
        let mesh = model.mesh;
        if mesh.indices.is_empty() {
            continue;
        }
        // tobj's name for faces before any group.
        let name = if model.name == "unnamed_object" {
            String::new()
        } else {
            model.name
        };
        let group = *ids.entry(name.clone()).or_insert_with(|| {
            soup.groups.push(Group { name });
            soup.groups.len() as u32 - 1
        });
        let base = soup.points.len() as u32;
        for p in mesh.positions.chunks_exact(3) {
            let point = DVec3::new(p[0], p[1], p[2]);
            if !point.is_finite() {
                return Err(not_finite(bytes, point));
            }
            soup.points.push(point);
        }
        let mut rest = mesh.indices.as_slice();
        let mut arities = mesh.face_arities.iter();
        while !rest.is_empty() {
            // No arities at all means triangles only; a face may have no corners.
            let n = match arities.next() {
                None => 3,
                Some(&n) => (n as usize).min(rest.len()),
            };
            let (face, after) = rest.split_at(n);
            let corners: Vec<u32> = face.iter().map(|v| v + base).collect();
            soup.faces.add(&corners);
            soup.group_of.push(group);
            rest = after;
        }
    }
    soup.relative_precision = lines.precision.relative();
    soup.printed_precision = lines.precision.printed();
    Ok(Parsed::Soup(soup))
}

fn malformed(reason: String) -> ReadError {
    ReadError::Malformed {
        format: "obj",
        reason,
    }
}

fn not_finite(bytes: &[u8], point: DVec3) -> ReadError {
    let is_bad = |line: &[u8]| {
        let mut words = line
            .split(u8::is_ascii_whitespace)
            .filter(|w| !w.is_empty());
        words.next() == Some(b"v") && words.any(|w| number(w).is_some_and(|x| !x.is_finite()))
    };
    let line = bytes.split(|&b| b == b'\n').position(is_bad);
    let place = line.map_or(String::new(), |l| format!("line {}: ", l + 1));
    malformed(format!(
        "{place}the vertex ({}, {}, {}) is not finite",
        point.x, point.y, point.z
    ))
}

/// tobj's error, with a line where it has one.
fn explain(error: &LoadError, bytes: &[u8], line: usize) -> ReadError {
    let what = match error {
        LoadError::PositionParseError => "a vertex is not three numbers",
        LoadError::FaceParseError => "a face is not a list of vertices",
        LoadError::ScalingByZeroError => "a vertex has the weight 0",
        LoadError::FaceVertexOutOfBounds => return missing_vertex(bytes),
        other => return malformed(format!("line {line}: {other}")),
    };
    malformed(format!("line {line}: {what}"))
}

/// Finds the face that names a vertex that is not there: tobj finds out at the end of the group.
fn missing_vertex(bytes: &[u8]) -> ReadError {
    let statements = || {
        bytes.split(|&b| b == b'\n').enumerate().map(|(i, line)| {
            let mut words = line
                .split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty());
            (i + 1, words.next(), words)
        })
    };
    let count = statements().filter(|s| s.1 == Some(b"v")).count() as i64;
    let mut so_far = 0;
    for (line, word, rest) in statements() {
        match word {
            Some(b"v") => so_far += 1,
            Some(b"f") => {
                for corner in rest {
                    let id = corner.split(|&b| b == b'/').next().unwrap_or_default();
                    let id: i64 = std::str::from_utf8(id)
                        .ok()
                        .and_then(|w| w.parse().ok())
                        .unwrap_or(0);
                    if id == 0 || id > count || id < -so_far {
                        return malformed(format!(
                            "line {line}: vertex {id} does not exist; there are {count}, counted \
                             from 1"
                        ));
                    }
                }
            }
            _ => {}
        }
    }
    malformed(format!(
        "a face names a vertex that does not exist; there are {count}"
    ))
}

/// The lines that matter, without what does not: colours, normals, textures, materials. Lines
/// continued with a backslash are joined.
struct Geometry<'a> {
    rest: &'a [u8],
    line: usize,
    buffer: Vec<u8>,
    at: usize,
    precision: TextPrecision,
}

impl<'a> Geometry<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
            line: 0,
            buffer: Vec::new(),
            at: 0,
            precision: TextPrecision::default(),
        }
    }

    /// Takes a line, joined with the next ones where it ends with a backslash.
    fn take_line(&mut self) -> Option<Vec<u8>> {
        let mut whole = Vec::new();
        while !self.rest.is_empty() {
            let length = self
                .rest
                .iter()
                .position(|&b| b == b'\n')
                .unwrap_or(self.rest.len());
            let line = self.rest[..length].trim_ascii_end();
            self.rest = self.rest.get(length + 1..).unwrap_or_default();
            self.line += 1;
            match line.strip_suffix(b"\\") {
                Some(part) if !self.rest.is_empty() => {
                    whole.extend_from_slice(part);
                    whole.push(b' ');
                }
                _ => {
                    whole.extend_from_slice(line);
                    return Some(whole);
                }
            }
        }
        None
    }

    /// Puts what matters of the next line that matters into the buffer.
    fn refill(&mut self) {
        self.buffer.clear();
        self.at = 0;
        while self.buffer.is_empty() {
            let Some(line) = self.take_line() else {
                return;
            };
            let mut words = line
                .split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty());
            match words.next() {
                Some(b"v") => {
                    self.buffer.push(b'v');
                    let all: Vec<&[u8]> = words.collect();
                    // A fourth number alone is a weight; more are colours.
                    let wanted = if all.len() == 4 { 4 } else { 3 };
                    for word in all.iter().take(wanted) {
                        if let Some(value) = number(word) {
                            self.precision.note(word, value);
                        }
                        self.buffer.push(b' ');
                        self.buffer.extend_from_slice(word);
                    }
                }
                Some(b"f") => {
                    self.buffer.push(b'f');
                    for word in words {
                        let id = word.split(|&b| b == b'/').next().unwrap_or_default();
                        self.buffer.push(b' ');
                        self.buffer.extend_from_slice(id);
                    }
                }
                Some(b"g" | b"o") => {
                    let name = line.trim_ascii_start()[1..].trim_ascii();
                    self.buffer.extend_from_slice(b"g ");
                    self.buffer
                        .extend_from_slice(String::from_utf8_lossy(name).as_bytes());
                }
                _ => {}
            }
        }
        self.buffer.push(b'\n');
    }
}

impl Read for Geometry<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let n = self.fill_buf()?.read(into)?;
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Geometry<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.at >= self.buffer.len() {
            self.refill();
        }
        Ok(&self.buffer[self.at..])
    }

    fn consume(&mut self, n: usize) {
        self.at += n;
    }
}
