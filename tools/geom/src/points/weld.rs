//! Points with equal coordinates.

/// No point.
const EMPTY: u32 = u32::MAX;

/// Gives each distinct point of `N` coordinates one number, in the order of first appearance.
///
/// An open-addressing table of numbers only: the keys are the points themselves.
pub struct Welder<const N: usize> {
    slots: Vec<u32>,
    points: Vec<[f64; N]>,
}

impl<const N: usize> Welder<N> {
    /// A welder that expects about `expected` distinct points.
    pub fn new(expected: usize) -> Self {
        Self {
            slots: vec![EMPTY; (2 * expected).next_power_of_two().max(16)],
            points: Vec::with_capacity(expected),
        }
    }

    /// Number of the point, and whether it is a new one. `-0.0` equals `0.0`. The coordinates must not be NaN.
    pub fn add(&mut self, point: impl Into<[f64; N]>) -> (u32, bool) {
        // Adding zero turns -0.0 into 0.0 and leaves everything else.
        let point = point.into().map(|x| x + 0.0);
        let slot = self.slot(&point);
        if self.slots[slot] != EMPTY {
            return (self.slots[slot], false);
        }
        let number = self.points.len() as u32;
        self.points.push(point);
        self.slots[slot] = number;
        if 2 * self.points.len() > self.slots.len() {
            self.grow();
        }
        (number, true)
    }

    /// Number of the point; see [`Welder::add`].
    pub fn id(&mut self, point: impl Into<[f64; N]>) -> u32 {
        self.add(point).0
    }

    /// Number of the point if it has been added.
    pub fn find(&self, point: impl Into<[f64; N]>) -> Option<u32> {
        let point = point.into().map(|x| x + 0.0);
        Some(self.slots[self.slot(&point)]).filter(|&number| number != EMPTY)
    }

    /// The distinct points.
    pub fn into_points(self) -> Vec<[f64; N]> {
        self.points
    }

    fn slot(&self, point: &[f64; N]) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = hash(point) as usize & mask;
        loop {
            let number = self.slots[slot];
            if number == EMPTY || self.points[number as usize] == *point {
                return slot;
            }
            slot = (slot + 1) & mask;
        }
    }

    fn grow(&mut self) {
        self.slots = vec![EMPTY; 2 * self.slots.len()];
        for number in 0..self.points.len() {
            let slot = self.slot(&self.points[number]);
            self.slots[slot] = number as u32;
        }
    }
}

/// Mixes all bits of all coordinates: coordinates of single precision have zeros in the low half.
fn hash<const N: usize>(point: &[f64; N]) -> u64 {
    let mut h = 0_u64;
    for x in point {
        h = (h ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        h ^= h >> 32;
    }
    h.wrapping_mul(0xd6e8_feb8_6659_fd93) >> 20
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

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
        for round in 0..2 {
            for (i, p) in grid.iter().enumerate() {
                assert_eq!(welder.add(*p), (i as u32, round == 0));
            }
        }
        assert_eq!(welder.id(DVec3::new(-0.0, 0.0, -0.0)), 0);
        assert_eq!(welder.id(DVec3::new(1e-300, 0.0, 0.0)), 1000);
        assert_eq!(welder.find(DVec3::splat(0.5)), None);
        assert_eq!(welder.find(DVec3::new(2.0, -0.0, 0.0)), Some(2));
        assert_eq!(welder.into_points().len(), 1001);
    }

    #[test]
    fn points_of_a_plane_are_welded_too() {
        let mut welder = Welder::new(0);
        let ids = [DVec2::X, DVec2::Y, DVec2::new(1.0, -0.0)].map(|p| welder.id(p));
        assert_eq!(ids, [0, 1, 0]);
    }
}
