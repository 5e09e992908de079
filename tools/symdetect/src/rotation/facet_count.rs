//! The number of facets around a body of revolution.

use crate::budget::{GLANCE, SCAN};
use crate::rotation::find::OrderSearch;
use crate::shape::{Faces, Motion, Random, Shape, Target};
use std::f64::consts::PI;
use tmesh::{Frame, Isometry};

/// Factor by which the deviations of all other orders exceed those of the facet count's divisors. Those of a polygon
/// of n sides under another order are its sagitta, those of its own the noise; a noise of a third of the sagitta
/// leaves no doubt.
pub const SEPARATION: f64 = 3.0;

/// What the order of facets is told by.
struct Look<'a> {
    shape: &'a Shape,
    frame: &'a Frame,
    /// Corners of faces instead of vertices of the surface.
    faces: Option<&'a Faces>,
    /// Vertices or corners looked at.
    count: usize,
    /// Deviation from which on it makes no difference how large it is.
    reach: f64,
    /// Deviation below which it makes none.
    floor: f64,
}

impl Look<'_> {
    /// Deviation under an order itself, lower ones left out.
    fn measure(&self, n: u32, count: usize) -> f64 {
        let (shape, frame, reach) = (self.shape, self.frame, self.reach);
        let off = match self.faces {
            Some(faces) => deviation_of_corners(faces, frame, n, count, reach),
            None => deviation_of_vertices(shape, frame, n, count, reach),
        };
        off.max(self.floor)
    }

    /// The highest of the orders wanted whose divisors hold within `limit`, and distinctly better than all others up
    /// to `most`.
    fn tell(&self, mut wanted: impl Iterator<Item = u32>, most: u32, limit: f64) -> Option<u32> {
        let worst: Vec<f64> = (0..=most)
            .map(|n| {
                if n < 2 {
                    0.0
                } else {
                    self.measure(n, self.count)
                }
            })
            .collect();
        let apart = |n: u32, inside: f64| {
            let mut others = (2..=most).filter(|m| !n.is_multiple_of(*m));
            inside <= limit.min(self.reach / SEPARATION)
                && others.all(|m| worst[m as usize] >= SEPARATION * inside)
        };
        let largest = |n: u32, of: &dyn Fn(u32) -> f64| {
            let divisors = (2..=n).filter(|d| n.is_multiple_of(*d));
            divisors.map(of).fold(0.0, f64::max)
        };
        wanted.find(|&n| {
            // Most orders fail by themselves; their divisors are not looked at.
            worst[n as usize] <= limit
                && apart(n, largest(n, &|d| worst[d as usize]))
                && apart(n, largest(n, &|d| self.measure(d, SCAN)))
        })
    }
}

impl OrderSearch<'_> {
    /// The order whose divisors, and only they, hold distinctly better than all other orders; the
    /// highest of such orders. `None` when no order stands out within `limit`.
    pub fn facet_count(&self, frame: &Frame, limit: f64) -> Option<u32> {
        let shape = self.shape;
        // Rounding of coordinates is no distinction.
        let floor = 0.25 * shape.rounding();
        let look = |faces, count, reach| Look {
            shape,
            frame,
            faces,
            count,
            reach,
            floor,
        };
        // A few vertices tell; only when they do not, more of them. Exact symmetry is told from all else
        // close by, and where there are flat faces, corners that do not land on corners tell it.
        let far = SEPARATION * limit;
        let looks = [
            look(shape.faces(), GLANCE / 2, SEPARATION * floor),
            look(None, GLANCE / 2, far),
            look(None, SCAN / 2, far),
        ];
        let most = *self.orders.end();
        let wanted = || (3..=most).rev();
        (looks.iter()).find_map(|look| look.tell(wanted(), most, limit))
    }

    /// Whether facets may number `n` where the body is as much as `off` from one of revolution: a polygon of `n` sides is off its circle by its
    /// sagitta. Where that is more, at all radii that there are vertices at, circles have more facets, and `n` is a divisor that their numbers have in
    /// common.
    pub fn may_number(&self, frame: &Frame, n: u32, off: f64) -> bool {
        let shape = self.shape;
        let sagitta = 1.0 - libm::cos(PI / f64::from(n));
        let widest = SEPARATION * off / sagitta;
        let corners = shape.faces().map_or(&shape.vertices[..], Faces::corners);
        let radii = corners.iter().map(|&p| {
            let p = frame.to_canonical(p);
            p.truncate().length()
        });
        radii.filter(|r| *r > off).any(|r| r <= widest)
    }

    /// The order under which corners of flat faces land on corners to rounding, and under no other but its divisors;
    /// `None` without flat faces.
    pub fn order_of_corners(&self, frame: &Frame) -> Option<u32> {
        let floor = 0.25 * self.shape.rounding();
        let look = Look {
            shape: self.shape,
            frame,
            faces: Some(self.shape.faces()?),
            count: GLANCE / 2,
            reach: SEPARATION * floor,
            floor,
        };
        let most = *self.orders.end();
        look.tell((3..=most).rev(), most, floor)
    }
}

/// Largest deviation of `count` vertices under random powers of the rotation of order `n` that do not
/// belong to a lower order, up to `limit`. Regions do not count.
fn deviation_of_vertices(shape: &Shape, frame: &Frame, n: u32, count: usize, limit: f64) -> f64 {
    let samples = shape.samples.vertices.iter().take(count);
    largest_of_order(n, samples, limit, |sample, turn| {
        let image = Motion::new(frame, turn.matrix()).apply(sample.point);
        let hit = shape.nearest(image, sample.triangle, &Target::Any, limit)?;
        Some(hit.distance)
    })
}

/// The same of corners of faces, some evenly chosen, from the corners nearest to their images.
fn deviation_of_corners(faces: &Faces, frame: &Frame, n: u32, count: usize, limit: f64) -> f64 {
    let corners = faces.corners();
    let some = corners.iter().step_by(corners.len().div_ceil(count).max(1));
    largest_of_order(n, some, limit, |&corner, turn| {
        let image = frame.to_world(turn.apply(frame.to_canonical(corner)));
        faces.corner_at(image, limit).map(|(_, distance)| distance)
    })
}

/// Largest of the distances that `off` finds for each of some things under a random power of the rotation of order
/// `n` that does not belong to a lower one; `limit` where it finds none.
fn largest_of_order<T>(
    n: u32,
    things: impl Iterator<Item = T>,
    limit: f64,
    off: impl Fn(T, Isometry) -> Option<f64>,
) -> f64 {
    let mut random = Random(u64::from(n));
    let mut worst = 0.0_f64;
    for thing in things {
        let mut k = 1 + random.below(n as usize - 1) as i64;
        while gcd(k as u32, n) != 1 {
            k = 1 + k % (i64::from(n) - 1);
        }
        match off(thing, Isometry::rotation(k, n)) {
            Some(d) => worst = worst.max(d),
            None => return limit,
        }
    }
    worst
}

/// Order of the rotations that two rotations make together.
pub fn least_common_multiple(a: u32, b: u32) -> u64 {
    u64::from(a / gcd(a, b)) * u64::from(b)
}

/// Greatest common divisor.
fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
