//! Meshes for tests.

mod prisms;
mod sectors;

pub use prisms::{assembled, skin, wedge};
pub use sectors::sector;
