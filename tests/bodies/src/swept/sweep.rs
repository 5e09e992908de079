//! Rings around the axis and the strips of triangles between them.
//!
//! A body is a subdivision of the half-plane (r, z) swept around the axis: its points become rings
//! (or single points on the axis), its lines become strips with a material on either side. All
//! rings of a body have the same number of points, at angles that increase together, so caps and
//! walls of neighbouring materials match by construction.

use crate::{Body, Face, Material};
use glam::DVec3;
use tmesh::{Group, Kind};

/// How quadrilaterals and caps are split into triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tessellation {
    /// The same in every sector.
    #[default]
    Symmetric,
    /// Flat parts are split differently from place to place: the shape keeps its symmetry, the
    /// triangles do not.
    Asymmetric,
    /// As `Asymmetric`, by a random choice for each quadrilateral, bent ones too: there the drawn
    /// shape is only nearly as symmetric as the one that it stands for.
    Redrawn(u64),
}

/// A ring added to a [`Sweep`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ring(usize);

enum Points {
    Axis(f64),
    Loop(Vec<DVec3>),
}

struct Strip {
    from: Ring,
    to: Ring,
    left: Option<usize>,
    right: Option<usize>,
}

/// Builds a body from rings and strips.
pub struct Sweep {
    rings: Vec<Points>,
    strips: Vec<Strip>,
    materials: Vec<Material>,
}

impl Sweep {
    /// A body with the named materials.
    pub fn new<S: Into<String>>(materials: impl IntoIterator<Item = S>) -> Self {
        let materials = materials
            .into_iter()
            .map(|name| Material { name: name.into() })
            .collect();
        Self {
            rings: Vec::new(),
            strips: Vec::new(),
            materials,
        }
    }

    /// Adds the point of the axis at height `z`.
    pub fn axis(&mut self, z: f64) -> Ring {
        self.rings.push(Points::Axis(z));
        Ring(self.rings.len() - 1)
    }

    /// Adds a ring of points, counter-clockwise seen from above.
    pub fn ring(&mut self, points: Vec<DVec3>) -> Ring {
        self.rings.push(Points::Loop(points));
        Ring(self.rings.len() - 1)
    }

    /// Adds the strip between two rings. Left and right are those of someone who walks from `from`
    /// to `to` in the half-plane with r to the right and z up.
    pub fn strip(&mut self, from: Ring, to: Ring, left: Option<usize>, right: Option<usize>) {
        self.strips.push(Strip {
            from,
            to,
            left,
            right,
        });
    }

    /// The body, of plane quadrilaterals and with all mirror planes of a right prism: the group is D_nh.
    pub fn upright(self, order: u32, tessellation: Tessellation) -> Body {
        self.build(Group::new(Kind::Dh, order), true, tessellation)
    }

