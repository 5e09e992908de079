//! What is made of a file's surfaces.

use crate::Repairing;

/// What the solids of a file are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solids {
    /// Groups, where each of them is closed.
    #[default]
    Groups,
    /// The closed shells of groups.
    Shells,
    /// All groups together.
    Whole,
}

/// What is made of a file's surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Healing {
    /// Whether what it holds may be changed.
    pub repairing: Repairing,
    /// What its solids are.
    pub solids: Solids,
}

impl From<Repairing> for Healing {
    fn from(repairing: Repairing) -> Self {
        Self {
            repairing,
            ..Self::default()
        }
    }
}
