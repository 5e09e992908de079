//! The highest rotation order about one axis.

use crate::faces::Faces;
use crate::permutation::Permutation;
use crate::refine::{Canonical, refine};
use crate::samples::{Random, Sample};
use crate::shape::{Motion, Shape, Target};
use crate::verify::{Bound, Depth, Deviation, Operation, Place, golden_rotations};
use glam::DVec3;
use kit::in_parallel;
use rustc_hash::FxHashMap;
use std::ops::RangeInclusive;
use tmesh::{Frame, Isometry};

/// Tolerances of a search, relative to the radius about the axis.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// What verified operations keep to.
    pub tolerance: f64,
    /// What candidates keep to before axis and centre are adjusted.
    pub loose: f64,
    /// Whether up to [`FACETS`] is allowed on top where facets that stand for a smooth surface
    /// explain it.
    pub facets: bool,
    /// Only multiples of this order are looked for.
    pub multiples_of: u32,
}

impl Limits {
    /// For a tolerance.
    pub fn new(tolerance: f64) -> Self {
        Self {
            tolerance,
            loose: (8.0 * tolerance).clamp(8e-3, 0.2),
            facets: false,
            multiples_of: 1,
        }
    }

    /// Whether an order is looked for.
    fn admit(&self, order: u32) -> bool {
        order.is_multiple_of(self.multiples_of)
    }

    /// The bound on deviations of verified operations for a radius.
    pub fn bound(&self, radius: f64) -> Bound {
        let limit = self.tolerance * radius;
        Bound {
            limit,
            facets: if self.facets { FACETS * limit } else { 0.0 },
        }
    }
}

/// A rotation symmetry found.
#[derive(Clone, Debug)]
pub struct Rotation {
    /// Axis z, centre at the origin.
    pub frame: Frame,
    /// Largest distance of the surface from the axis.
    pub radius: f64,
    /// Order.
    pub order: u32,
    /// Regions under one step.
    pub permutation: Permutation,
    /// Largest deviation, in the units of the shape.
    pub deviation: Deviation,
    /// Whether all orders hold.
    pub axisymmetric: bool,
    /// Whether the order stands out; false for a body of revolution without a facet count.
    pub distinct: bool,
}

impl Rotation {
    /// High orders come before low ones; a body of revolution whose order does not stand out comes
    /// between two and three: besides it there can only be half turns, unless the body is a ball.
    pub fn rank(&self) -> u32 {
        if self.distinct { 2 * self.order } else { 5 }
    }

    /// Whether no axis across this one can have an order above two, unless the body is isotropic.
    pub fn is_high(&self) -> bool {
        self.order > 2 && (self.distinct || self.axisymmetric)
    }

    /// Whether this is the better find. `noise` is the deviation that is not worth a distinction.
    fn beats(&self, other: &Self, noise: f64) -> bool {
        if self.rank() != other.rank() {
            return self.rank() > other.rank();
        }
        self.deviation.value.max(noise) < other.deviation.value.max(noise)
    }
}

/// Samples in a scan over orders.
const SCAN: usize = 96;
/// Turns that tell which of them are taken off the surface.
const TELLING_TURNS: usize = 4;
/// What facets may add to the tolerance at most, in tolerances: the diagonal of the square around
/// the circle of the radius, by which the exactness of drawings is commonly stated, is `2 sqrt 2`
/// radii.
pub const FACETS: f64 = 1.828;
/// Bulge of some facet, in tolerances, from which facets may matter at all.
pub const COARSE: f64 = 0.1;
/// Share of the largest deviation that a place must have for it to count as deviating too: at nine
/// in ten phases the corner of a facet is that share of the sagitta off another facet.
const NOTICEABLE: f64 = 0.33;
/// Share of samples that may be off while axis and centre are still rough.
const OUTLIERS: f64 = 0.12;
/// Factor by which the deviations of all other orders exceed those of the facet count's divisors.
const SEPARATION: f64 = 3.0;
/// Places remembered where orders failed.
const OBSTACLES: usize = 32;
/// Orders whose deviations may turn out not to be those of facets before no more high ones are allowed any:
/// near a body of revolution, a flaw that facets could explain where it is spoils hundreds alike.
const UNEXPLAINED: usize = 8;
/// Orders up to this one are allowed them even so.
const LOW: u32 = 12;
/// Orders with many divisors, for bodies of revolution without a facet count.
const COMPOSITE: [u32; 14] = [2, 4, 6, 12, 24, 36, 48, 60, 120, 180, 240, 360, 720, 840];

