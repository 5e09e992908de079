//! Reader: grid points, tetrahedra and shells with their properties; other cards are passed over.
//!
//! Properties of tetrahedra are regions, those of shells are markers. Of elements of second order the
//! corners are read. Names are comments such as the writer makes: `$ PSOLID 3 copper`.

use super::cards::{Card, Cards, Item, malformed};
use super::number::{parse, plain};
use crate::ReadError;
use crate::parsed::{Grid, Parsed, Shells, TETRA, TRIANGLE, by_corners};
use crate::text::{TextPrecision, plain as plain_name, shown};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Whether the bytes begin like a file of this format: one of the first lines begins the bulk data, or
/// is a grid point.
pub fn looks_like(head: &[u8]) -> bool {
    let mut lines = head.split(|&b| b == b'\n');
    lines.any(|line| {
        is_begin(line) || {
            let is_grid = line.len() > 4 && line[..4].eq_ignore_ascii_case(b"GRID");
            is_grid && matches!(line[4], b' ' | b'*' | b',' | b'\t')
        }
    })
}

/// Whether a line is the one before the bulk data.
fn is_begin(line: &[u8]) -> bool {
    let words = line.split(u8::is_ascii_whitespace);
    let mut words = words.filter(|w| !w.is_empty());
    let mut is = |word: &[u8]| words.next().is_some_and(|w| w.eq_ignore_ascii_case(word));
    is(b"BEGIN") && is(b"BULK")
}

/// Reads a file.
///
/// # Errors
/// Grid points in coordinate systems of their own, elements that name points that are not there,
/// solid elements that are no tetrahedra.
pub fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut deck = Deck::default();
    // What comes before is no bulk data.
    let mut in_bulk = !bytes.split(|&b| b == b'\n').any(is_begin);
    let mut cards = Cards::new(bytes);
    while let Some(item) = cards.next_item() {
        match item {
            Item::Comment(text) => deck.comment(&String::from_utf8_lossy(text)),
            Item::Card(card) if !in_bulk => in_bulk = card.name.starts_with(b"BEGIN"),
            Item::Card(card) if card.name.starts_with(b"ENDDATA") => break,
            Item::Card(card) => deck.card(&card)?,
        }
    }
    deck.parsed()
}

/// An element by its grid points, as numbered in the file.
struct Element<const N: usize> {
    points: [u32; N],
    property: u32,
    line: u32,
}

/// What the file lists.
#[derive(Default)]
struct Deck {
    title: String,
    points: Vec<DVec3>,
    /// Index of each grid point, by its number.
    index: FxHashMap<u32, u32>,
    tets: Vec<Element<4>>,
    triangles: Vec<Element<3>>,
    /// Names of the properties of solids, and of shells.
    names: [BTreeMap<u32, String>; 2],
    curved: usize,
    precision: TextPrecision,
}

impl Deck {
    fn comment(&mut self, text: &str) {
        if text.starts_with("symtet") && self.title.is_empty() {
            self.title = text.to_owned();
        }
        let mut words = text.splitn(3, ' ');
        let names = match words.next() {
            Some("PSOLID") => &mut self.names[0],
            Some("PSHELL") => &mut self.names[1],
            _ => return,
        };
        let id = words.next().and_then(|w| w.parse().ok());
        if let (Some(id), Some(name)) = (id, words.next()) {
            names.insert(id, plain_name(name));
        }
    }

    fn card(&mut self, card: &Card) -> Result<(), ReadError> {
        match &card.name[..] {
            b"GRID" => self.grid(card),
            b"CTETRA" => {
                self.curved += usize::from(!card.field(8).is_empty());
                let points = corners(card)?;
                self.tets.push(element(card, points)?);
                Ok(())
            }
            b"CTRIA3" | b"CTRIAR" | b"CTRIA6" => {
                self.curved += usize::from(card.name == b"CTRIA6");
                let points = corners(card)?;
                self.triangles.push(element(card, points)?);
                Ok(())
            }
            b"CQUAD4" | b"CQUADR" => {
                let [a, b, c, d] = corners(card)?;
                self.triangles.push(element(card, [a, b, c])?);
                self.triangles.push(element(card, [a, c, d])?);
                Ok(())
            }
            b"CHEXA" | b"CPENTA" | b"CPYRA" | b"CPYRAM" => Err(card.error(format!(
                "{}: of solid elements only tetrahedra are read",
                String::from_utf8_lossy(&card.name)
            ))),
            _ => Ok(()),
        }
    }

