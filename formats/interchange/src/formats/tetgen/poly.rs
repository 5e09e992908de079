//! TetGen's piecewise linear complexes: `.poly`, and the simpler `.smesh`.
//!
//! Four parts: nodes, facets, holes, regions. Node ids count from the first one listed, 0 or 1. See
//! the TetGen manual, section "File formats".

use crate::ReadError;
use crate::parsed::{Facet, Parsed, Plc, Seed};
use crate::text::{Tokens, number, shown};

const COMMENT: Option<u8> = Some(b'#');

/// Whether the bytes begin like a file of this format: a header with the dimension 3, then nodes
/// numbered from 0 or 1.
pub fn looks_like(head: &[u8]) -> bool {
    let mut tokens = Tokens::new(head, "poly", COMMENT);
    let integer = |w: &[u8]| std::str::from_utf8(w).ok()?.parse::<u64>().ok();
    let mut header = Vec::new();
    let Some(count) = tokens.next_word().and_then(integer) else {
        return false;
    };
    while let Some(word) = tokens.word_on_line() {
        header.push(integer(word));
    }
    if header.first() != Some(&Some(3)) || header.len() > 3 || header.contains(&None) {
        return false;
    }
    let first = tokens.next_word().and_then(integer);
    let numbers = (0..3).all(|_| tokens.word_on_line().is_some_and(|w| number(w).is_some()));
    count == 0 || (matches!(first, Some(0 | 1)) && numbers)
}

/// Reads a `.poly` file.
pub fn read_poly(bytes: &[u8]) -> Result<Parsed, ReadError> {
    read(Tokens::new(bytes, "poly", COMMENT), facet).map(Parsed::Plc)
}

/// Reads a `.smesh` file, whose facets are one polygon each.
pub fn read_smesh(bytes: &[u8]) -> Result<Parsed, ReadError> {
    read(Tokens::new(bytes, "smesh", COMMENT), simple_facet).map(Parsed::Plc)
}

/// Reads a facet whose nodes count from `first`, and of which there are so many.
type FacetReader =
    fn(tokens: &mut Tokens<'_>, first: i64, nodes: usize) -> Result<Facet, ReadError>;

fn read(mut tokens: Tokens<'_>, facet: FacetReader) -> Result<Plc, ReadError> {
    let mut plc = Plc::default();
    let first = nodes(&mut tokens, &mut plc)?;
    let facets = tokens.count("the number of facets")?;
    tokens.rest_of_line();
    for _ in 0..facets {
        let facet = facet(&mut tokens, first, plc.points.len())?;
        plc.facets.push(facet);
    }
    if let Some(holes) = optional_count(&mut tokens, "the number of holes")? {
        for _ in 0..holes {
            tokens.integer("a hole")?;
            plc.holes.push(tokens.point()?);
            tokens.rest_of_line();
        }
        if let Some(regions) = optional_count(&mut tokens, "the number of regions")? {
            for _ in 0..regions {
                let seed = region(&mut tokens)?;
                plc.regions.push(seed);
            }
        }
    }
    plc.relative_precision = tokens.precision().relative();
    Ok(plc)
}

/// Reads the nodes; returns the id of the first.
fn nodes(tokens: &mut Tokens<'_>, plc: &mut Plc) -> Result<i64, ReadError> {
    let count = tokens.count("the number of nodes")?;
    let dimension = tokens.integer_on_line("the dimension")?.unwrap_or(3);
    if dimension != 3 {
        return Err(tokens.error(format!("nodes of dimension {dimension}; 3 is needed")));
    }
    if count == 0 {
        return Err(tokens.error(
            "it lists no nodes; a separate .node file is not read, so put the nodes into this file",
        ));
    }
    tokens.rest_of_line();
    let mut first = 0;
    plc.points.reserve(count.min(tokens.left() / 8));
    for i in 0..count {
        let id = tokens.integer("a node")?;
        if i == 0 {
            first = id;
            if !(0..=1).contains(&first) {
                return Err(tokens.error(format!("the first node is {first}; it must be 0 or 1")));
            }
        }
        if id - first != i as i64 {
            let wanted = first + i as i64;
            return Err(tokens.error(format!("node {wanted} expected, found {id}")));
        }
        plc.points.push(tokens.point()?);
        // Attributes and marker.
        tokens.rest_of_line();
    }
    Ok(first)
}

fn corners(
    tokens: &mut Tokens<'_>,
    n: usize,
    first: i64,
    nodes: usize,
) -> Result<Vec<u32>, ReadError> {
    let mut corners = Vec::with_capacity(n.min(tokens.left()));
    for _ in 0..n {
        let id = tokens.integer("a node")?;
        match usize::try_from(id.saturating_sub(first)) {
            Ok(v) if v < nodes => corners.push(v as u32),
            _ => {
                let last = first + nodes as i64 - 1;
                return Err(tokens.error(format!(
                    "node {id} does not exist; there are nodes {first} to {last}"
                )));
            }
        }
    }
    Ok(corners)
}

fn facet(tokens: &mut Tokens<'_>, first: i64, nodes: usize) -> Result<Facet, ReadError> {
    let polygons = tokens.count("the number of polygons")?;
    let holes = tokens
        .integer_on_line("the number of facet holes")?
        .unwrap_or(0);
    let marker = tokens.integer_on_line("a boundary marker")?.unwrap_or(0);
    tokens.rest_of_line();
    let mut facet = Facet {
        marker,
        ..Facet::default()
    };
    for _ in 0..polygons {
        let n = tokens.count("the number of corners")?;
        let corners = corners(tokens, n, first, nodes)?;
        facet.polygons.push(corners);
        tokens.rest_of_line();
    }
    for _ in 0..holes {
        tokens.integer("a facet hole")?;
        facet.holes.push(tokens.point()?);
        tokens.rest_of_line();
    }
    Ok(facet)
}

fn simple_facet(tokens: &mut Tokens<'_>, first: i64, nodes: usize) -> Result<Facet, ReadError> {
    let n = tokens.count("the number of corners")?;
    let polygon = corners(tokens, n, first, nodes)?;
    let marker = tokens.integer_on_line("a boundary marker")?.unwrap_or(0);
    tokens.rest_of_line();
    Ok(Facet {
        polygons: vec![polygon],
        holes: Vec::new(),
        marker,
    })
}

fn region(tokens: &mut Tokens<'_>) -> Result<Seed, ReadError> {
    tokens.integer("a region")?;
    let point = tokens.point()?;
    let attribute = tokens.word_on_line().unwrap_or(b"0");
    let attribute = match number(attribute) {
        Some(x) if x.is_finite() => String::from_utf8_lossy(attribute).into_owned(),
        _ => {
            let found = shown(attribute);
            return Err(tokens.error(format!("a region attribute expected, found '{found}'")));
        }
    };
    let max_volume = match tokens.word_on_line() {
        None => None,
        Some(word) => match number(word) {
            Some(x) => (x > 0.0 && x.is_finite()).then_some(x),
            None => {
                let found = shown(word);
                return Err(tokens.error(format!("a volume limit expected, found '{found}'")));
            }
        },
    };
    tokens.rest_of_line();
    Ok(Seed {
        point,
        attribute,
        max_volume,
    })
}

/// A count that may be missing with all that follows.
fn optional_count(tokens: &mut Tokens<'_>, what: &str) -> Result<Option<usize>, ReadError> {
    if tokens.is_at_end() {
        return Ok(None);
    }
    let count = tokens.count(what)?;
    tokens.rest_of_line();
    Ok(Some(count))
}