/// Finds the highest order in `orders` about an axis near `direction` through a point near `centre`.
///
/// The axis and centre are adjusted to the shape unless `fixed`. Near a body of revolution, where
/// many orders hold within the tolerance, the facet count is told by its deviation.
pub fn find_rotation(
    shape: &Shape,
    centre: DVec3,
    direction: DVec3,
    fixed: bool,
    orders: RangeInclusive<u32>,
    limits: Limits,
    depth: Depth,
) -> Option<Rotation> {
    let search = Search {
        shape,
        orders,
        limits,
        depth,
    };
    let start = Frame::from_axis(centre, direction, direction.any_orthogonal_vector())?;
    let radius = shape.radius(&start);
    if radius <= 0.0 {
        return None;
    }
    let mut best: Option<Rotation> = None;
    let keep = |best: &mut Option<Rotation>, found: Option<Rotation>| {
        if let Some(found) = found
            && best
                .as_ref()
                .is_none_or(|b| found.beats(b, 0.5 * shape.precision))
        {
            *best = Some(found);
        }
    };
    keep(&mut best, search.in_frame(&start));
    if fixed
        || best
            .as_ref()
            .is_some_and(|b| b.distinct && b.deviation.value <= shape.rounding())
    {
        return best;
    }
    let loose = limits.loose * radius;
    let revolution = shape.deviation_from_revolution(&start, loose);
    let candidates = if revolution.is_some() && search.orders.end() > search.orders.start() {
        search.orders.clone().filter(|&n| limits.admit(n)).collect()
    } else {
        search.scan(&start, loose, OUTLIERS)
    };
    let largest = *candidates.last()?;
    let target = shape.target_in_place();
    let near_revolution = candidates.len() > 20;
    let operations = if near_revolution {
        golden(&start, 12)
    } else {
        powers(largest, &target)
    };
    let adjusted = refine(shape, start, &operations, 4_000, loose);
    keep(&mut best, search.in_frame(&adjusted));
    if best.is_none() && !near_revolution {
        for &n in candidates.iter().rev().skip(1).take(5) {
            let adjusted = refine(shape, start, &powers(n, &target), 4_000, loose);
            keep(&mut best, search.in_frame(&adjusted));
            if best.is_some() {
                break;
            }
        }
    }
    let found = best.clone()?;
    let target = shape.target(&found.permutation);
    let target = if found.permutation.is_identity() {
        target
    } else {
        Target::Any
    };
    let operations = if found.distinct {
        powers(found.order, &target)
    } else {
        golden(&found.frame, 12)
    };
    let reach = (4.0 * found.deviation.value).clamp(1e-4 * radius, 4.0 * limits.tolerance * radius);
    let polished = refine(shape, found.frame, &operations, 12_000, reach);
    keep(&mut best, search.in_frame(&polished));
    best
}

/// Whether a few samples leave it open that one of the orders holds in the frame as it is. Regions do not
/// count here.
pub fn may_hold(
    shape: &Shape,
    frame: &Frame,
    orders: impl IntoIterator<Item = u32>,
    limits: Limits,
) -> bool {
    let search = Search {
        shape,
        orders: 2..=2,
        limits,
        depth: Depth::Quick,
    };
    let bound = limits.bound(shape.radius(frame)).most();
    let places = search.telling_first(frame, bound);
    orders
        .into_iter()
        .any(|n| search.passes(frame, n, &places, bound, 0.0))
}

/// A handful of powers of the rotation by a turn over `n`, for an adjustment.
pub fn powers(n: u32, target: &Target) -> Vec<Canonical> {
    let mut ks = vec![1, n / 2, n / 3, 2 * n / 5, n / 5, 3 * n / 7];
    ks.retain(|&k| k > 0 && k < n);
    ks.sort_unstable();
    ks.dedup();
    ks.into_iter()
        .map(|k| Canonical {
            matrix: Isometry::rotation(i64::from(k), n).matrix(),
            target: target.clone(),
        })
        .collect()
}

