//! Welding of points with equal coordinates.

use glam::DVec3;

const EMPTY: u32 = u32::MAX;

/// Gives each distinct point one id, in order of first appearance.
///
/// An open-addressing table of ids only: the keys are the points themselves.
pub struct Welder {
    slots: Vec<u32>,
    points: Vec<DVec3>,
}

impl Welder {
    /// A welder that expects about `expected` distinct points.
    pub fn new(expected: usize) -> Self {
        Self {
            slots: vec![EMPTY; (2 * expected).next_power_of_two().max(16)],
            points: Vec::with_capacity(expected),
        }
    }

    /// Id of the point; `-0.0` equals `0.0`. The coordinates must not be NaN.
    pub fn id(&mut self, point: DVec3) -> u32 {
        // Adding zero turns -0.0 into 0.0 and leaves everything else.
        let point = point + DVec3::ZERO;
        let slot = self.slot(point);
        if self.slots[slot] != EMPTY {
            return self.slots[slot];
        }
        let id = self.points.len() as u32;
        self.points.push(point);
        self.slots[slot] = id;
        if 2 * self.points.len() > self.slots.len() {
            self.grow();
        }
        id
    }

    /// The distinct points.
    pub fn into_points(self) -> Vec<DVec3> {
        self.points
    }

    fn slot(&self, point: DVec3) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = hash(point) as usize & mask;
        loop {
            let id = self.slots[slot];
            if id == EMPTY || self.points[id as usize] == point {
                return slot;
            }
            slot = (slot + 1) & mask;
        }
    }

    fn grow(&mut self) {
        self.slots = vec![EMPTY; 2 * self.slots.len()];
        for id in 0..self.points.len() {
            let slot = self.slot(self.points[id]);
            self.slots[slot] = id as u32;
        }
    }
}

/// Mixes all bits of all coordinates: coordinates of single precision have zeros in the low half.
fn hash(p: DVec3) -> u64 {
    let mut h = 0_u64;
    for x in [p.x, p.y, p.z] {
        h = (h ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        h ^= h >> 32;
    }
    h.wrapping_mul(0xd6e8_feb8_6659_fd93) >> 20
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_points_share_an_id() {
        let mut welder = Welder::new(1);
        let grid: Vec<DVec3> = (0..1000)
            .map(|i| {
                DVec3::new(
                    f64::from(i % 10),
                    f64::from(i / 10 % 10),
                    f64::from(i / 100),
                )
            })
            .collect();
        for _ in 0..2 {
            for (i, p) in grid.iter().enumerate() {
                assert_eq!(welder.id(*p), i as u32);
            }
        }
        assert_eq!(welder.id(DVec3::new(-0.0, 0.0, -0.0)), 0);
        assert_eq!(welder.id(DVec3::new(1e-300, 0.0, 0.0)), 1000);
        assert_eq!(welder.into_points().len(), 1001);
    }
}
