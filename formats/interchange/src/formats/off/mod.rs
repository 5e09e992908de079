//! Object File Format, ASCII, with or without colours and normals.

use crate::ReadError;
use crate::parsed::{Group, Parsed, Soup};
use crate::text::{Tokens, shown};

const COMMENT: Option<u8> = Some(b'#');

/// Whether the bytes begin like a file of this format.
pub fn looks_like(head: &[u8]) -> bool {
    Tokens::new(head, "off", COMMENT)
        .next_word()
        .is_some_and(is_keyword)
}

/// `OFF`, with letters in front for what else a vertex has.
fn is_keyword(word: &[u8]) -> bool {
    word.strip_suffix(b"OFF")
        .is_some_and(|front| front.iter().all(|b| b"STCN4n".contains(b)))
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut tokens = Tokens::new(bytes, "off", COMMENT);
    let keyword = tokens.next_word().unwrap_or_default();
    if !is_keyword(keyword) {
        return Err(tokens.error(format!("'OFF' expected, found '{}'", shown(keyword))));
    }
    if keyword.contains(&b'4') || keyword.contains(&b'n') {
        return Err(tokens.error("vertices of more than three dimensions are not supported"));
    }
    let vertices = match tokens.next_word() {
        Some(b"BINARY") => return Err(tokens.error("the binary variant is not supported")),
        Some(word) => std::str::from_utf8(word)
            .ok()
            .and_then(|w| w.parse::<usize>().ok())
            .ok_or_else(|| {
                tokens.error(format!(
                    "the number of vertices expected, found '{}'",
                    shown(word)
                ))
            })?,
        None => return Err(tokens.error("the number of vertices expected, but the file ends here")),
    };
    let faces = tokens.count("the number of faces")?;
    // The number of edges, which nobody needs, is sometimes left out.
    tokens.rest_of_line();
    let mut soup = Soup {
        points: Vec::with_capacity(vertices.min(tokens.left() / 6)),
        groups: vec![Group::default()],
        group_word: "group",
        ..Soup::default()
    };
    for _ in 0..vertices {
        let point = tokens.point()?;
        soup.points.push(point);
        // Colour, normal, texture.
        tokens.rest_of_line();
    }
    let mut corners = Vec::new();
    for _ in 0..faces {
        let n = tokens.count("the number of corners")?;
        corners.clear();
        for _ in 0..n {
            let v = tokens.integer("a vertex")?;
            match u32::try_from(v) {
                Ok(id) if (id as usize) < vertices => corners.push(id),
                _ => {
                    return Err(tokens.error(format!(
                        "vertex {v} does not exist; there are {vertices}, counted from 0"
                    )));
                }
            }
        }
        soup.faces.add(&corners);
        tokens.rest_of_line();
    }
    soup.relative_precision = tokens.precision().relative();
    soup.printed_precision = tokens.precision().printed();
    Ok(Parsed::Soup(soup))
}