fn golden(frame: &Frame, count: usize) -> Vec<Canonical> {
    let q = frame.rotation;
    golden_rotations(frame, count, Target::Any)
        .into_iter()
        .map(|o| Canonical {
            matrix: q.transpose() * o.motion.linear * q,
            target: Target::Any,
        })
        .collect()
}

struct Search<'a> {
    shape: &'a Shape,
    orders: RangeInclusive<u32>,
    limits: Limits,
    depth: Depth,
}

impl Search<'_> {
    /// Orders that a few samples do not rule out, increasing. Regions do not count here.
    fn scan(&self, frame: &Frame, limit: f64, outliers: f64) -> Vec<u32> {
        let orders: Vec<u32> = self.orders.clone().collect();
        let places = self.telling_first(frame, limit);
        let passes =
            |&n: &u32| self.limits.admit(n) && self.passes(frame, n, &places, limit, outliers);
        let passed = in_parallel(&orders, self.shape.threads, passes);
        let passed = orders.into_iter().zip(passed).filter(|(_, passed)| *passed);
        passed.map(|(n, _)| n).collect()
    }

    /// Numbers of the samples of a scan, those first that most turns take off the surface.
    fn telling_first(&self, frame: &Frame, limit: f64) -> Vec<usize> {
        let samples = &self.shape.samples.mixed;
        let turns = golden_rotations(frame, TELLING_TURNS, Target::Any);
        let misses = |i: &usize| {
            let off = |turn: &&Operation| {
                let image = turn.motion.apply(samples[*i].point);
                (self.shape.nearest(image, 0, &Target::Any, limit)).is_none()
            };
            turns.iter().filter(off).count()
        };
        let mut places: Vec<usize> = (0..SCAN.min(samples.len())).collect();
        places.sort_by_cached_key(|i| std::cmp::Reverse(misses(i)));
        places
    }

    fn passes(&self, frame: &Frame, n: u32, places: &[usize], limit: f64, outliers: f64) -> bool {
        let samples = &self.shape.samples.mixed;
        let mut left = (outliers * places.len() as f64) as usize;
        let random = Random(u64::from(n));
        for &i in places {
            // Whatever comes first, each sample has a power of its own.
            let k = if i % 2 == 0 {
                1
            } else {
                1 + random.after(i / 2).below(n as usize - 1) as i64
            };
            let turn = Isometry::rotation(k, n);
            if distance(self.shape, frame, turn, &samples[i], limit).is_none() {
                if left == 0 {
                    return false;
                }
                left -= 1;
            }
        }
        true
    }

    /// The highest order that holds with the frame as it is.
    fn in_frame(&self, frame: &Frame) -> Option<Rotation> {
        let radius = self.shape.radius(frame);
        let bound = self.limits.bound(radius);
        let limit = bound.limit;
        let found = |order: u32, permutation, deviation, axisymmetric, distinct| {
            Some(Rotation {
                frame: *frame,
                radius,
                order,
                permutation,
                deviation,
                axisymmetric,
                distinct,
            })
        };
        // An order that does not hold: where, and whether it is facets that do not explain it.
        let verify = |n, bound| {
            let found = (self.shape.verify_rotation(frame, n, bound, self.depth))
                .map_err(|deviation| (deviation, false))?;
            if found.0.value > limit && !is_of_facets(self.shape, frame, n, found.0.value, limit) {
                return Err((found.0, true));
            }
            Ok(found)
        };
        let full_range = self.orders.end() > self.orders.start();
        let revolution = self.shape.deviation_from_revolution(frame, 3.0 * limit);
        let axisymmetric = revolution.is_some_and(|d| d.value <= limit);
        if full_range && revolution.is_some() {
            if let Some(n) = self.facet_count(frame, limit)
                && let Ok((deviation, permutation)) = verify(n, bound)
            {
                // The sagitta of the facets: a polygon of that many sides deviates just so much.
                let sagitta = radius * (1.0 - libm::cos(std::f64::consts::PI / f64::from(n)));
                let facetted = revolution.is_some_and(|d| d.value <= 1.05 * sagitta);
                return found(n, permutation, deviation, axisymmetric || facetted, true);
            }
            if let (true, Some(deviation)) = (axisymmetric, revolution) {
                let n = (COMPOSITE.iter().rev())
                    .find(|&n| self.orders.contains(n) && self.limits.admit(*n))
                    .copied()
                    .unwrap_or(self.limits.multiples_of.max(*self.orders.start()));
                let p = Permutation::identity(self.shape.regions.len());
                return found(n, p, deviation, true, false);
            }
        }
        // Near a body of revolution many orders fail at the same few places.
        let mut obstacles: Vec<DVec3> = Vec::new();
        let mut unexplained = 0;
        for n in self.scan(frame, bound.most(), 0.0).into_iter().rev() {
            let bound = match unexplained >= UNEXPLAINED && n > LOW {
                true => Bound::plain(limit),
                false => bound,
            };
            if obstacles
                .iter()
                .any(|p| self.stumbles(frame, n, *p, bound.most()))
            {
                continue;
            }
            match verify(n, bound) {
                Ok((deviation, permutation)) => {
                    return found(n, permutation, deviation, axisymmetric, true);
                }
                Err((_, true)) => unexplained += 1,
                Err((deviation, false)) if obstacles.len() < OBSTACLES => {
                    // Either end may be the place that has no counterpart.
                    let near = self
                        .shape
                        .nearest(deviation.image, 0, &Target::Any, f64::INFINITY);
                    obstacles.push(deviation.at);
                    obstacles.extend(near.map(|n| n.point));
                }
                Err(_) => {}
            }
        }
        None
    }

    /// Whether one of a few powers of the rotation of order `n` maps a point off the surface.
    fn stumbles(&self, frame: &Frame, n: u32, point: DVec3, limit: f64) -> bool {
        let sample = Sample { point, triangle: 0 };
        let mut random = Random(u64::from(n));
        (0..4).any(|i| {
            let k = match i {
                0 => 1,
                _ => 1 + random.below(n as usize - 1) as i64,
            };
            distance(self.shape, frame, Isometry::rotation(k, n), &sample, limit).is_none()
        })
    }

    /// The order whose divisors, and only they, hold distinctly better than all other orders; the
    /// highest of such orders. `None` when no order stands out within `limit`.
    fn facet_count(&self, frame: &Frame, limit: f64) -> Option<u32> {
        let most = *self.orders.end();
        // Rounding of coordinates is no distinction.
        let floor = 2.0 * self.shape.precision.max(1e-13);
        // A few vertices tell; only when they do not, more of them. Exact symmetry is told from all else
        // close by, and where there are flat faces, corners that do not land on corners tell it.
        let exact = (12, SEPARATION * floor, self.shape.faces());
        [exact, (12, 3.0 * limit, None), (48, 3.0 * limit, None)]
            .into_iter()
            .find_map(|(count, reach, faces)| {
                let measure = |n: u32, count| {
                    let off = match faces {
                        Some(faces) => deviation_of_corners(faces, frame, n, count, reach),
                        None => deviation_of_order(self.shape, frame, n, count, reach),
                    };
                    off.max(floor)
                };
                let worst: Vec<f64> = (0..=most)
                    .map(|n| if n < 2 { 0.0 } else { measure(n, count) })
                    .collect();
                let wanted = (3..=most).rev().filter(|&n| self.limits.admit(n));
                wanted.into_iter().find(|&n| {
                    let largest = |of: &dyn Fn(u32) -> f64| {
                        let divisors = (2..=n).filter(|d| n % d == 0);
                        divisors.map(of).fold(0.0, f64::max)
                    };
                    let apart = |inside: f64| {
                        inside <= limit.min(reach / SEPARATION)
                            && (2..=most)
                                .filter(|m| n % m != 0)
                                .all(|m| worst[m as usize] >= SEPARATION * inside)
                    };
                    apart(largest(&|d| worst[d as usize])) && apart(largest(&|d| measure(d, 96)))
                })
            })
    }
}

