//! Closing of cracks: corners that differ in their last digits, corners on edges, gaps along the curves where
//! a CAD program's faces meet, each of which it divides by itself.
//!
//! First a closing is *proposed* that the shape of the cracks suggests: corners are joined that are nearer to
//! each other than to any neighbour, and edges are divided at the corners that lie beside them. Then it is
//! *measured*: no corner may have been moved farther than the facets there can be off the shape that they
//! stand for.

mod alike;
mod allowance;
mod close;
mod join;
mod near;
mod rim;
mod split;

pub use alike::divide_alike;
pub use close::close;
pub use split::Division;
