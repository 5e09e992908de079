//! Taking out detail too small to mesh.

mod short;
mod sides;

pub use short::collapse_short_edges;
pub use sides::collapse_at_sides;
