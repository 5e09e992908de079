//! A smooth chiral body as a CAD kernel draws it: with facets that do not share its symmetry.

use super::Tessellation;
use super::sweep::Sweep;
use crate::Body;
use crate::Random;
use glam::DVec3;
use std::f64::consts::TAU;
use tmesh::{Group, Kind};

/// A tapered screw with rounded threads, bored: rotations only. Each level has its own number of
/// facets, begun anywhere; corners lie on the smooth surface, so what is drawn is symmetric up to the
/// sagitta of the facets.
#[derive(Clone, Debug)]
pub struct Screw {
    /// Number of threads.
    pub order: u32,
    /// Radius at the crests, at the bottom.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Thickness of a second material that lines the bore; 0 for none.
    pub coating: f64,
    /// Height.
    pub height: f64,
    /// Twist from bottom to top, radians.
    pub twist: f64,
    /// Levels of facets over the height.
    pub layers: u32,
    /// Facets around each level, at least; up to a quarter more.
    pub facets: u32,
    /// Chooses numbers and beginnings of the facets.
    pub drawing: u64,
}

impl Screw {
    /// Radius of the crests at the top, relative to the bottom.
    const TOP: f64 = 0.9;
    /// Depth of the threads, relative to the radius.
    const DEPTH: f64 = 0.12;
    /// Radius that every level reaches around the whole turn, relative to the crests at the bottom.
    pub const LEAST: f64 = 0.75;

    /// The body.
    pub fn build(&self) -> Body {
        let mut random = Random::new(self.drawing);
        let mut ring = |z: f64, facets: u32, radius: &dyn Fn(f64) -> f64| -> Vec<DVec3> {
            let more = f64::from(facets / 4 + 1) * random.unit();
            let count = facets + more as u32;
            let phase = random.unit();
            let at = |i: u32| TAU * (f64::from(i) + phase) / f64::from(count);
            let point = |a: f64| {
                let r = radius(a);
                DVec3::new(r * libm::cos(a), r * libm::sin(a), z)
            };
            (0..count).map(|i| point(at(i))).collect()
        };
        let coated = self.coating > 0.0 && self.bore > 0.0;
        let names: &[&str] = if coated {
            &["body", "coating"]
        } else {
            &["body"]
        };
        let mut sweep = Sweep::new(names.iter().copied());
        let n = f64::from(self.order);
        let outer: Vec<_> = (0..=self.layers)
            .map(|k| {
                let share = f64::from(k) / f64::from(self.layers);
                let scale = self.radius * (1.0 - (1.0 - Self::TOP) * share);
                let wave = |a: f64| 0.5 - 0.5 * libm::cos(n * (a - self.twist * share));
                let radius = |a: f64| scale * (1.0 - Self::DEPTH * wave(a));
                sweep.ring(ring(self.height * share, self.facets, &radius))
            })
            .collect();
        let (bottom, top) = (outer[0], outer[outer.len() - 1]);
        for pair in outer.windows(2) {
            sweep.strip(pair[0], pair[1], Some(0), None);
        }
        let ends = [0.0, self.height];
        // As exact as the outside, at its radius: the sagitta goes with the square of the facet.
        let around = |radius: f64| {
            let facets = f64::from(self.facets) * (radius / self.radius).sqrt();
            (0.6 * facets) as u32 + 5
        };
        let mut circle = |sweep: &mut Sweep, radius: f64| {
            ends.map(|z| sweep.ring(ring(z, around(radius), &|_| radius)))
        };
        if self.bore == 0.0 {
            let [low, high] = ends.map(|z| sweep.axis(z));
            sweep.strip(low, bottom, Some(0), None);
            sweep.strip(top, high, Some(0), None);
        } else {
            let inner = circle(&mut sweep, self.bore + self.coating);
            sweep.strip(inner[0], bottom, Some(0), None);
            sweep.strip(top, inner[1], Some(0), None);
            sweep.strip(inner[0], inner[1], coated.then_some(1), Some(0));
            if coated {
                let lining = circle(&mut sweep, self.bore);
                sweep.strip(lining[0], inner[0], Some(1), None);
                sweep.strip(inner[1], lining[1], Some(1), None);
                sweep.strip(lining[0], lining[1], None, Some(1));
            }
        }
        sweep.build(
            Group::new(Kind::C, self.order),
            false,
            Tessellation::Redrawn(self.drawing),
        )
    }
}