/// Whether the deviations of up to `value` under the rotation of order `n` look like differences
/// between facets, beyond each being explained by the facets there ([`crate::facets`]).
pub fn is_of_facets(shape: &Shape, frame: &Frame, n: u32, value: f64, limit: f64) -> bool {
    is_widespread(shape, frame, n, value)
        && powers(n, &shape.target_in_place())
            .into_iter()
            .all(|power| {
                let operation = Operation {
                    motion: Motion::new(frame, power.matrix),
                    target: power.target,
                };
                !shape.displaces(frame, &operation, limit)
            })
}

/// Whether deviations are found at most places that are drawn as coarsely as the worst ones, as
/// between facets, rather than at a feature. With more than two turns, at most images of the places
/// where they are found at all.
fn is_widespread(shape: &Shape, frame: &Frame, n: u32, value: f64) -> bool {
    let parts = 6_u32.div_ceil(n);
    // Half turns cannot tell images apart: a place and its only one deviate together.
    let folds = if n == 2 { 1 } else { parts };
    let sectors = n * parts;
    // For each shell and part of a turn: sectors that are drawn coarsely, those that deviate.
    let mut seen: FxHashMap<[u32; 2], [Vec<bool>; 2]> = FxHashMap::default();
    let mut random = Random(u64::from(n));
    let radius = shape.radius(frame);
    let noticeable = NOTICEABLE * value;
    for sample in shape.samples.mixed.iter().take(16_000) {
        let corners = shape.triangles[sample.triangle as usize];
        if shape.facets().around(corners) < noticeable {
            continue;
        }
        let normal = shape.normals[sample.triangle as usize];
        let place = Place::new(frame, sample.point, normal, radius);
        let sector = ((place.turn * f64::from(sectors)) as u32).min(sectors - 1);
        let key = [sector % folds, place.shell(4.0).into()];
        let [coarse, off] = seen
            .entry(key)
            .or_insert_with(|| [(); 2].map(|()| vec![false; (sectors / folds) as usize]));
        let sector = (sector / folds) as usize;
        coarse[sector] = true;
        if off[sector] {
            continue;
        }
        // Places without a feature deviate where one power of the rotation takes them to it: that
        // two different ones do needs features at two places.
        let deviates = |k: u32| {
            let step = Isometry::rotation(i64::from(k), n);
            distance(shape, frame, step, sample, value).is_none_or(|d| d > noticeable)
        };
        let (first, step) = (random.below(n as usize - 1) as u32, (n - 1).div_ceil(3));
        let tried = (0..n - 1)
            .step_by(step as usize)
            .map(|k| 1 + (first + k) % (n - 1));
        off[sector] = tried.filter(|&k| deviates(k)).count() >= 2.min(n as usize - 1);
    }
    let count = |list: &[bool]| list.iter().filter(|x| **x).count();
    (seen.values()).all(|[coarse, off]| count(off) == 0 || 2 * count(off) > count(coarse))
}

