//! The body as arrays that symmetry tests can work on: vertices, triangles, interfaces, samples, flat faces, moments.

mod body;
mod directional;
mod flat;
mod interfaces;
mod moments;
mod motion;
mod random;
mod regions;
mod samples;
mod smooth;
mod table;
mod trees;

pub use body::Shape;
pub use directional::DirectionalMoment;
pub use flat::{Faces, Flats};
pub use motion::{Motion, NO_CLASS, Target};
pub use random::Random;
pub use regions::Permutation;
pub use samples::Sample;
pub use smooth::Told;
