//! Names of sets.

use crate::text;

/// Names that are unique beside those of the sets of all nodes and all elements; see [`text::fitting`].
pub fn fitting(names: impl Iterator<Item = Option<String>>) -> Vec<String> {
    text::fitting(names, &["all-nodes", "all-elements"])
}
