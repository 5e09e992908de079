//! The bodies of all tests, each with exactly known symmetry, regions and volumes.
//!
//! A [`Body`] is a list of vertices and of triangles with the material on either side. [`swept`] builds bodies
//! from rings around an axis, so that neighbouring materials share their triangles, [`orbits`] bodies that their
//! group turns over, [`random_solid`] and [`bladed`] bodies from random numbers, and [`assembly`] solids drawn one by one.
//!
//! [`adversarial`] has the shapes that make programs slow, [`facets`] and [`files`] have what the readers of files
//! are given. [`structured`], [`wedges`] and [`meshes`] make documents of wedges without any of the tools.

pub mod adversarial;
pub mod assembly;
pub mod bladed;
mod body;
mod chance;
pub mod facets;
pub mod files;
pub mod folded;
pub mod meshes;
pub mod orbits;
mod output;
mod placement;
mod polar;
pub mod random_solid;
pub mod rounded;
pub mod rounds;
pub mod structured;
pub mod swept;
pub mod torn;
pub mod wedges;

pub use body::{Body, Face, Material};
pub use chance::{Dice, Random};
pub use orbits::{AlternatingWheel, Antiprism, SawWheel};
pub use output::{Encoding, write};
pub use placement::Placement;
pub use polar::{Cell, PolarGrid};
pub use swept::{
    Coating, Gear, HelicalGear, Impeller, PracticalTsv, Prism, Ratchet, Screw, Tessellation, Tsv,
    TwistedBar, cube,
};
