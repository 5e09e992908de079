//! Whether a group that holds within what facets hide is that of the body.

use crate::budget::{FIT, FULL};
use crate::group::found::Found;
use crate::rotation::{Query, Rotation};
use crate::shape::{Motion, Target};
use crate::verify::golden_turns;
use glam::DMat3;

impl Query<'_> {
    /// Whether facets hide anything.
    pub fn facets_hide_something(&self) -> bool {
        self.shape.smooth().largest() > self.shape.precision
    }

    /// Whether the group of the shape behind the facets of a drawing is more than that of the drawing, and meant.
    ///
    /// It is more if it has all operations of the drawing's. A drawing that has a rotation, of a body that any rotation
    /// about the same axis takes to itself within its facets, is drawn as it was meant, unless other ones of the `rotations`
    /// that were found do so, too: a ball has no axis of its own. And a drawing with a group of its own is given up for
    /// significant evidence only: next to all of what is off has to be explained, and by facets that would not explain
    /// most of what is off in any other position about the axis: those are too coarse to tell.
    pub fn is_behind(&self, found: &Found, rotations: &[Rotation], drawn: Option<&Found>) -> bool {
        let Some(drawn) = drawn else {
            return self.is_meant(found);
        };
        let [a, b] = [found, drawn].map(|f| f.frame.rotation.z_axis);
        let same_axis = self.same_axis(a, b);
        let has_all = !same_axis || drawn.group.is_subgroup_of(found.group);
        let is_ball = rotations.iter().filter(|r| r.axisymmetric).count() > 1;
        let is_round = found.axisymmetric && same_axis && !is_ball && drawn.group.order > 1;
        let is_more = found.group.size() > drawn.group.size() && has_all && !is_round;
        is_more && {
            let evidence = self.evidence(found, &[DMat3::IDENTITY]);
            evidence.is_most() && evidence.is_nearly_all() && self.is_singled_out(found)
        }
    }

    /// Whether the drawing differs from a group because it was drawn with other facets: then the shape behind them
    /// explains most of how far images are beyond the tolerance. Of a feature that is there once, in a drawing that is
    /// the same everywhere else, it explains next to nothing, however coarse the facets are.
    pub fn is_meant(&self, found: &Found) -> bool {
        self.evidence(found, &[DMat3::IDENTITY]).is_most()
    }

    /// Whether facets would leave most of what is off unexplained if the images under a group were turned on about the
    /// axis, by angles of all kinds. Of a body of revolution they are all the same.
    fn is_singled_out(&self, found: &Found) -> bool {
        let turns: Vec<DMat3> = golden_turns(TURNS).collect();
        found.axisymmetric || !self.evidence(found, &turns).is_most()
    }

    /// How much of what is beyond the tolerance under the generators of a group, turned on about the axis by each of some
    /// rotations, the shape behind the facets explains.
    fn evidence(&self, found: &Found, turns: &[DMat3]) -> Evidence {
        let (shape, limit) = (self.shape, self.limits.tolerance * found.radius);
        let generators: Vec<DMat3> = match found.axisymmetric {
            true => golden_turns(1).collect(),
            false => (found.group.generators().into_iter())
                .map(|g| g.matrix())
                .collect(),
        };
        let within = limit + 2.0 * shape.smooth().largest();
        let motions = (turns.iter())
            .flat_map(|&turn| generators.iter().map(move |&g| turn * g))
            .map(|matrix| Motion::new(&found.frame, matrix));
        let motions: Vec<Motion> = motions.collect();
        let mut evidence = Evidence::default();
        for sample in shape.samples.mixed.iter().take(FULL) {
            for motion in &motions {
                let image = motion.apply(sample.point);
                match shape.nearest(image, sample.triangle, &Target::Any, within) {
                    Some(hit) => {
                        if let Some(apart) = shape.apart(sample, motion, &hit) {
                            evidence.add(apart.facets.abs() - limit, apart.gap - limit);
                        }
                    }
                    None => evidence.add(within - limit, within - limit),
                }
            }
            if evidence.places >= ENOUGH {
                break;
            }
        }
        evidence
    }
}

/// Rotations that an operation is turned on by to see whether facets can tell it from others: as few as still spread
/// evenly over the steps of an order.
const TURNS: usize = 8;

/// Places beyond the tolerance after which no more are looked for: a share of one in twenty is known to a tenth of itself then, while
/// that of twenty places is one of chance, and another one with the triangles in another order.
const ENOUGH: u32 = FIT as u32;

/// Largest share of the places beyond the tolerance that may remain so where facets explain nearly all: the usual level
/// of significance.
const SIGNIFICANCE: f64 = 0.05;

/// What images are off beyond the tolerance, and what remains of it between the shapes that the facets may stand for.
#[derive(Default)]
struct Evidence {
    places: u32,
    places_left: u32,
    squares: f64,
    squares_left: f64,
}

impl Evidence {
    fn add(&mut self, beyond: f64, left: f64) {
        self.places += u32::from(beyond > 0.0);
        self.places_left += u32::from(left > 0.0);
        self.squares += beyond.max(0.0).powi(2);
        self.squares_left += left.max(0.0).powi(2);
    }

    /// Half of the sum of squares or more: a coefficient of determination.
    fn is_most(&self) -> bool {
        2.0 * self.squares_left <= self.squares
    }

    /// All places but for what is not significant.
    fn is_nearly_all(&self) -> bool {
        f64::from(self.places_left) <= SIGNIFICANCE * f64::from(self.places)
    }
}
