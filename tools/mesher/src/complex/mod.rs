//! A template's surface as a piecewise linear complex.

mod description;
mod facets;
mod flat;
mod plc;
mod relief;
mod seeds;
mod settled;

pub use description::{Description, Order};
pub use facets::{Attributes, Facet, Facets};
pub use plc::{Plc, SizeSeed};
pub use relief::Relief;
pub use settled::settled;
