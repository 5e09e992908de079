//! Cutting one candidate: from the body to the templates, their copies and what was done.

mod candidate;
mod copies;
mod cut;
mod volumes;

pub use candidate::{Candidate, Place};
pub use cut::{Cut, cut};
