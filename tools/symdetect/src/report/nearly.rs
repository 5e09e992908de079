//! A rotation that nearly holds: what breaks it, and where.

use crate::budget::{FIT, NEXT_BEST, QUICK, REPORTED};
use crate::group::Found;
use crate::nearly::Nearly;
use crate::rotation::{Fit, LOOSE_RANGE, OUTLIERS, Query, TELLING_TURNS, golden, powers, settle};
use crate::shape::{Random, Sample, Target};
use crate::verify::{Bound, Operation, golden_rotations};
use glam::DVec3;
use tmesh::{Axis, Frame, Isometry};

/// Powers of a rotation that a place is tried under: each other place of an orbit of this many more is tried.
const POWERS: u32 = 2 * TELLING_TURNS as u32;

/// Samples that most of some turns take off the surface.
struct Lost {
    count: usize,
    /// How many were looked at, the first ones.
    of: usize,
}

impl Query<'_> {
    /// The rotation that holds but for the fewest places, about the axis found or, where its order is two at most,
    /// about one of the principal directions; if what is in the way is the lesser part of what tells one turn from
    /// another, and no more than the share of outliers in any search.
    ///
    /// A body of a higher order that is drawn exactly is taken for what it was meant to be.
    ///
    /// A place is in the way if most powers of the rotation take it off the surface: of a wheel without one of its
    /// teeth, only the gap is.
    pub fn nearly(&self, directions: &[DVec3], found: Option<&Found>) -> Option<Nearly> {
        let known = found.filter(|f| f.group.order > 2);
        let is_exact = known.is_some_and(|f| f.verified.deviation.value <= self.noise(f.radius));
        let is_round = found.is_some_and(|f| f.axisymmetric);
        if is_exact || is_round || self.params.order.is_some() {
            return None;
        }
        let frames: Vec<Frame> = match known {
            Some(found) => vec![found.frame],
            // The three principal ones come first.
            None => (directions.iter().take(3))
                .filter_map(|d| Frame::from_axis(self.centre, *d, d.any_orthogonal_vector()))
                .collect(),
        };
        // What is found is where it is, whatever is missing.
        let rough = if known.is_some() { &[] } else { &frames[..] };
        let centred = rough.iter().filter_map(|f| self.centred(f));
        let about = (frames.iter().copied().chain(centred)).map(|frame| {
            let multiples = self.order_about(frame.rotation.z_axis, found);
            self.nearly_about(&frame, multiples)
        });
        // An axis that is known may have been started from too far away to be told before.
        let is_news = |n: &Nearly| {
            let axis = DVec3::from_array(n.axis.direction);
            n.order.is_none_or(|o| o > self.order_about(axis, found))
        };
        Nearly::best(about.flatten().filter(is_news).collect())
    }

    /// The order of what was found about a direction, which need only be near the axis.
    fn order_about(&self, direction: DVec3, found: Option<&Found>) -> u32 {
        let Some(found) = found else {
            return 1;
        };
        let d = found.frame.rotation.transpose() * direction;
        let (group, near) = (found.group, self.same_candidate());
        let is_half_turn = |g: Isometry| g.flipped() && !g.reverses_orientation();
        let holds = |g: Isometry| (g.apply(d) - d).length() <= 2.0 * near;
        if d.cross(DVec3::Z).length() <= near {
            group.order
        } else if (group.elements()).any(|g| is_half_turn(g) && holds(g)) {
            2
        } else {
            1
        }
    }

    /// A frame moved to where any turn takes most of the surface to itself, its rims and bores, if that is farther off than
    /// candidates are: what is missing shifts the centre of mass.
    fn centred(&self, start: &Frame) -> Option<Frame> {
        let radius = self.shape.radius(start);
        let fit = Fit {
            operations: &golden(),
            samples: QUICK,
            reach: LOOSE_RANGE[1] * radius,
            bound: Bound::plain(self.limits.tolerance * radius),
        };
        let frame = settle(self.shape, *start, &fit);
        let shift = frame.to_canonical(start.origin).truncate().length();
        (shift > self.limits.loose * radius).then_some(frame)
    }

    /// What nearly holds about an axis.
    fn nearly_about(&self, start: &Frame, multiples: u32) -> Option<Nearly> {
        let bound = self.limits.loosely(self.shape.radius(start));
        // What is in the way shifts second moments by about its share.
        let moments = &self.shape.moments;
        let highest = match moments.allow_high_order(start.rotation.z_axis, OUTLIERS) {
            true => {
                let told = (self.shape).highest_told(start, self.shape.radius(start), bound);
                self.params.max_order.min(told)
            }
            false => 2,
        };
        let search = self.search(multiples.max(2)..=highest);
        let mut orders = search.scan(start, bound, 0.5, multiples);
        orders.retain(|n| *n > multiples);
        orders.truncate(NEXT_BEST);
        // Of a body that has an order, it is no news that its other parts are round.
        let any = (multiples == 1).then_some(None);
        let orders = orders.into_iter().map(Some).chain(any);
        let telling = self.telling(start, bound, REPORTED);
        let rough = orders.filter_map(|order| self.in_the_way(start, order, bound, &telling));
        let order = Nearly::best(rough.collect())?.order;
        let operations = match order {
            Some(order) => powers(order, &Target::Any),
            None => golden(),
        };
        let frame = self.adjusted(*start, self.shape.radius(start), &operations, FIT / 2);
        let bound = self.limits.bound(self.shape.radius(&frame));
        // What many samples are in the way of, some tell already.
        let nearly = |count| {
            let telling = self.telling(&frame, bound, count);
            self.in_the_way(&frame, order, bound, &telling)
        };
        nearly(QUICK)?;
        nearly(FIT).filter(|n| n.share > 0.0)
    }

    /// Those of the first samples that tell one turn about a frame's axis from another.
    fn telling(&self, frame: &Frame, bound: Bound, count: usize) -> Lost {
        let turns = golden_rotations(frame, TELLING_TURNS, Target::Any);
        let samples = &self.shape.samples.mixed;
        let samples = &samples[..count.min(samples.len())];
        let is_lost = |sample: &&Sample| self.is_lost(sample, &turns, bound);
        Lost {
            count: samples.iter().filter(is_lost).count(),
            of: samples.len(),
        }
    }

    /// Whether most of some turns take a sample off the surface.
    fn is_lost(&self, sample: &Sample, turns: &[Operation], bound: Bound) -> bool {
        let most = turns.len() / 2;
        let (mut lost, mut kept) = (0, 0);
        for turn in turns {
            match self.shape.lands(turn, sample, bound) {
                true => kept += 1,
                false => lost += 1,
            }
            // Looking at the others would not change it.
            if lost > most || kept >= turns.len() - most {
                break;
            }
        }
        lost > most
    }

    /// What is in the way of an order, or of any rotation.
    fn in_the_way(
        &self,
        frame: &Frame,
        order: Option<u32>,
        bound: Bound,
        telling: &Lost,
    ) -> Option<Nearly> {
        let shape = self.shape;
        let few = (OUTLIERS * telling.of as f64) as usize;
        let most = match order {
            Some(_) => few.min(telling.count / 2),
            None => few,
        };
        let turns = match order {
            Some(order) => some_turns(frame, order),
            None => golden_rotations(frame, POWERS as usize, Target::Any),
        };
        let lost = self.shape.samples.mixed[..telling.of].iter();
        let lost = lost.filter(|sample| self.is_lost(sample, &turns, bound));
        let lost: Vec<&Sample> = lost.take(most + 1).collect();
        if lost.len() > most {
            return None;
        }
        let share = lost.len() as f64 / telling.of as f64;
        let distance = |sample: &Sample, turn: &Operation| {
            let image = turn.motion.apply(sample.point);
            let hit = shape.nearest(image, sample.triangle, &Target::Any, f64::INFINITY);
            hit.map_or(0.0, |hit| hit.distance)
        };
        let farthest = (lost.iter())
            .flat_map(|s| turns.iter().map(|turn| distance(s, turn)))
            .fold(0.0, f64::max);
        Some(Nearly {
            order,
            axis: Axis {
                point: shape.to_world(frame.origin).to_array(),
                direction: frame.rotation.z_axis.to_array(),
            },
            share,
            place: shape.to_world(middle(&lost)).to_array(),
            residual: farthest / shape.radius(frame),
        })
    }
}

/// All powers of a rotation or, of many, some drawn at random: those spread evenly would be about those of another order.
fn some_turns(frame: &Frame, order: u32) -> Vec<Operation> {
    let mut random = Random(u64::from(order));
    let power = |i: u32| {
        let k = match order - 1 > POWERS {
            true => 1 + random.below(order as usize - 1) as i64,
            false => 1 + i64::from(i),
        };
        Operation::new(frame, Isometry::rotation(k, order), Target::Any)
    };
    (0..(order - 1).min(POWERS)).map(power).collect()
}

/// That of some places which is nearest to the others, in the sum of the distances.
fn middle(places: &[&Sample]) -> DVec3 {
    let some = &places[..places.len().min(QUICK)];
    let sum = |p: DVec3| some.iter().map(|s| s.point.distance(p)).sum::<f64>();
    let points = some.iter().map(|s| s.point);
    let best = points.min_by(|a, b| sum(*a).total_cmp(&sum(*b)));
    best.unwrap_or(DVec3::ZERO)
}
