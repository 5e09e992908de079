//! The bodies of all tests, each with exactly known symmetry, regions and volumes.
//!
//! A [`Body`] is a list of vertices and of triangles with the material on either side. [`swept`] builds
//! bodies from rings around an axis, so that neighbouring materials share their triangles, and
//! [`orbits`] bodies that their group turns over. [`random_solid`]
//! makes bodies from random numbers, [`adversarial`] the shapes that make programs slow, [`facets`] and
//! [`files`] what the readers of files are given, and [`structured`] and
//! [`wedges`] documents of wedges, meshed and not, without any of the tools.

pub mod adversarial;
mod body;
mod chance;
pub mod facets;
pub mod files;
pub mod orbits;
mod output;
mod placement;
pub mod random_solid;
pub mod structured;
pub mod swept;
pub mod wedges;

pub use body::{Body, Face, Material};
pub use chance::{Dice, Random};
pub use orbits::{AlternatingWheel, Antiprism, SawWheel};
pub use output::{Encoding, write};
pub use placement::Placement;
pub use swept::{
    Coating, Gear, HelicalGear, Impeller, PracticalTsv, Prism, Ratchet, Screw, Tessellation, Tsv,
    TwistedBar, cube,
};
