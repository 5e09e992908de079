//! What the tests use where the value does not matter: radius 1, no bore, the same triangles in every sector.

use super::{Gear, Impeller, Prism, Ratchet, Tessellation, Tsv};

impl Default for Prism {
    fn default() -> Self {
        Self {
            order: 6,
            radius: 1.0,
            height: 1.0,
            bore: 0.0,
            tessellation: Tessellation::Symmetric,
        }
    }
}

impl Default for Tsv {
    fn default() -> Self {
        Self {
            order: 6,
            radius: 1.0,
            core: 0.2,
            thickness: 0.02,
            height: 1.0,
            tessellation: Tessellation::Symmetric,
        }
    }
}

impl Default for Gear {
    fn default() -> Self {
        Self {
            order: 6,
            radius: 1.0,
            bore: 0.0,
            height: 0.5,
            tessellation: Tessellation::Symmetric,
        }
    }
}

impl Default for Ratchet {
    fn default() -> Self {
        Self {
            order: 6,
            radius: 1.0,
            bore: 0.0,
            coating: 0.0,
            height: 0.5,
            tessellation: Tessellation::Symmetric,
        }
    }
}

impl Default for Impeller {
    fn default() -> Self {
        Self {
            order: 6,
            radius: 1.0,
            bore: 0.0,
            height: 0.5,
            twist: 0.3,
            layers: 3,
            tessellation: Tessellation::Symmetric,
        }
    }
}
