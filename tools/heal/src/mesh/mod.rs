//! From a mesh with labels to a document.

mod build;
mod found;
mod skin;

pub use build::build;
pub use skin::surface;
