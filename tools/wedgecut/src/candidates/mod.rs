//! What could be cut, and the first of it that can be.
//!
//! Candidates are a list: the subgroups of the group found, with and without a hub, the cheapest to mesh first
//! ([`estimate`]), each at the places where the cut harms least. The first that can be cut is taken; why the others
//! could not is kept.

mod angles;
mod choice;
mod groups;
mod places;
mod refusals;
mod search;

pub use search::search;
