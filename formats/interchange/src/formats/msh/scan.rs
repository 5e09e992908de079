//! Words and numbers of a Gmsh mesh, text or binary.

use crate::ReadError;
use crate::text::{Tokens, shown};

/// A file that is read from its beginning to its end.
pub struct Scanner<'a> {
    /// Its words.
    pub tokens: Tokens<'a>,
    bytes: &'a [u8],
    /// Whether numbers are binary, where the format has them so.
    pub binary: bool,
    /// Whether the highest byte of those comes first.
    pub big: bool,
}

impl<'a> Scanner<'a> {
    /// A text, until its header says otherwise.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            tokens: Tokens::new(bytes, "msh", None),
            bytes,
            binary: false,
            big: false,
        }
    }
}

impl Scanner<'_> {
    /// An error at this place.
    pub fn error(&self, what: impl std::fmt::Display) -> ReadError {
        self.tokens.error(what)
    }

    /// Passes over a section whatever bytes it holds.
    pub fn skip_section(&mut self, section: &[u8]) -> Result<&[u8], ReadError> {
        let end = [b"\n$End", section].concat();
        let rest = &self.bytes[self.at()..];
        let ends = |at: &usize| {
            let next = rest.get(at + end.len());
            next.is_none_or(u8::is_ascii_whitespace)
        };
        let found = rest.windows(end.len()).enumerate();
        let found = found.filter(|(_, part)| *part == end).map(|(at, _)| at);
        let first = found.into_iter().find(ends);
        let Some(at) = first else {
            let name = shown(section);
            return Err(self.error(format!("section '{name}' does not end")));
        };
        self.tokens.skip(at + end.len());
        Ok(&rest[..at])
    }

    fn at(&self) -> usize {
        self.bytes.len() - self.tokens.left()
    }

    /// Goes to the next line.
    pub fn end_line(&mut self) {
        self.tokens.rest_of_line();
        self.tokens.skip(1);
    }

    /// Bytes as they are, whatever the mode.
    pub fn raw<const N: usize>(&mut self, what: &str) -> Result<[u8; N], ReadError> {
        let at = self.at();
        let found = self.bytes[at..].first_chunk::<N>();
        let Some(&bytes) = found else {
            return Err(self.error(format!("{what} expected, but the file ends here")));
        };
        // The line counter minds line feeds that are skipped one by one only.
        self.tokens.skip(N);
        Ok(bytes)
    }

    /// A 32-bit number of a binary file.
    pub fn int(&mut self, what: &str) -> Result<i64, ReadError> {
        if !self.binary {
            return self.tokens.integer(what);
        }
        let bytes = self.raw::<4>(what)?;
        let value = if self.big {
            i32::from_be_bytes(bytes)
        } else {
            i32::from_le_bytes(bytes)
        };
        Ok(i64::from(value))
    }

    /// A 64-bit number of a binary file.
    pub fn size(&mut self, what: &str) -> Result<u64, ReadError> {
        if !self.binary {
            return Ok(self.tokens.count(what)? as u64);
        }
        let bytes = self.raw::<8>(what)?;
        Ok(if self.big {
            u64::from_be_bytes(bytes)
        } else {
            u64::from_le_bytes(bytes)
        })
    }

    /// A coordinate.
    pub fn double(&mut self) -> Result<f64, ReadError> {
        if !self.binary {
            return self.tokens.coordinate();
        }
        let bytes = self.raw::<8>("a coordinate")?;
        let value = if self.big {
            f64::from_be_bytes(bytes)
        } else {
            f64::from_le_bytes(bytes)
        };
        if !value.is_finite() {
            return Err(self.error(format!("the coordinate {value} is not finite")));
        }
        Ok(value)
    }

    /// A count of things that take so many bytes each at least, in either mode.
    pub fn count(&mut self, what: &str, text: u64, binary: u64) -> Result<u64, ReadError> {
        let count = self.size(what)?;
        self.fits(count, what, text, binary)?;
        Ok(count)
    }

    /// Refuses a count of things that do not fit into what is left, with so many bytes each at least.
    pub fn fits(&self, count: u64, what: &str, text: u64, binary: u64) -> Result<(), ReadError> {
        let each = if self.binary { binary } else { text };
        let left = self.tokens.left() as u64;
        // The last word of a text needs no space after it.
        if count.saturating_mul(each) > left.saturating_add(1) {
            return Err(self.error(format!("{count} as {what}, and {left} bytes are left")));
        }
        Ok(())
    }
}
