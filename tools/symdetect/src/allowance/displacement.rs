//! Neighbourhoods that an operation displaces as a whole.

use crate::allowance::model::{FEWEST_IN_SECTOR, REACH, SECTORS, SHELLS, SWINGS};
use crate::allowance::place::Place;
use crate::allowance::swing::Swing;
use crate::budget::{GLANCE, SURVEY};
use crate::shape::Shape;
use crate::verify::Operation;
use geom::measure::double_area_vector;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::Frame;

/// Whether an operation displaces the surface of some neighbourhood by more than `limit` on
/// average. Differences between facets mostly cancel over a neighbourhood of several; what an
/// oval bore or an eccentric hub deviates by does not. A neighbourhood is what faces alike in one
/// sector and shell around the axis; of a whole shell, the part of the displacement that swings slowly
/// around the axis is looked at.
pub fn displaces(shape: &Shape, frame: &Frame, operation: &Operation, limit: f64) -> bool {
    let displacements = Displacements {
        shape,
        frame,
        operation,
        reach: REACH * limit,
        radius: shape.radius(frame),
    };
    displacements.of_sectors(limit) || displacements.of_shells(SWINGS * limit)
}

/// The displacements of a surface by an operation.
struct Displacements<'a> {
    shape: &'a Shape,
    frame: &'a Frame,
    operation: &'a Operation,
    /// Farther images have landed on something else.
    reach: f64,
    /// Of the body.
    radius: f64,
}

impl Displacements<'_> {
    /// Where the image of a point of a triangle lands, and how far outwards of the surface it is.
    fn at(&self, point: DVec3, triangle: u32) -> Option<(Place, f64)> {
        let image = self.operation.motion.apply(point);
        let target = &self.operation.target;
        let hit = (self.shape).nearest(image, triangle, target, self.reach)?;
        let normal = self.shape.normals[hit.triangle as usize];
        let place = Place::new(self.frame, hit.point, normal, self.radius);
        Some((place, (image - hit.point).dot(normal)))
    }

    /// Whether the mean over some sector of a shell is beyond the limit.
    fn of_sectors(&self, limit: f64) -> bool {
        let mut sectors: FxHashMap<[u8; 3], (f64, f64)> = FxHashMap::default();
        for sample in self.shape.samples.faces.iter().take(SURVEY) {
            let Some((place, off)) = self.at(sample.point, sample.triangle) else {
                continue;
            };
            let sector = libm::floor(place.turn * f64::from(SECTORS)) as u8;
            let sum = sectors.entry([sector, place.shell(0.5 * SHELLS), place.side]);
            let sum = sum.or_default();
            sum.0 += off;
            sum.1 += 1.0;
        }
        let beyond =
            |&(sum, count): &(f64, f64)| count >= FEWEST_IN_SECTOR && sum.abs() > limit * count;
        sectors.values().any(beyond)
    }

    /// Whether slow waves over some shell are beyond the limit.
    fn of_shells(&self, limit: f64) -> bool {
        let (shape, tests) = (self.shape, SURVEY);
        // The same number from every triangle (of very many, from some), so that small bores have enough of
        // them. Shells are taken twice, one set halfway between the other: one that ends within a bore
        // would have the outermost points of its facets only.
        let each = (tests / shape.triangles.len()).clamp(1, GLANCE);
        let step = shape.triangles.len().div_ceil(tests);
        let mut shells: FxHashMap<[u8; 3], (Swing, bool)> = FxHashMap::default();
        for (t, corners) in shape.triangles.iter().enumerate().step_by(step) {
            let [a, b, c] = corners.map(|v| shape.vertices[v as usize]);
            let area = double_area_vector(a, b, c).length();
            for i in 0..each {
                let [u, v] = spread_over_triangle(i);
                let point = a + (b - a) * u + (c - a) * v;
                let Some((place, off)) = self.at(point, t as u32) else {
                    continue;
                };
                for (set, start) in [(0, 0.0), (1, 0.5)] {
                    let shell = place.radius * SHELLS + start;
                    let from_end = (shell - libm::round(shell)).abs() * self.radius / SHELLS;
                    let key = [set, libm::floor(shell) as u8, place.side];
                    let (swing, whole) = shells.entry(key).or_insert((Swing::default(), true));
                    swing.add(place.turn, off, area);
                    *whole &= !place.faces_radially() || from_end > self.reach;
                }
            }
        }
        let beyond = |(swing, whole): &(Swing, bool)| *whole && swing.largest() > limit;
        shells.values().any(beyond)
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
