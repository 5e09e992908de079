//! One file among several, and what its regions are called.

use crate::soup::Mended;
use interchange::Format;
use tmesh::{HistoryEntry, Size};

/// What the regions of a file are called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Naming {
    /// All of the file is one region of this name.
    Region(String),
    /// A file of one solid is a region of this name; one of several solids is a region for each, of the solid's name.
    File(String),
}

impl Naming {
    /// The name.
    pub fn name(&self) -> &str {
        match self {
            Self::Region(name) | Self::File(name) => name,
        }
    }
}

/// One file among several: closed surfaces of solids.
pub struct Part {
    pub(super) mended: Mended,
    pub(super) naming: Naming,
    /// Largest element volume that the file asks for in each solid; empty where it asks for none.
    pub(super) wishes: Vec<Option<Size>>,
    pub(super) format: Format,
    pub(super) history: Vec<HistoryEntry>,
}

impl Part {
    /// Takes what the user should know about the file, a sentence each, so that it can be told with the file's name.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.mended.notices)
    }
}
