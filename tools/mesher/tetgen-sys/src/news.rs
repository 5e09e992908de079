//! What is heard of TetGen.

use crate::Counts;

/// What is heard of TetGen while it works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum News<'a> {
    /// What it printed, in pieces of any length.
    Printed(&'a [u8]),
    /// How far it is.
    Counted(Counts),
}
