//! Bodies of revolution-like symmetry with exactly known order, mirrors, regions and volumes.
//!
//! Every body is a [`Body`]: vertices, and triangles with the material on either side. It is built
//! from [`sweep`] rings and strips, so neighbouring materials share their triangles.

mod body;
mod output;
mod placement;
pub mod random;
mod rotors;
mod screw;
mod solids;
mod sweep;

pub use body::{Body, Face, Material};
pub use output::{Encoding, write};
pub use placement::Placement;
pub use rotors::{Gear, Impeller, Ratchet};
pub use screw::Screw;
pub use solids::{Coating, PracticalTsv, Prism, Tsv, cube};
pub use sweep::Tessellation;
