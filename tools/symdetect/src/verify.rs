//! Verification of operations: how far the image of the surface is from the surface.

use crate::permutation::Permutation;
use crate::samples::{Random, Sample};
use crate::shape::{Motion, NO_CLASS, Shape, Target};
use crate::swing::Swing;
use glam::{DMat3, DVec3};
use kit::in_parallel;
use rustc_hash::FxHashMap;
use std::ops::Range;
use tmesh::{Frame, Isometry};

/// A deviation and where it was found.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// Distance of an image from the surface, in the units of the shape.
    pub value: f64,
    /// The sample whose image is that far off.
    pub at: DVec3,
    /// Its image.
    pub image: DVec3,
    /// Whether it is the largest of the whole surface ([`crate::faces`]), not of samples.
    pub everywhere: bool,
}

impl Deviation {
    /// No deviation.
    pub const NONE: Self = Self {
        value: 0.0,
        at: DVec3::ZERO,
        image: DVec3::ZERO,
        everywhere: true,
    };

    /// The larger of two.
    pub fn max(self, other: Self) -> Self {
        let larger = if other.value > self.value {
            other
        } else {
            self
        };
        Self {
            everywhere: self.everywhere && other.everywhere,
            ..larger
        }
    }
}

/// Before the first test.
const NO_TEST: Deviation = Deviation {
    everywhere: false,
    ..Deviation::NONE
};

/// How thorough a verification is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// A few thousand tests: enough to rank candidates.
    Quick,
    /// Every vertex and face sample for one step of the rotation and for one mirror, and a share of
    /// them for all other operations.
    Full,
}

/// What deviations are allowed, in the units of the shape.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    /// Anywhere.
    pub limit: f64,
    /// So much more at most where facets that stand for a smooth surface explain it
    /// ([`crate::facets`]).
    pub facets: f64,
}

impl Bound {
    /// The same everywhere.
    pub fn plain(limit: f64) -> Self {
        Self { limit, facets: 0.0 }
    }

    /// The largest deviation that may pass.
    pub fn most(&self) -> f64 {
        self.limit + self.facets
    }
}

/// An operation and what images may land on.
pub struct Operation {
    /// The motion.
    pub motion: Motion,
    /// Where triangles may land.
    pub target: Target,
}

/// Where on a body a point is, roughly: points alike in this are of one neighbourhood.
pub struct Place {
    /// Angle about the axis, as a share of a full turn from 0 to 1.
    pub turn: f64,
    /// Distance from the axis, relative to the largest.
    pub radius: f64,
    /// Which way the surface faces: outwards, along the turn, along the axis, and their opposites.
    pub side: u8,
}

impl Place {
    /// Of a point of the surface with the given normal.
    pub fn new(frame: &Frame, point: DVec3, normal: DVec3, radius: f64) -> Self {
        let p = frame.to_canonical(point);
        let outward = DVec3::new(p.x, p.y, 0.0).normalize_or_zero();
        let n = frame.rotation.transpose() * normal;
        let faces = [n.dot(outward), n.dot(DVec3::Z.cross(outward)), n.z];
        let most = (1..3).fold(0, |best, i| match faces[i].abs() > faces[best].abs() {
            true => i,
            false => best,
        });
        let turn = libm::atan2(p.y, p.x) / std::f64::consts::TAU;
        Self {
            turn: turn - libm::floor(turn),
            radius: libm::hypot(p.x, p.y) / radius,
            side: 2 * most as u8 + u8::from(faces[most] > 0.0),
        }
    }

    /// Shell around the axis, out of so many.
    pub fn shell(&self, shells: f64) -> u8 {
        (self.radius * shells) as u8
    }

    /// Whether the surface faces the axis or away from it.
    pub fn faces_radially(&self) -> bool {
        self.side < 2
    }
}

