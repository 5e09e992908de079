//! Better triangles for a surface, which stays within a distance of what it was.
//!
//! Where triangles stand for a curved surface, their shape is the exporter's: needles, slivers beside a cut, bands. They are
//! remeshed by collapsing, splitting and flipping edges and by moving vertices along the surface (Botsch and Kobbelt, "A
//! remeshing approach to multiresolution modeling", 2004), each step only if the surface stays in the envelope of the
//! input (after Hu et al., "Fast tetrahedral meshing in the wild", 2020). How wide the envelope is, is
//! what the triangles there hide of the shape that they stand for ([`Shape`]): flat faces hide nothing and stay as they are.
//! Self-intersections are found exactly when all is done, and what is near one is done again without them.

mod input;
mod mesh;
mod passes;
mod shape;
mod smooth;

pub use input::{Drawn, Link, MOST_LINKS, Rules, Sizes, Surface};
pub use mesh::Sample;
pub use passes::{Remeshed, Told, remesh};
pub use shape::{Curve, Ground, Wanted};
pub use smooth::{Drawing, Reading, Redrawn, Sheets, SmoothShape};
