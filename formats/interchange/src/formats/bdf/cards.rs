//! Cards of bulk data: lines of ten fields, in three forms, with continuation lines.
//!
//! Format: "MSC Nastran Quick Reference Guide", section "Bulk Data Entry Descriptions, Format". Small
//! fields are 8 columns wide, large ones 16; free fields are separated by commas.

use crate::ReadError;
use crate::text::shown;

/// Columns of a field of names and markers, and of a small field.
const SMALL: usize = 8;
/// Data fields of a line of small or free fields. A line of large fields, which are twice as wide, has
/// half as many.
const FIELDS: usize = 8;

/// A card: its name and its data fields, which may be empty.
#[derive(Debug, Default)]
pub struct Card {
    /// Upper case, without the mark of large fields.
    pub name: Vec<u8>,
    /// Line it begins on, from 1.
    pub line: u32,
    fields: Vec<Vec<u8>>,
}

impl Card {
    /// A data field by its number as the manual counts, from 2 on; empty where the card is shorter.
    /// Continuation lines go on with 10, 11, ..., without their first and last field.
    pub fn field(&self, number: usize) -> &[u8] {
        self.fields.get(number - 2).map_or(&[], Vec::as_slice)
    }

    /// An error at the line that the card begins on.
    pub fn error(&self, reason: impl std::fmt::Display) -> ReadError {
        malformed(self.line, reason)
    }

    /// A field that is a positive integer.
    pub fn id(&self, number: usize, what: &str) -> Result<u32, ReadError> {
        let word = self.field(number);
        let id = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
        id.filter(|&id| id > 0 && id < u32::MAX).ok_or_else(|| {
            let (name, found) = (String::from_utf8_lossy(&self.name), shown(word));
            self.error(format!("{name}: {what} expected, found '{found}'"))
        })
    }
}

/// The error that a line is not what the format wants.
pub fn malformed(line: u32, reason: impl std::fmt::Display) -> ReadError {
    ReadError::Malformed {
        format: "bdf",
        reason: format!("line {line}: {reason}"),
    }
}

/// The cards of a file, and its comments.
pub struct Cards<'a> {
    rest: &'a [u8],
    line: u32,
}

/// What comes next in a file.
pub enum Item<'a> {
    /// A card with its continuation lines.
    Card(Card),
    /// What stands behind the dollar sign of a line that is a comment.
    Comment(&'a [u8]),
}

impl<'a> Cards<'a> {
    /// The bulk data of a file: what follows `BEGIN BULK`, or all of it where that is missing. Comments
    /// before are kept.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            line: 0,
        }
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let length = self.rest.iter().position(|&b| b == b'\n');
        let length = length.unwrap_or(self.rest.len());
        let line = &self.rest[..length];
        self.rest = self.rest.get(length + 1..).unwrap_or_default();
        self.line += 1;
        Some(line)
    }

    /// The next line, without reading it.
    fn peek(&self) -> Option<&'a [u8]> {
        Self { ..*self }.next_line()
    }

    /// The next card or comment; `None` at the end of the data.
    pub fn next_item(&mut self) -> Option<Item<'a>> {
        loop {
            let line = self.next_line()?;
            if let Some(comment) = line.trim_ascii_start().strip_prefix(b"$") {
                return Some(Item::Comment(comment.trim_ascii()));
            }
            let line = without_comment(line);
            if line.trim_ascii().is_empty() {
                continue;
            }
            let mut card = Card {
                line: self.line,
                ..Card::default()
            };
            card.name = split(line, &mut card.fields);
            while let Some(next) = self.peek() {
                let text = without_comment(next);
                if next.trim_ascii_start().starts_with(b"$") {
                    break;
                }
                if !is_continuation(text) {
                    break;
                }
                self.next_line();
                split(text, &mut card.fields);
            }
            return Some(Item::Card(card));
        }
    }
}

/// Whether a line goes on with the card before: its first field is empty or a mark.
fn is_continuation(line: &[u8]) -> bool {
    match line.first() {
        Some(b'+' | b'*' | b',') => true,
        Some(b' ' | b'\t') => {
            !line.trim_ascii().is_empty() && {
                let first = expanded(line);
                first.len() > SMALL && first[..SMALL].trim_ascii().is_empty()
            }
        }
        _ => false,
    }
}

fn without_comment(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|&b| b == b'$');
    line[..end.unwrap_or(line.len())].trim_ascii_end()
}

/// Tabs go on to the next multiple of eight columns.
fn expanded(line: &[u8]) -> Vec<u8> {
    let mut wide = Vec::with_capacity(line.len());
    for &b in line {
        wide.push(if b == b'\t' { b' ' } else { b });
        while b == b'\t' && !wide.len().is_multiple_of(SMALL) {
            wide.push(b' ');
        }
    }
    wide
}

/// Adds the data fields of a line, as many as a line of its form has. Returns its first field, in upper
/// case and without the mark of large fields.
fn split(line: &[u8], fields: &mut Vec<Vec<u8>>) -> Vec<u8> {
    let field = |part: &[u8]| part.trim_ascii().to_vec();
    let is_free = line.contains(&b',');
    let (first, data): (Vec<u8>, Vec<Vec<u8>>) = if is_free {
        let mut parts = line.split(|&b| b == b',');
        let first = field(parts.next().unwrap_or_default());
        (first, parts.map(field).collect())
    } else {
        let wide = expanded(line);
        let (first, rest) = wide.split_at(wide.len().min(SMALL));
        let first = field(first);
        let width = if first.contains(&b'*') {
            2 * SMALL
        } else {
            SMALL
        };
        (first, rest.chunks(width).map(field).collect())
    };
    let count = if first.contains(&b'*') {
        FIELDS / 2
    } else {
        FIELDS
    };
    let end = fields.len() + count;
    fields.extend(data.into_iter().take(count));
    fields.resize(end, Vec::new());
    let name = first.strip_suffix(b"*").unwrap_or(&first);
    name.to_ascii_uppercase()
}
