//! How much a cut harms the body at the place where it is made.

pub mod halved;
pub mod sliced;
