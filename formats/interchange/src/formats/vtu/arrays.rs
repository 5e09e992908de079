//! Arrays of a VTK XML file: text, base64 or raw, plain or compressed with zlib.
//!
//! All arrays together take no more memory than a small multiple of the bytes of the file.

use crate::ReadError;
use crate::binary::{Order, Scalar};
use crate::text::{number, shown};
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use flate2::{Decompress, FlushDecompress, Status};
use std::cell::Cell;

/// Compressed arrays may expand to this many times the file together, and [`SLACK`] bytes: arrays of
/// meshes shrink by a factor of 2 to 10, constant ones by 1000, and beside those there are always
/// coordinates. A smaller factor refuses meshes, a larger one lets a small file take all memory.
const EXPANSION: usize = 30;
/// What tiny files may expand to: a few arrays of constants shrink by more than [`EXPANSION`].
const SLACK: usize = 1 << 22;

/// The data behind all tags.
#[derive(Clone, Copy, Default)]
pub struct Appended<'a> {
    /// Behind the underscore.
    pub data: &'a [u8],
    /// Bytes as they are, else base64.
    pub raw: bool,
}

/// One array.
pub struct Array<'a> {
    /// Name of the element that it is in.
    pub section: String,
    /// Its own name.
    pub name: String,
    /// Names of its components, as far as they have any.
    pub components: Vec<String>,
    /// Its number type, if that is known.
    pub scalar: Option<Scalar>,
    /// Its numbers.
    pub place: Place<'a>,
}

/// Where the numbers of an array are.
pub enum Place<'a> {
    /// In the tag, as words.
    Text(&'a [u8]),
    /// In the tag, as base64.
    Base64(&'a [u8]),
    /// So many bytes behind the beginning of the appended data.
    Appended(Option<usize>),
}

/// How the numbers of all binary arrays of a file are written.
pub struct Encoding {
    /// Order of the bytes.
    pub order: Order,
    /// Bytes of each of the sizes before an array: 4 or 8.
    pub header: usize,
    /// Whether arrays are compressed.
    pub compressed: bool,
}

/// Decodes arrays.
pub struct Arrays<'a> {
    encoding: Encoding,
    appended: Appended<'a>,
    /// Bytes that compressed arrays may still expand to.
    budget: Cell<usize>,
}

/// The error that a file is not what the format wants.
pub fn malformed(reason: impl Into<String>) -> ReadError {
    ReadError::Malformed {
        format: "vtu",
        reason: reason.into(),
    }
}

impl<'a> Arrays<'a> {
    /// For a file of `file_size` bytes.
    pub fn new(encoding: Encoding, appended: Appended<'a>, file_size: usize) -> Self {
        let budget = file_size.saturating_mul(EXPANSION).saturating_add(SLACK);
        Self {
            encoding,
            appended,
            budget: Cell::new(budget),
        }
    }