/// Less than that is no deviation, in the units of the shape.
const NOTHING: f64 = 1e-12;
/// Tests run between two looks at whether one failed.
const BLOCK: usize = 1 << 15;
/// Tests below which threads do not pay.
const PARALLEL: usize = 1 << 9;
/// Tests of one operation, or spread over all of a family, in a quick verification.
const QUICK: usize = 1_500;
/// The same in a full one: some for each triangle, between bounds.
const SHARED_PER_TRIANGLE: usize = 8;
const SHARED: [usize; 2] = [8_000, 60_000];
/// Share of the limit up to which what a full test of the first operation implies for its powers leaves
/// those to a quick one.
const IMPLIED: f64 = 0.25;
/// Corners looked at for powers of a rotation that takes faces to faces.
const SOME_CORNERS: usize = 64;
/// Distance up to which corners may be images of each other, where rounding does not explain more; in the units of
/// the shape.
const SAME_CORNER: f64 = 1e-10;

impl Shape {
    /// Deviation of one test, and whether it passes. Beyond the bound, the distance to any triangle
    /// that would do, or 1 when there is none.
    fn test(&self, sample: &Sample, operation: &Operation, bound: Bound) -> (f64, bool) {
        let image = operation.motion.apply(sample.point);
        let enough = NOTHING.min(0.1 * bound.limit);
        let find =
            |within| self.near_enough(image, sample.triangle, &operation.target, within, enough);
        // A little beyond the bound, so that what is found within it is found exactly.
        if let Some(n) = find(1.01 * bound.most()) {
            let passes = n.distance <= bound.limit
                || (n.distance <= bound.most()
                    && n.distance - bound.limit <= self.explained(sample.triangle, n.triangle));
            return (n.distance, passes);
        }
        // Where many triangles are about equally far, an open search would visit them all.
        let mut within = 4.0 * bound.most();
        while within < 2.0 {
            if let Some(n) = find(within) {
                return (n.distance, false);
            }
            within *= 4.0;
        }
        (find(f64::INFINITY).map_or(1.0, |n| n.distance), false)
    }

    /// The deviation between two triangles that facets explain: what they explain for both.
    fn explained(&self, a: u32, b: u32) -> f64 {
        let bulge = |t: u32| self.facets().around(self.triangles[t as usize]);
        bulge(a).min(bulge(b))
    }

    /// Whether an operation displaces the surface of some neighbourhood by more than `limit` on
    /// average. Differences between facets mostly cancel over a neighbourhood of several; what an
    /// oval bore or an eccentric hub deviates by does not. A neighbourhood is what faces alike in one
    /// sector and shell around the axis; of a whole shell, the part of the displacement that swings slowly
    /// around the axis is looked at.
    pub fn displaces(&self, frame: &Frame, operation: &Operation, limit: f64) -> bool {
        const SECTORS: f64 = 6.0;
        const SHELLS: f64 = 4.0;
        const FEWEST: f64 = 12.0;
        const TESTS: usize = 12_000;
        const PER_TRIANGLE: usize = 8;
        // Of coarse drawings, facets alone may swing by about the limit.
        const SWINGS: f64 = 1.2;
        let reach = 16.0 * limit;
        let radius = self.radius(frame);
        let displacement = |point: DVec3, triangle: u32| {
            let image = operation.motion.apply(point);
            let hit = self.nearest(image, triangle, &operation.target, reach)?;
            let normal = self.normals[hit.triangle as usize];
            let place = Place::new(frame, hit.point, normal, radius);
            Some((place, (image - hit.point).dot(normal)))
        };
        let mut cells: FxHashMap<[u8; 3], (f64, f64)> = FxHashMap::default();
        for sample in self.samples.faces.iter().take(TESTS) {
            let Some((place, off)) = displacement(sample.point, sample.triangle) else {
                continue;
            };
            let sector = libm::floor(place.turn * SECTORS) as u8;
            let cell = cells.entry([sector, place.shell(2.0), place.side]);
            let cell = cell.or_default();
            cell.0 += off;
            cell.1 += 1.0;
        }
        if cells
            .values()
            .any(|&(sum, count)| count >= FEWEST && sum.abs() > limit * count)
        {
            return true;
        }
        // The same number from every triangle (of very many, from some), so that small bores have enough of
        // them. Shells are taken twice, one set halfway between the other: one that ends within a bore
        // would have the outermost points of its facets only.
        let each = (TESTS / self.triangles.len()).clamp(1, PER_TRIANGLE);
        let step = self.triangles.len().div_ceil(TESTS);
        let mut shells: FxHashMap<[u8; 3], (Swing, bool)> = FxHashMap::default();
        for (t, corners) in self.triangles.iter().enumerate().step_by(step) {
            let [a, b, c] = corners.map(|v| self.vertices[v as usize]);
            let area = (b - a).cross(c - a).length();
            for i in 0..each {
                let [u, v] = spread_over_triangle(i);
                let point = a + (b - a) * u + (c - a) * v;
                let Some((place, off)) = displacement(point, t as u32) else {
                    continue;
                };
                for (set, start) in [(0, 0.0), (1, 0.5)] {
                    let shell = place.radius * SHELLS + start;
                    let from_end = (shell - libm::round(shell)).abs() * radius / SHELLS;
                    let key = [set, libm::floor(shell) as u8, place.side];
                    let (swing, whole) = shells.entry(key).or_insert((Swing::default(), true));
                    swing.add(place.turn, off, area);
                    *whole &= !place.faces_radially() || from_end > reach;
                }
            }
        }
        shells
            .values()
            .any(|(swing, whole)| *whole && swing.largest() > SWINGS * limit)
    }

