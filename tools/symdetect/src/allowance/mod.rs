//! Deviations beyond the tolerance that the facets of smooth surfaces explain.
//!
//! A deviation at one place is explained when the facets there are coarse enough (see `shape`). That alone would take a
//! dent in a coarse bore for a facet, so that the deviations as a whole must look like those of facets too: found all
//! around, and averaging out over every neighbourhood.

mod displacement;
pub mod model;
mod place;
mod swing;
mod widespread;

use crate::shape::Shape;
use crate::verify::{Operation, some_powers};
use tmesh::Frame;

pub use displacement::displaces;

/// Whether the deviations of up to `value` under the rotation of order `n` look like differences
/// between facets, beyond each being explained by the facets there.
pub fn is_of_facets(shape: &Shape, frame: &Frame, n: u32, value: f64, limit: f64) -> bool {
    let target = shape.target_in_place();
    let turned = |power| Operation::new(frame, power, target.clone());
    widespread::is_widespread(shape, frame, n, value)
        && (some_powers(n).into_iter()).all(|p| !displaces(shape, frame, &turned(p), limit))
}
