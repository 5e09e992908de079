//! Meshed wedges, and the whole meshes assembled of them by welding placed copies.

mod prisms;
mod sectors;
mod tets;

pub use prisms::{assembled, skin, wedge};
pub use sectors::sector;