    /// The numbers of an array.
    ///
    /// # Errors
    /// An unknown type, words that are no numbers, sizes beyond the end.
    pub fn values(&self, array: &Array<'_>) -> Result<Vec<f64>, ReadError> {
        let name = &array.name;
        let scalar = array
            .scalar
            .ok_or_else(|| malformed(format!("array '{name}' has a type that is not known")))?;
        match array.place {
            Place::Appended(None) => Err(malformed(format!("array '{name}' has no offset"))),
            Place::Appended(Some(offset)) => {
                let data = self.appended.data.get(offset..).unwrap_or_default();
                if self.appended.raw {
                    self.block(data, scalar, name)
                } else {
                    self.block(&base64(data), scalar, name)
                }
            }
            Place::Base64(content) => self.block(&base64(content.trim_ascii()), scalar, name),
            Place::Text(content) => content
                .split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty())
                .map(|w| {
                    number(w).ok_or_else(|| {
                        malformed(format!("array '{name}': '{}' is not a number", shown(w)))
                    })
                })
                .collect(),
        }
    }

    /// Numbers of a block: its size in bytes, then the bytes.
    fn block(&self, data: &[u8], scalar: Scalar, name: &str) -> Result<Vec<f64>, ReadError> {
        let numbers = |items: &[u8]| {
            let items = items.chunks_exact(scalar.size());
            items
                .map(|b| scalar.value(b, self.encoding.order))
                .collect()
        };
        if self.encoding.compressed {
            return Ok(numbers(&self.inflate(data, name)?));
        }
        let items = data
            .split_at_checked(self.encoding.header)
            .and_then(|(size, rest)| {
                let size = Scalar::Unsigned(self.encoding.header).value(size, self.encoding.order);
                (size <= rest.len() as f64).then(|| &rest[..size as usize])
            });
        items
            .map(numbers)
            .ok_or_else(|| malformed(format!("array '{name}' goes beyond the end of the file")))
    }

    /// Bytes of a compressed block: the number of parts, the size of a part, that of the last one if it is
    /// smaller, the compressed sizes; then the parts.
    fn inflate(&self, data: &[u8], name: &str) -> Result<Vec<u8>, ReadError> {
        let beyond = || malformed(format!("array '{name}' goes beyond the end of the file"));
        let header = self.encoding.header;
        let number = |i: usize| {
            let at = i.checked_mul(header)?;
            let bytes = data.get(at..at.checked_add(header)?)?;
            Some(Scalar::Unsigned(header).value(bytes, self.encoding.order) as usize)
        };
        let head = number(0).zip(number(1)).zip(number(2));
        let ((parts, size), last) = head.ok_or_else(beyond)?;
        if parts > data.len() / header {
            return Err(beyond());
        }
        let total = match (parts, last) {
            (0, _) => Some(0),
            (n, 0) => n.checked_mul(size),
            (n, last) => (n - 1).checked_mul(size).and_then(|t| t.checked_add(last)),
        };
        let left = total.and_then(|total| self.budget.get().checked_sub(total));
        let (Some(total), Some(left)) = (total, left) else {
            return Err(malformed(format!(
                "array '{name}' claims to expand to more than {EXPANSION} times the file"
            )));
        };
        self.budget.set(left);
        let mut at = (3 + parts) * header;
        let mut out = Vec::with_capacity(total);
        let damaged = || malformed(format!("array '{name}' is not compressed as it says"));
        for part in 0..parts {
            let compressed = number(3 + part).ok_or_else(beyond)?;
            let end = at.checked_add(compressed).ok_or_else(beyond)?;
            let bytes = data.get(at..end).ok_or_else(beyond)?;
            let expected = if part + 1 == parts && last != 0 {
                last
            } else {
                size
            };
            let before = out.len();
            // Never more than the total is written, for there is no capacity for it.
            let status = Decompress::new(true)
                .decompress_vec(bytes, &mut out, FlushDecompress::Finish)
                .map_err(|_| damaged())?;
            if status == Status::BufError || out.len() - before != expected {
                return Err(damaged());
            }
            at = end;
        }
        Ok(out)
    }
}

/// Takes groups without padding, and whatever bits are left over at their end.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_allow_trailing_bits(true)
        .with_decode_padding_mode(DecodePaddingMode::RequireNone),
);

/// Bytes of a base64 text up to the first character that is none; padding may come in between, after
/// a header of its own.
fn base64(text: &[u8]) -> Vec<u8> {
    let is_digit = |c: u8| c.is_ascii_alphanumeric() || c == b'+' || c == b'/';
    let is_end = |c: &u8| !is_digit(*c) && *c != b'=' && !c.is_ascii_whitespace();
    let end = text.iter().position(is_end).unwrap_or(text.len());
    let mut bytes = Vec::with_capacity(end / 4 * 3);
    for run in text[..end].split(|&c| c == b'=') {
        let mut digits: Vec<u8> = Vec::with_capacity(run.len());
        digits.extend(run.iter().filter(|c| !c.is_ascii_whitespace()));
        // One digit alone is less than a byte.
        if digits.len() % 4 == 1 {
            digits.pop();
        }
        // Nothing but digits in groups of two to four is left, which cannot fail.
        let _ = BASE64.decode_vec(&digits, &mut bytes);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_with_padding_inside() {
        assert_eq!(base64(b"BAAAAA==AQID BA=="), [4, 0, 0, 0, 1, 2, 3, 4]);
        assert_eq!(base64(b"TWFu<"), b"Man");
        assert_eq!(base64(b"TWF"), b"Ma");
        assert_eq!(base64(b"TWFuT"), b"Man");
    }
}
