//! What the triangles of the input stand for: flat faces, curved patches, curves between them, and how far the shape may be
//! from its facets.

mod allowance;
mod arc;
mod beside;
mod beyond;
mod curves;
mod envelope;
mod facets;
mod ground;
mod patches;
mod strips;
mod wanted;

pub use allowance::{Allowance, untold};
pub use arc::{DETAIL, LONG};
pub use beside::Beside;
pub use beyond::Beyond;
pub use curves::Curves;
pub use envelope::{Envelope, Near};
pub use facets::Facets;
pub use ground::Ground;
pub use patches::{ALIKE, Patches, UPRIGHT};
pub use wanted::{Curve, Wanted};