    /// Runs tests 0 to `count - 1`; `job` names sample and operation of each. Returns the largest
    /// deviation, or as an error the first one that does not pass. Does not depend on the number of
    /// threads.
    pub fn worst<'a>(
        &self,
        count: usize,
        bound: Bound,
        job: impl Fn(usize) -> (&'a Sample, &'a Operation) + Sync,
    ) -> Result<Deviation, Deviation> {
        let run = |range: &Range<usize>| {
            let mut worst = NO_TEST;
            for i in range.clone() {
                let (sample, operation) = job(i);
                let (value, passes) = self.test(sample, operation, bound);
                let deviation = Deviation {
                    value,
                    at: sample.point,
                    image: operation.motion.apply(sample.point),
                    everywhere: false,
                };
                if !passes {
                    return Err(deviation);
                }
                worst = worst.max(deviation);
            }
            Ok(worst)
        };
        let mut worst = NO_TEST;
        let mut first = 0;
        // Small blocks to begin with: what fails mostly fails early.
        let mut block = PARALLEL / 2;
        while first < count {
            let end = (first + block).min(count);
            let parts = if end - first < PARALLEL {
                1
            } else {
                self.threads
            };
            let step = (end - first).div_ceil(parts);
            let ranges = (first..end).step_by(step);
            let ranges: Vec<_> = ranges.map(|i| i..(i + step).min(end)).collect();
            for result in in_parallel(&ranges, parts, run) {
                worst = worst.max(result?);
            }
            first = end;
            block = BLOCK;
        }
        Ok(worst)
    }

    /// The permutation of regions an operation makes, by votes of the triangles that images land on;
    /// `None` when the votes are no permutation or outside does not stay outside.
    pub fn vote(&self, motion: &Motion, within: f64) -> Option<Permutation> {
        let n = self.regions.len();
        let mut votes: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        for sample in self.samples.faces.iter().take(20_000.max(40 * n)) {
            let Some(hit) = self.nearest(motion.apply(sample.point), 0, &Target::Any, within)
            else {
                continue;
            };
            let (from, to) = (sample.triangle as usize, hit.triangle as usize);
            let cosine = self.normals[to].dot(motion.linear * self.normals[from]);
            if cosine.abs() < 0.5 {
                continue;
            }
            let ([a, b], [c, d]) = (self.sides[from], self.sides[to]);
            let (c, d) = if cosine > 0.0 { (c, d) } else { (d, c) };
            *votes.entry([a, c]).or_default() += 1;
            *votes.entry([b, d]).or_default() += 1;
        }
        let mut best: Vec<(u32, u32)> = vec![(0, NO_CLASS); n];
        for (&[from, to], &count) in &votes {
            let b = &mut best[from as usize];
            // Ties go to the lower region, so that the order of the table does not matter.
            if count > b.0 || (count == b.0 && to < b.1) {
                *b = (count, to);
            }
        }
        let last = n as u32 - 1;
        let permutation = Permutation::new(best.iter().map(|b| b.1).collect())?;
        (permutation.get(last) == last).then_some(permutation)
    }

    /// Verifies one operation that is its own kind (a mirror): every sample, or a few thousand.
    /// Regions stay where they are if that can be, else they are permuted.
    pub fn verify_one(
        &self,
        motion: Motion,
        bound: Bound,
        depth: Depth,
    ) -> Result<(Deviation, Permutation), Deviation> {
        self.with_permutation(motion, bound, |permutation| {
            let operation = Operation {
                motion,
                target: self.target(permutation),
            };
            if let Some(everywhere) = self.deviation_of_faces(&operation, bound) {
                return Ok(everywhere);
            }
            let (mixed, sorted) = (&self.samples.mixed, &self.samples.sorted);
            let first = mixed.len().min(QUICK);
            let worst = self.worst(first, bound, |i| (&mixed[i], &operation))?;
            if depth == Depth::Quick {
                return Ok(worst);
            }
            self.worst(sorted.len(), bound, |i| (&sorted[i], &operation))
        })
    }

    /// Verifies that the rotation by every multiple of a turn over `n` about the frame's z axis maps
    /// the surface onto itself.
    pub fn verify_rotation(
        &self,
        frame: &Frame,
        n: u32,
        bound: Bound,
        depth: Depth,
    ) -> Result<(Deviation, Permutation), Deviation> {
        let step = Motion::new(frame, Isometry::rotation(1, n).matrix());
        self.with_permutation(step, bound, |permutation| {
            let powers = permutation.powers(n);
            if !powers[n as usize - 1].after(permutation).is_identity() {
                return Err(Deviation {
                    value: 1.0,
                    ..Deviation::NONE
                });
            }
            let power = |k: u32| Operation {
                motion: Motion::new(frame, Isometry::rotation(i64::from(k), n).matrix()),
                target: self.target(&powers[k as usize]),
            };
            if let Some(everywhere) = self.rotation_of_faces(n, power, bound) {
                return Ok(everywhere);
            }
            let operations: Vec<Operation> = (1..n).map(power).collect();
            self.verify_family(&operations, bound, depth)
        })
    }

    /// Deviation of an operation that takes all flat faces to faces, if it does.
    fn deviation_of_faces(&self, operation: &Operation, bound: Bound) -> Option<Deviation> {
        let faces = self.faces()?;
        let within = self.same_corner().min(bound.limit);
        let (value, at) = faces.image(&operation.motion, &operation.target, within)?;
        Some(Deviation {
            value,
            at,
            image: operation.motion.apply(at),
            everywhere: true,
        })
    }

    /// The same of all powers of a rotation: what its first one implies is not asked again, and how far off others
    /// are is measured in some corners.
    fn rotation_of_faces(
        &self,
        n: u32,
        power: impl Fn(u32) -> Operation,
        bound: Bound,
    ) -> Option<Deviation> {
        let mut worst = self.deviation_of_faces(&power(1), bound)?;
        if !self.implies(n, worst, Deviation::NONE, bound) {
            return None;
        }
        for k in [n / 2, n / 3, 2 * n / 5, n - 1] {
            if k > 1 {
                let within = self.same_corner().min(bound.limit);
                let faces = self.faces()?;
                let value = faces.image_of_some(&power(k).motion, SOME_CORNERS, within)?;
                worst.value = worst.value.max(value);
            }
        }
        Some(worst)
    }

    /// Whether a rotation by a turn over `n` and an operation beside it, which both hold everywhere, leave no doubt that
    /// all products with its powers do: those deviate by at most so many times what the rotation does, and by what
    /// the other one does.
    pub fn implies(&self, n: u32, rotation: Deviation, other: Deviation, bound: Bound) -> bool {
        let most = rotation.value * f64::from(n - 1) + other.value;
        let enough = self.same_corner().max(IMPLIED * bound.limit);
        rotation.everywhere && other.everywhere && most <= enough
    }

    /// Distance up to which corners may be images of each other.
    pub fn same_corner(&self) -> f64 {
        self.rounding().max(SAME_CORNER)
    }

    /// Verifies many operations: a share of the samples for each, and with [`Depth::Full`] all of
    /// them for the first, of which the others then are powers.
    pub fn verify_family(
        &self,
        operations: &[Operation],
        bound: Bound,
        depth: Depth,
    ) -> Result<Deviation, Deviation> {
        let (samples, sorted) = (&self.samples.mixed, &self.samples.sorted);
        let others = operations.len();
        // Each sample with an operation drawn at random, before anything systematic.
        let mut random = Random(others as u64);
        let draws: Vec<u32> = (0..samples.len().min(QUICK / 2))
            .map(|_| random.below(others) as u32)
            .collect();
        let mut worst = self.worst(draws.len(), bound, |i| {
            (&samples[i], &operations[draws[i] as usize])
        })?;
        let mut implied = false;
        if depth == Depth::Full {
            let first = self.worst(sorted.len(), bound, |i| (&sorted[i], &operations[0]))?;
            // Powers deviate by at most so many times what the first does.
            implied = first.value * others as f64 <= IMPLIED * bound.limit;
            worst = worst.max(first);
        }
        let shared = match depth {
            Depth::Full if !implied => {
                (SHARED_PER_TRIANGLE * self.triangles.len()).clamp(SHARED[0], SHARED[1])
            }
            _ => QUICK,
        };
        let each = (shared / others).clamp(16, sorted.len().max(16));
        let stride = (sorted.len() / each).max(1);
        let rest = self.worst(each * others, bound, |i| {
            let (which, i) = (i / each, i % each);
            // Spread over the whole surface, and other samples for the next operation.
            (
                &sorted[(i * stride + which) % sorted.len()],
                &operations[which],
            )
        })?;
        Ok(worst.max(rest))
    }

    /// Runs `check` with regions in place; should that fail while the bare geometry passes, with the
    /// permutation of regions that the motion makes.
    fn with_permutation(
        &self,
        motion: Motion,
        bound: Bound,
        check: impl Fn(&Permutation) -> Result<Deviation, Deviation>,
    ) -> Result<(Deviation, Permutation), Deviation> {
        let identity = Permutation::identity(self.regions.len());
        let failed = match check(&identity) {
            Ok(deviation) => return Ok((deviation, identity)),
            Err(failed) => failed,
        };
        if self.regions.len() > 2
            // What is too far from any triangle is too far from those of every permutation.
            && (self.nearest(failed.image, 0, &Target::Any, 1.01 * bound.most())).is_some()
            && let Some(permutation) = self.vote(&motion, bound.most())
            && !permutation.is_identity()
            && let Ok(deviation) = check(&permutation)
        {
            return Ok((deviation, permutation));
        }
        Err(failed)
    }

    /// Largest deviation under rotations by angles spread over the whole turn, each sample by an
    /// angle of its own: small for a body of revolution. `None` beyond `limit`.
    pub fn deviation_from_revolution(&self, frame: &Frame, limit: f64) -> Option<Deviation> {
        let operations = golden_rotations(frame, 233, self.target_in_place());
        let samples = &self.samples.mixed;
        let count = samples.len().min(20_000);
        self.worst(count, Bound::plain(limit), |i| {
            (&samples[i], &operations[i % operations.len()])
        })
        .ok()
    }

    /// Every region stays where it is.
    pub fn target_in_place(&self) -> Target {
        self.target(&Permutation::identity(self.regions.len()))
    }
}

/// The `i`-th of points spread evenly over a triangle, as multiples of two of its sides: the R2 sequence
/// (Roberts 2018), folded over.
fn spread_over_triangle(i: usize) -> [f64; 2] {
    const STEP: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];
    let [u, v] = STEP.map(|s| (0.5 + s * (i + 1) as f64).fract());
    if u + v > 1.0 {
        [1.0 - u, 1.0 - v]
    } else {
        [u, v]
    }
}

/// Rotations about the frame's z axis by multiples of the golden section of a turn.
pub fn golden_rotations(frame: &Frame, count: usize, target: Target) -> Vec<Operation> {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    (1..=count)
        .map(|i| {
            let turn = (i as f64 * GOLDEN).fract();
            Operation {
                motion: Motion::new(frame, turn_matrix(turn)),
                target: target.clone(),
            }
        })
        .collect()
}

/// Rotation about z by a fraction of a full turn.
pub fn turn_matrix(turn: f64) -> DMat3 {
    let (s, c) = libm::sincos(std::f64::consts::TAU * turn);
    DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
}
