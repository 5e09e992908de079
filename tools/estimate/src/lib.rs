//! What a wedge of a symmetric body would cost to mesh.
//!
//! Elements are as large as the features near them allow: the thickness of layers, the length of edges, a size that
//! was asked for. A wedge that is narrower than that makes them smaller, and where the axis runs through material
//! every wedge is narrow there. The number of elements is the integral of the inverse cube of their size over the
//! body's section, for the whole body and for every way to cut it ([`Estimate`]); the fastest way wins among those
//! that cost few more elements than the whole body ([`Ways`]). [`harm`] tells the places where a cut costs most.
//!
//! Every coefficient is a field of [`CostModel`]; `make calibrate` measures them.

mod asked;
mod elements;
mod features;
pub mod harm;
mod model;
mod needles;
mod remade;
mod steep;
mod sum;
mod way;
mod ways;
mod wedge;

pub use asked::Asked;
pub use elements::{Estimate, Terms};
pub use model::{Accepted, CostModel};
pub use needles::needles;
pub use way::{Cut, Way};
pub use ways::{Bounds, Hubs, Ways};
pub use wedge::{Wedge, edge_of_volume};
