//! Bodies swept around an axis: sections of one pitch, repeated exactly by the rotations of their order.

mod prisms;
mod rotors;
mod screw;
mod sweep;
mod twisted;
mod usual;

pub use prisms::{Coating, PracticalTsv, Prism, Tsv, cube};
pub use rotors::{Gear, Impeller, Ratchet};
pub use screw::Screw;
pub use sweep::Tessellation;
pub use twisted::{HelicalGear, TwistedBar};
