//! Numbers and points in messages.

use glam::DVec3;
use std::fmt;

/// A point, for messages.
#[derive(Clone, Copy, Debug)]
pub struct At(pub DVec3);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(short);
        write!(f, "({x}, {y}, {z})")
    }
}

/// A number with six significant digits.
pub fn short(x: f64) -> String {
    let text = format!("{x:.5e}");
    match text.parse::<f64>() {
        Ok(0.0) => "0".to_owned(),
        Ok(y) if (1e-4..1e7).contains(&y.abs()) => format!("{y}"),
        Ok(y) => format!("{y:e}"),
        Err(_) => text,
    }
}