/// Distance of the image of a sample under an isometry of the frame from any triangle, if within
/// `limit`.
fn distance(
    shape: &Shape,
    frame: &Frame,
    isometry: Isometry,
    sample: &Sample,
    limit: f64,
) -> Option<f64> {
    let p = frame.to_world(isometry.apply(frame.to_canonical(sample.point)));
    shape
        .nearest(p, sample.triangle, &Target::Any, limit)
        .map(|n| n.distance)
}

/// Largest deviation of `count` vertices under random powers of the rotation of order `n` that do not
/// belong to a lower order, up to `limit`. Regions do not count.
pub fn deviation_of_order(shape: &Shape, frame: &Frame, n: u32, count: usize, limit: f64) -> f64 {
    let samples = shape.samples.vertices.iter().take(count);
    largest_of_order(n, samples, limit, |sample, turn| {
        distance(shape, frame, turn, sample, limit)
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

/// Largest deviation over `count` samples and random powers of the rotation of order `n`; stops at the
/// first one beyond `most`.
pub fn deviation_measured(
    shape: &Shape,
    frame: &Frame,
    n: u32,
    count: usize,
    most: f64,
) -> Deviation {
    let mut random = Random(u64::from(n));
    let target = shape.target_in_place();
    let operations: Vec<Operation> = (0..count.min(64))
        .map(|i| {
            let k = if i % 4 == 0 {
                1
            } else {
                1 + random.below(n as usize - 1) as i64
            };
            Operation {
                motion: Motion::new(frame, Isometry::rotation(k, n).matrix()),
                target: target.clone(),
            }
        })
        .collect();
    let samples = &shape.samples.mixed;
    let count = count.min(samples.len());
    let measured = shape.worst(count, Bound::plain(most), |i| {
        (&samples[i], &operations[(i * 7) % operations.len()])
    });
    measured.unwrap_or_else(|beyond| beyond)
}

/// Greatest common divisor.
pub fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
