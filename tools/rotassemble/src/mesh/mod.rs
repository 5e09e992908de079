//! The whole mesh as a stream: copies of templates, placed and welded while they are written.

mod assembled;
mod copies;
mod open;
mod patches;
mod piece;
mod stream;
mod tets;
mod triangles;

pub use assembled::Assembled;
pub use piece::Piece;