    /// The body. `flat` says that all strips are made of plane quadrilaterals.
    pub fn build(self, group: Group, flat: bool, tessellation: Tessellation) -> Body {
        let asymmetric = tessellation != Tessellation::Symmetric;
        let mut vertices = Vec::new();
        // First vertex of each ring; axis points are only added where a strip needs them.
        let starts: Vec<Option<u32>> = self
            .rings
            .iter()
            .map(|points| match points {
                Points::Axis(_) => None,
                Points::Loop(points) => {
                    let start = vertices.len() as u32;
                    vertices.extend_from_slice(points);
                    Some(start)
                }
            })
            .collect();
        let mut faces = Vec::new();
        for (index, strip) in self.strips.iter().enumerate() {
            let mut add = |vertices: [u32; 3]| {
                faces.push(Face {
                    vertices,
                    front: strip.right,
                    back: strip.left,
                });
            };
            let (from, to) = (&self.rings[strip.from.0], &self.rings[strip.to.0]);
            match (starts[strip.from.0], starts[strip.to.0], from, to) {
                (Some(a), Some(b), Points::Loop(low), Points::Loop(high)) => {
                    if low.len() != high.len() {
                        zip(low, high, |[v, w, x]| {
                            let id = |(ring, i): (u32, usize)| [a, b][ring as usize] + i as u32;
                            add([id(v), id(w), id(x)]);
                        });
                        continue;
                    }
                    let level = |p: &[DVec3]| p.iter().all(|q| q.z == p[0].z);
                    let horizontal = level(low) && level(high) && low[0].z == high[0].z;
                    let n = low.len() as u32;
                    for i in 0..n {
                        let j = (i + 1) % n;
                        let other = match tessellation {
                            Tessellation::Symmetric => false,
                            Tessellation::Asymmetric => {
                                (flat || horizontal) && scramble(0, index, i)
                            }
                            Tessellation::Redrawn(seed) => scramble(seed, index, i),
                        };
                        if other {
                            add([a + i, a + j, b + i]);
                            add([a + j, b + j, b + i]);
                        } else {
                            add([a + i, a + j, b + j]);
                            add([a + i, b + j, b + i]);
                        }
                    }
                }
                (None, Some(start), Points::Axis(z), Points::Loop(ring))
                | (Some(start), None, Points::Loop(ring), Points::Axis(z)) => {
                    // Seen from above counter-clockwise when the way leads inward.
                    let inward = starts[strip.to.0].is_none();
                    let mut turn =
                        |[a, b, c]: [u32; 3]| add(if inward { [a, b, c] } else { [a, c, b] });
                    let n = ring.len() as u32;
                    if asymmetric && is_convex(ring) {
                        for i in 1..n - 1 {
                            turn([start, start + i, start + i + 1]);
                        }
                        continue;
                    }
                    let shift = if asymmetric {
                        0.4 * kernel_radius(ring)
                    } else {
                        0.0
                    };
                    let apex = vertices.len() as u32;
                    vertices.push(DVec3::new(0.8 * shift, 0.6 * shift, *z));
                    for i in 0..n {
                        turn([start + i, start + (i + 1) % n, apex]);
                    }
                }
                _ => unreachable!("two points of the axis bound no strip"),
            }
        }
        Body {
            vertices,
            faces,
            materials: self.materials,
            order: group.order,
            group,
        }
    }
}

/// Triangles between two rings of different numbers of points, each starting within a step from the
/// x axis: a point is its ring (0 or 1) and its place there.
fn zip(low: &[DVec3], high: &[DVec3], mut add: impl FnMut([(u32, usize); 3])) {
    let turn = |ring: &[DVec3], i: usize| {
        let p = ring[i % ring.len()];
        let turn = libm::atan2(p.y, p.x) / std::f64::consts::TAU;
        turn - libm::floor(turn) + (i / ring.len()) as f64
    };
    let (n, m) = (low.len(), high.len());
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        let (p, q) = ((0, i % n), (1, j % m));
        if j == m || i < n && turn(low, i + 1) < turn(high, j + 1) {
            i += 1;
            add([p, (0, i % n), q]);
        } else {
            j += 1;
            add([p, (1, j % m), q]);
        }
    }
}

/// A fixed pseudo-random choice per strip and sector.
fn scramble(seed: u64, strip: usize, sector: u32) -> bool {
    let mut x =
        seed.wrapping_mul(0x94d0_49bb_1331_11eb) ^ ((strip as u64) << 32 | u64::from(sector));
    x = (x ^ (x >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (x >> 40) & 1 == 1
}

fn is_convex(ring: &[DVec3]) -> bool {
    let n = ring.len();
    (0..n).all(|i| {
        let (a, b, c) = (ring[i], ring[(i + 1) % n], ring[(i + 2) % n]);
        (b - a).truncate().perp_dot((c - b).truncate()) > 0.0
    })
}

/// Distance from the axis within which every point sees the whole ring.
fn kernel_radius(ring: &[DVec3]) -> f64 {
    let n = ring.len();
    (0..n)
        .map(|i| {
            let (a, b) = (ring[i].truncate(), ring[(i + 1) % n].truncate());
            a.perp_dot(b) / (b - a).length()
        })
        .fold(f64::INFINITY, f64::min)
}
