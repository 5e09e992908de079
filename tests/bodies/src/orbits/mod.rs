//! Bodies that the group turns over, made as orbits of a patch of their surface.

mod antiprism;
mod orbit;
mod wheels;

pub use antiprism::Antiprism;
pub use wheels::{AlternatingWheel, SawWheel};
