//! Checks of a template on its own: its tetrahedra, their faces, its triangles and vertices.

mod conformity;
mod orientation;
mod skin;
mod surface;
mod table;
mod vertices;

pub use conformity::conformity;
pub use orientation::inverted;
pub use skin::Skin;
pub use surface::closedness;
pub use table::sorted;
pub use vertices::coincident_vertices;
