//! Words and numbers of text files.

mod decimal;
mod names;
mod precision;
mod tokens;
mod words;

pub(crate) use decimal::significant_digits;
pub(crate) use names::fitting;
pub(crate) use precision::TextPrecision;
pub use precision::{DOUBLE, SINGLE};
pub(crate) use tokens::{Tokens, number, shown};
pub(crate) use words::{MAX_TITLE, one_line};
pub use words::{counted, plain};
