//! Words of a text file, with line numbers, and what its numbers show about their precision.

use super::TextPrecision;
use super::decimal::{Decimal, decimal};
use crate::ReadError;
use glam::DVec3;
use std::io::BufRead;

/// Bytes that a short line has at most: three numbers of 24 characters and blanks, with room. Longer
/// lines are read all the same, each time anew.
const SHORT: usize = 256;

/// Words of a text, separated by white space.
pub struct Tokens<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    format: &'static str,
    comment: Option<u8>,
    precision: TextPrecision,
    by_byte: bool,
}

impl<'a> Tokens<'a> {
    /// Words of `bytes`; `format` names the format in errors, and `comment` is the byte that makes
    /// the rest of a line a comment.
    pub fn new(bytes: &'a [u8], format: &'static str, comment: Option<u8>) -> Self {
        let start = if bytes.starts_with(b"\xef\xbb\xbf") {
            3
        } else {
            0
        };
        Self {
            bytes,
            at: start,
            line: 1,
            format,
            comment,
            precision: TextPrecision::default(),
            by_byte: false,
        }
    }

    /// Gives places in errors as bytes from the beginning, from now on: for text with binary numbers
    /// in it.
    pub fn count_bytes(&mut self) {
        self.by_byte = true;
    }

    /// What the coordinates read so far show.
    pub fn precision(&self) -> &TextPrecision {
        &self.precision
    }

    /// Takes a coordinate into account that was read by other means.
    pub fn note(&mut self, word: &[u8], value: f64) {
        self.precision.note(word, value);
    }

    /// An error at the current place.
    pub fn error(&self, reason: impl std::fmt::Display) -> ReadError {
        ReadError::Malformed {
            format: self.format,
            reason: if self.by_byte {
                format!("byte {}: {reason}", self.at)
            } else {
                format!("line {}: {reason}", self.line)
            },
        }
    }

