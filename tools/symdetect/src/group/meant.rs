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
    /// significant evidence only: next to all of what is off has to be explained. The less facets leave of what is off in
    /// other positions about the axis, the less it tells that they leave next to nothing here: those that are too coarse explain
    /// anything.
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
            let elsewhere = self.remains_turned(found);
            evidence.remains() < SIGNIFICANCE * elsewhere * elsewhere
        }
    }

    /// Whether the drawing differs from a group because it was drawn with other facets: then the shape behind them
    /// explains most of how far images are beyond the tolerance. Of a feature that is there once, in a drawing that is
    /// the same everywhere else, it explains next to nothing, however coarse the facets are.
    pub fn is_meant(&self, found: &Found) -> bool {
        self.evidence(found, &[DMat3::IDENTITY]).is_most()
    }

    /// The share of what is off that facets would leave unexplained if the images under a group were turned on about the
    /// axis, by angles of all kinds. Of a body of revolution they are all the same, and it is all.
    fn remains_turned(&self, found: &Found) -> f64 {
        let turns: Vec<DMat3> = golden_turns(TURNS).collect();
        match found.axisymmetric {
            true => 1.0,
            false => self.evidence(found, &turns).remains(),
        }
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

/// How much may remain where facets explain nearly all, of what remains in other positions, and times that: the usual level
/// of significance.
const SIGNIFICANCE: f64 = 0.05;

/// What images are off beyond the tolerance, and what remains of it between the shapes that the facets may stand for.
#[derive(Default)]
struct Evidence {
    places: u32,
    squares: f64,
    squares_left: f64,
}

impl Evidence {
    fn add(&mut self, beyond: f64, left: f64) {
        self.places += u32::from(beyond > 0.0);
        self.squares += beyond.max(0.0).powi(2);
        self.squares_left += left.max(0.0).powi(2);
    }

    /// The share of the sum of squares that remains: one less the coefficient of determination. Places that are off by next
    /// to nothing do not count as others do.
    fn remains(&self) -> f64 {
        match self.squares > 0.0 {
            true => self.squares_left / self.squares,
            false => 0.0,
        }
    }

    /// Half of it is explained, or more.
    fn is_most(&self) -> bool {
        self.remains() <= 0.5
    }
}
