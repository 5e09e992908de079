//! Where a body is put, and how it is disturbed.

use crate::Body;
use crate::Random;
use glam::{DMat3, DQuat, DVec3};

/// A rigid motion, a scale and a disturbance, applied as jitter, motion, scale.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Seed of a random rotation and of a random shift by up to three units along each axis.
    pub rotate: Option<u64>,
    /// Factor on all coordinates, shift included.
    pub scale: f64,
    /// Largest random displacement of a vertex along each axis.
    pub jitter: f64,
}

impl Default for Placement {
    /// Where the body is made.
    fn default() -> Self {
        Self {
            rotate: None,
            scale: 1.0,
            jitter: 0.0,
        }
    }
}

impl Placement {
    /// Rotation and shift of the placement.
    fn motion(&self) -> (DMat3, DVec3) {
        let Some(seed) = self.rotate else {
            return (DMat3::IDENTITY, DVec3::ZERO);
        };
        let mut random = Random::new(seed);
        // A uniform rotation: a point of the 4-ball, not too near to its centre.
        let rotation = loop {
            let (v, w) = (random.vector(), random.signed());
            let q = DQuat::from_xyzw(v.x, v.y, v.z, w);
            if (0.1..=1.0).contains(&q.length()) {
                break DMat3::from_quat(q.normalize());
            }
        };
        (rotation, 3.0 * random.vector())
    }

    /// Moves a body.
    pub fn apply(&self, body: &mut Body) {
        let (rotation, shift) = self.motion();
        let mut random = Random::new(self.rotate.unwrap_or(0) ^ 0x6a69_7474_6572);
        for p in &mut body.vertices {
            let disturbed = *p + self.jitter * random.vector();
            *p = self.scale * (rotation * disturbed + shift);
        }
    }
}