    /// The next word, or `None` at the end.
    pub fn next_word(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.word_on_line() {
                return Some(word);
            }
            // At a line's end, or the file's.
            self.bytes.get(self.at)?;
            self.line += 1;
            self.at += 1;
        }
    }

    /// The next word on the current line, or `None` at the line's end.
    pub fn word_on_line(&mut self) -> Option<&'a [u8]> {
        let on_line = |b: u8| b != b'\n' && is_blank(b);
        while self.bytes.get(self.at).is_some_and(|&b| on_line(b)) {
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        match rest.first() {
            None | Some(b'\n') => return None,
            Some(_) if rest.first().copied() == self.comment => {
                self.rest_of_line();
                return None;
            }
            Some(_) => {}
        }
        let inside = |b: u8| !is_blank(b) && Some(b) != self.comment;
        let mut length = 1;
        while rest.get(length).is_some_and(|&b| inside(b)) {
            length += 1;
        }
        self.at += length;
        Some(&rest[..length])
    }

    /// Where white space and ends of lines are over, and the line that is.
    fn after_blanks(&self) -> (usize, usize) {
        let (mut at, mut line) = (self.at, self.line);
        while let Some(&b) = self.bytes.get(at)
            && is_blank(b)
        {
            line += usize::from(b == b'\n');
            at += 1;
        }
        (at, line)
    }

    /// The next word as a number, if it is one of the ordinary kind. Otherwise nothing is read.
    fn decimal(&mut self) -> Option<Decimal> {
        let (at, line) = self.after_blanks();
        let number = decimal(&self.bytes[at..])?;
        (self.at, self.line) = (at + number.length, line);
        Some(number)
    }

    /// The rest of the line, trimmed; the line's end is left to be read.
    pub fn rest_of_line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at += length;
        rest[..length].trim_ascii()
    }

    /// The rest of the line, which is left to be read; `None` for a long one, or the file's last.
    pub fn line_ahead(&self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let rest = &rest[..rest.len().min(SHORT)];
        let length = (&mut { rest }).skip_until(b'\n').ok()?;
        rest[..length].strip_suffix(b"\n")
    }

    /// The next word, which must be this one, in any case.
    ///
    /// # Errors
    /// Another word, or the end.
    pub fn expect(&mut self, word: &str) -> Result<(), ReadError> {
        // Most are written like that.
        let (at, line) = self.after_blanks();
        if let Some(rest) = self.bytes[at..].strip_prefix(word.as_bytes())
            && rest.first().is_some_and(|&b| is_blank(b))
        {
            (self.at, self.line) = (at + word.len(), line);
            return Ok(());
        }
        match self.next_word() {
            Some(w) if w.eq_ignore_ascii_case(word.as_bytes()) => Ok(()),
            Some(w) => Err(self.error(format!("'{word}' expected, found '{}'", shown(w)))),
            None => Err(self.error(format!("'{word}' expected, but the file ends here"))),
        }
    }

    /// The next word as an integer; `what` names it in errors.
    ///
    /// # Errors
    /// Not an integer, or the end.
    pub fn integer(&mut self, what: &str) -> Result<i64, ReadError> {
        match self.next_word() {
            Some(word) => self.as_integer(word, what),
            None => Err(self.error(format!("{what} expected, but the file ends here"))),
        }
    }

    /// The next word as a count, which is a claim of the file.
    ///
    /// # Errors
    /// Not a count, or the end.
    pub fn count(&mut self, what: &str) -> Result<usize, ReadError> {
        let value = self.integer(what)?;
        usize::try_from(value).map_err(|_| self.error(format!("{value} as {what}")))
    }

    /// The next word on the current line as an integer, if there is one.
    ///
    /// # Errors
    /// Not an integer.
    pub fn integer_on_line(&mut self, what: &str) -> Result<Option<i64>, ReadError> {
        match self.word_on_line() {
            Some(word) => self.as_integer(word, what).map(Some),
            None => Ok(None),
        }
    }

    fn as_integer(&self, word: &[u8], what: &str) -> Result<i64, ReadError> {
        std::str::from_utf8(word)
            .ok()
            .and_then(|w| w.parse().ok())
            .ok_or_else(|| self.error(format!("{what} expected, found '{}'", shown(word))))
    }

    /// Whether no word follows.
    pub fn is_at_end(&mut self) -> bool {
        self.peek().is_none()
    }

    /// The next word, without reading it.
    pub fn peek(&mut self) -> Option<&'a [u8]> {
        let (at, line) = (self.at, self.line);
        let word = self.next_word();
        (self.at, self.line) = (at, line);
        word
    }

    /// Passes over bytes that are not text, or the line feed at the end of a line.
    pub fn skip(&mut self, bytes: usize) {
        let end = self.bytes.len().min(self.at.saturating_add(bytes));
        if bytes == 1 && self.bytes.get(self.at) == Some(&b'\n') {
            self.line += 1;
        }
        self.at = end;
    }

    /// The next word as a number, finite or not.
    ///
    /// # Errors
    /// Not a number, or the end.
    pub fn number(&mut self) -> Result<f64, ReadError> {
        if let Some(number) = self.decimal() {
            return Ok(number.value);
        }
        match self.next_word() {
            Some(word) => {
                number(word).ok_or_else(|| self.error(format!("'{}' is not a number", shown(word))))
            }
            None => Err(self.error("a number expected, but the file ends here")),
        }
    }

    /// Bytes not read yet: no more elements than that can follow.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next three words as a point.
    ///
    /// # Errors
    /// Not numbers, not finite, or the end.
    pub fn point(&mut self) -> Result<DVec3, ReadError> {
        Ok(DVec3::new(
            self.coordinate()?,
            self.coordinate()?,
            self.coordinate()?,
        ))
    }

    /// The next word as a finite coordinate.
    ///
    /// # Errors
    /// Not a number, not finite, or the end.
    pub fn coordinate(&mut self) -> Result<f64, ReadError> {
        if let Some(number) = self.decimal() {
            self.precision.note_digits(number.digits, number.value);
            return Ok(number.value);
        }
        let Some(word) = self.next_word() else {
            return Err(self.error("a coordinate expected, but the file ends here"));
        };
        let value =
            number(word).ok_or_else(|| self.error(format!("'{}' is not a number", shown(word))))?;
        if !value.is_finite() {
            return Err(self.error(format!("the coordinate '{}' is not finite", shown(word))));
        }
        self.precision.note(word, value);
        Ok(value)
    }
}

/// Whether a byte is white space; most are not, and above all of it.
#[inline]
fn is_blank(b: u8) -> bool {
    b <= b' ' && b.is_ascii_whitespace()
}

/// A word as text for a message, shortened.
pub fn shown(word: &[u8]) -> String {
    let cut = &word[..word.len().min(40)];
    let more = if cut.len() < word.len() { "..." } else { "" };
    format!("{}{more}", String::from_utf8_lossy(cut).escape_debug())
}

/// A floating-point number; Fortran's exponent letter `d` counts as `e`.
pub fn number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    match text.parse() {
        Ok(value) => Some(value),
        Err(_) => text
            .contains(['d', 'D'])
            .then(|| text.replace(['d', 'D'], "e").parse().ok())?,
    }
}
