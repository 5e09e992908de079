//! What counts as equal, in one place.

pub use geom::tolerance::PROMISE;
