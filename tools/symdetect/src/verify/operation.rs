//! Operations to be tested.

use crate::shape::{Motion, Target};
use glam::{DMat3, DVec3};
use tmesh::{Frame, Isometry};

/// An operation and what images may land on.
pub struct Operation {
    /// The motion.
    pub motion: Motion,
    /// Where triangles may land.
    pub target: Target,
}

impl Operation {
    /// The operation that an isometry is in a frame.
    pub fn new(frame: &Frame, isometry: Isometry, target: Target) -> Self {
        Self {
            motion: Motion::new(frame, isometry.matrix()),
            target,
        }
    }
}

/// Rotations about z by multiples of the golden section of a turn, spread evenly however many are taken.
pub fn golden_turns(count: usize) -> impl Iterator<Item = DMat3> {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    (1..=count).map(|i| turn_matrix((i as f64 * GOLDEN).fract()))
}

/// The same as operations in a frame.
pub fn golden_rotations(frame: &Frame, count: usize, target: Target) -> Vec<Operation> {
    let turned = |matrix| Operation {
        motion: Motion::new(frame, matrix),
        target: target.clone(),
    };
    golden_turns(count).map(turned).collect()
}

/// Rotation about z by a fraction of a full turn.
pub fn turn_matrix(turn: f64) -> DMat3 {
    let (s, c) = libm::sincos(std::f64::consts::TAU * turn);
    DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
}

/// A handful of powers of the rotation by a turn over `n` that tell it from other orders: by about a half, a third and
/// so on of a turn.
pub fn some_powers(n: u32) -> Vec<Isometry> {
    let mut ks = vec![1, n / 2, n / 3, 2 * n / 5, n / 5, 3 * n / 7];
    ks.retain(|&k| k > 0 && k < n);
    ks.sort_unstable();
    ks.dedup();
    let power = |k| Isometry::rotation(i64::from(k), n);
    ks.into_iter().map(power).collect()
}