    fn grid(&mut self, card: &Card) -> Result<(), ReadError> {
        let id = card.id(2, "the number of a grid point")?;
        let system = card.field(3);
        if !matches!(system, b"" | b"0") {
            return Err(card.error(format!(
                "GRID {id} is in the coordinate system {}; points of the basic one are read",
                shown(system)
            )));
        }
        let mut point = [0.0; 3];
        for (x, number) in point.iter_mut().zip(4..) {
            let word = card.field(number);
            // A field left out is zero.
            if word.is_empty() {
                continue;
            }
            *x = parse(word).filter(|x| x.is_finite()).ok_or_else(|| {
                card.error(format!(
                    "GRID {id}: the coordinate '{}' is no finite number",
                    shown(word)
                ))
            })?;
            self.precision.note(&plain(word), *x);
        }
        let index = self.points.len() as u32;
        self.points.push(DVec3::from(point));
        match self.index.insert(id, index) {
            Some(_) => Err(card.error(format!("GRID {id} comes twice"))),
            None => Ok(()),
        }
    }

    /// Indices of the points of an element.
    fn indices<const N: usize>(&self, element: &Element<N>) -> Result<[u32; N], ReadError> {
        let mut indices = [0; N];
        for (index, id) in indices.iter_mut().zip(element.points) {
            *index = *self.index.get(&id).ok_or_else(|| {
                let reason = format!("an element names GRID {id}, which is not there");
                malformed(element.line, reason)
            })?;
        }
        Ok(indices)
    }

    fn parsed(self) -> Result<Parsed, ReadError> {
        let tets = self.tets.iter().map(|e| self.indices(e));
        let tets = tets.collect::<Result<Vec<_>, _>>()?;
        let triangles = self.triangles.iter().map(|e| self.indices(e));
        let triangles = triangles.collect::<Result<Vec<_>, _>>()?;
        let relative_precision = self.precision.relative();
        let notices = by_corners(self.curved).into_iter().collect();
        if tets.is_empty() {
            let markers: BTreeMap<u32, String> = (self.triangles.iter())
                .map(|e| (e.property, self.name(1, e.property, "surface")))
                .collect();
            let property = |i: usize| self.triangles[i].property;
            let triangles = triangles.into_iter().enumerate();
            return Ok(Parsed::Shells(Shells {
                triangles: triangles
                    .map(|(i, t)| (t, property(i), i64::from(property(i))))
                    .collect(),
                points: self.points,
                markers: markers.into_iter().collect(),
                volumes: Vec::new(),
                relative_precision,
                notices,
            }));
        }
        let [solids, shells] = &self.names;
        let lines = |names: &BTreeMap<u32, String>| -> String {
            names
                .iter()
                .map(|(id, name)| format!("{id} {name}\n"))
                .collect()
        };
        let texts = [
            ("region_names", lines(solids)),
            ("marker_names", lines(shells)),
        ];
        let mut grid = Grid {
            texts: texts
                .map(|(field, text)| (field.to_owned(), text))
                .into_iter()
                .collect(),
            title: self.title,
            points: self.points,
            relative_precision,
            notices,
            ..Grid::default()
        };
        tets.iter().for_each(|t| grid.add(TETRA, t));
        triangles.iter().for_each(|t| grid.add(TRIANGLE, t));
        let none = |count: usize| vec![u32::MAX; count];
        let of_tets = self.tets.iter().map(|e| e.property).collect();
        let of_triangles = self.triangles.iter().map(|e| e.property).collect();
        for (name, values) in [
            ("region", [of_tets, none(triangles.len())]),
            ("marker", [none(tets.len()), of_triangles]),
        ] {
            grid.cell_data.insert(name.to_owned(), values.concat());
        }
        grid.drop_unused_points();
        grid.parsed("bdf")
    }

    fn name(&self, kind: usize, property: u32, word: &str) -> String {
        let known = self.names[kind].get(&property).filter(|n| !n.is_empty());
        known
            .cloned()
            .unwrap_or_else(|| format!("{word}{property}"))
    }
}

/// The first grid points of an element.
fn corners<const N: usize>(card: &Card) -> Result<[u32; N], ReadError> {
    let mut points = [0; N];
    for (point, number) in points.iter_mut().zip(4..) {
        *point = card.id(number, "a grid point")?;
    }
    Ok(points)
}

fn element<const N: usize>(card: &Card, points: [u32; N]) -> Result<Element<N>, ReadError> {
    // A property left out has the number of the element.
    let property = if card.field(3).is_empty() { 2 } else { 3 };
    Ok(Element {
        points,
        property: card.id(property, "a property")?,
        line: card.line,
    })
}
