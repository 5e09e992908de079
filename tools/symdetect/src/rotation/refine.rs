//! Adjusting axis, centre and mirror plane to the shape.

use crate::shape::{Motion, Shape, Target};
use crate::tolerance::VANISHING;
use crate::verify::{Bound, Operation};
use geom::eigen;
use geom::tree::Nearest;
use glam::{DMat3, DVec3};
use tmesh::{Frame, Isometry};

/// Steps after which an adjustment is given up: Gauss-Newton doubles the correct digits with every step from a
/// candidate that has two or three of them, but the nearest triangles change meanwhile.
const STEPS: usize = 12;
/// Share of the mean square that must be left at most for another step to be worth it.
const GAIN: f64 = 0.9;
/// Times the root of the mean square beyond which an image is an outlier, and the factor by which that distance falls in
/// one step at most: no error of facets or rounding is that far out, and what is left out once never comes back.
const FAR: f64 = 20.0;
/// Largest step, in radians and in units of the shape: more than any candidate is off by, and little enough for the
/// linearized rotation.
const LONGEST_STEP: f64 = 0.1;
/// Triangles whose normals differ by more than this cosine are not taken for images of each other.
const SAME_FACE: f64 = 0.7;
/// Equations of faces to each corner that is taken beside them at least: a corner makes three, so that no more than
/// about as many are of corners.
const CORNERS: usize = 4;

/// An operation by its matrix in the frame that is being adjusted.
pub struct Canonical {
    /// Orthogonal matrix.
    pub matrix: DMat3,
    /// Where triangles may land.
    pub target: Target,
}

impl Canonical {
    /// An isometry of the frame.
    pub fn new(isometry: Isometry, target: Target) -> Self {
        Self {
            matrix: isometry.matrix(),
            target,
        }
    }
}

/// What a frame is adjusted to.
pub struct Fit<'a> {
    /// Operations that are fixed in the frame.
    pub operations: &'a [Canonical],
    /// Equations at most.
    pub samples: usize,
    /// Distance from the surface, or where facets hide something from what they may stand for, beyond which images are left
    /// out.
    pub reach: f64,
    /// What deviations are allowed: places where the shape is known less well than that count less.
    pub bound: Bound,
}

/// Moves and turns the frame so that the operations, which are fixed in the frame, map the surface
/// onto itself as well as can be in the sense of least squares.
///
/// Gauss-Newton on point-to-plane distances of face samples to the nearest triangle (Chen and
/// Medioni 1992), where the unknown is the frame rather than the motion. Samples farther off than
/// the reach are left out. The result has no larger mean square than the start.
pub fn refine(shape: &Shape, start: Frame, fit: &Fit<'_>) -> Frame {
    let mut best = start;
    let mut reach = fit.reach;
    let mut best_error = f64::INFINITY;
    let mut frame = start;
    let mut hits = Hits::default();
    for _ in 0..STEPS {
        let Some(step) = gauss_newton(shape, &frame, fit, reach, &mut hits) else {
            break;
        };
        if step.mean_square >= best_error {
            break;
        }
        let gain = step.mean_square < GAIN * best_error;
        best_error = step.mean_square;
        best = frame;
        if !gain || step.mean_square == 0.0 {
            break;
        }
        if step.promised >= GAIN * step.mean_square {
            // Not worth another look.
            best = step.frame;
            break;
        }
        frame = step.frame;
        // Outliers leave as the fit gets better, but never what a good fit would keep.
        reach = (FAR * step.mean_square.sqrt()).clamp(reach / FAR, reach);
    }
    best
}

/// Moves and turns the frame to what most of the surface is mapped onto itself about, however much of it is not: of what
/// is within the reach of the fit, and then of half of that, and so on down to its bound, so that what belongs elsewhere
/// drops out (graduated non-convexity, Blake and Zisserman 1987).
pub fn settle(shape: &Shape, start: Frame, fit: &Fit<'_>) -> Frame {
    let mut frame = start;
    let mut reach = fit.reach;
    let mut hits = Hits::default();
    while reach > fit.bound.limit {
        let Some(step) = gauss_newton(shape, &frame, fit, reach, &mut hits) else {
            break;
        };
        frame = step.frame;
        reach *= 0.5;
    }
    frame
}

/// Moves and turns the frame until facets explain where the operations take the surface, if a little will do: by least
/// squares of what is beyond that alone, where a fit to all of the surface leaves the frame to what is not known of the
/// shape.
pub fn explain(shape: &Shape, start: Frame, fit: &Fit<'_>) -> Frame {
    let mut frame = start;
    for _ in 0..STEPS {
        let operation = |o: &Canonical| Operation {
            motion: Motion::new(&frame, o.matrix),
            target: o.target.clone(),
        };
        let operations: Vec<Operation> = fit.operations.iter().map(operation).collect();
        let mut equations = Equations::default();
        let samples = &shape.samples.mixed;
        for i in 0..fit.samples.min(samples.len() * operations.len()) {
            let sample = &samples[i % samples.len()];
            let operation = &operations[(i + i / samples.len()) % operations.len()];
            if let Some(off) = shape.unexplained(sample, operation, fit.bound) {
                equations.add(&operation.motion, sample.point, off, 1.0);
            }
        }
        match equations.step(&frame) {
            Some(step) => frame = step.frame,
            None => break,
        }
    }
    frame
}

struct Step {
    frame: Frame,
    /// What is left before the frame moves.
    mean_square: f64,
    /// What would be left of that where it moves to, if nothing bent.
    promised: f64,
}

/// The triangle that the image of each equation's sample was nearest to in the step before, if near any: that is mostly the
/// one in the next step, too.
#[derive(Default)]
struct Hits(Vec<Option<u32>>);

impl Hits {
    fn before(&self, equation: usize) -> Option<u32> {
        self.0.get(equation).copied().flatten()
    }

    fn note(&mut self, equation: usize, hit: Option<&Nearest>) {
        if equation == self.0.len() {
            self.0.push(None);
        }
        self.0[equation] = hit.map(|hit| hit.triangle);
    }
}

fn gauss_newton(
    shape: &Shape,
    frame: &Frame,
    fit: &Fit<'_>,
    reach: f64,
    hits: &mut Hits,
) -> Option<Step> {
    let operations = fit.operations;
    let motions: Vec<Motion> = operations
        .iter()
        .map(|o| Motion::new(frame, o.matrix))
        .collect();
    let mut equations = Equations::default();
    let faces = &shape.samples.faces;
    let taken = fit.samples.min(faces.len() * operations.len());
    for i in 0..taken {
        let mut sample = faces[i % faces.len()];
        if fit.bound.facets && i % 2 == 1 {
            // Vertices are on the shape itself, wherever its facets are.
            sample.point = shape.corners(sample.triangle)[i / 2 % 3];
        }
        let which = (i + i / faces.len()) % operations.len();
        let (motion, target) = (&motions[which], &operations[which].target);
        let y = motion.apply(sample.point);
        let turned = motion.linear * shape.normals[sample.triangle as usize];
        let within = Bound {
            limit: reach,
            ..fit.bound
        };
        let hit = match hits.before(i).filter(|_| fit.bound.facets) {
            Some(known) => shape.nearest_behind_again((y, known), sample.triangle, target, reach),
            None => shape.near(y, sample.triangle, target, within),
        };
        hits.note(i, hit.as_ref());
        let Some(hit) = hit else {
            if !fit.bound.facets {
                equations.leave_out(reach);
            }
            continue;
        };
        // The plane of the sample's own face, moved: same plane as the one it lands on when the
        // faces match, and defined on edges as well.
        let normal = turned;
        let off = y - hit.point;
        if hit.distance > 0.0 && off.dot(normal).abs() < SAME_FACE * hit.distance {
            // Slid off the edge of a face: says nothing about the distance between faces.
            if !fit.bound.facets {
                equations.leave_out(hit.distance);
            }
            continue;
        }
        let mut e = normal.dot(off);
        let mut weight = 1.0;
        if fit.bound.facets {
            // Beside an edge of a facet, nothing tells where the shape is.
            let Some(apart) = shape.apart(&sample, motion, &hit) else {
                continue;
            };
            e = apart.shapes * normal.dot(shape.normals[hit.triangle as usize]).signum();
            weight /= 1.0 + ((apart.slack + apart.doubt) / fit.bound.limit).powi(2);
        }
        equations.add(motion, sample.point, (normal, e), weight);
    }
    if fit.bound.facets {
        // Where faces are drawn so coarsely that they tell little, corners are as they were drawn.
        let corners = shape.smooth().corners();
        let (points, count) = (corners.points(), corners.points().len());
        for i in 0..(fit.samples / CORNERS).min(count * operations.len()) {
            let (point, motion) = (points[i % count], &motions[(i + i / count) % motions.len()]);
            let y = motion.apply(point);
            if let Some(corner) = corners.nearest(y, reach) {
                for normal in DVec3::AXES {
                    equations.add(motion, point, (normal, normal.dot(y - corner)), 1.0);
                }
            }
        }
    }
    equations.step(frame)
}

/// Equations of least squares for a small turn about the centre of the motions and a shift.
#[derive(Default)]
struct Equations {
    a: [[f64; 6]; 6],
    b: [f64; 6],
    sum: f64,
    count: f64,
}

impl Equations {
    /// The image of a point, by a motion that is fixed in the frame, is off along a unit vector by `e`.
    fn add(&mut self, motion: &Motion, point: DVec3, (normal, e): (DVec3, f64), weight: f64) {
        let back = motion.linear.transpose() * normal;
        let (x, z) = (point - motion.centre, motion.apply(point) - motion.centre);
        let turn = z.cross(normal) - x.cross(back);
        let shift = normal - back;
        let row = [turn.x, turn.y, turn.z, shift.x, shift.y, shift.z];
        for (p, u) in row.iter().enumerate() {
            for (q, v) in row.iter().enumerate() {
                self.a[p][q] += weight * u * v;
            }
            self.b[p] -= weight * u * e;
        }
        self.sum += weight * e * e;
        self.count += weight;
    }

    /// An image that is off by so much says nothing of where the frame is.
    fn leave_out(&mut self, distance: f64) {
        self.sum += distance * distance;
        self.count += 1.0;
    }

    /// The frame that solves them, and what is left before it moves.
    fn step(self, frame: &Frame) -> Option<Step> {
        if self.count < 6.0 {
            return None;
        }
        let solution = eigen::symmetric(self.a);
        let mut x = [0.0; 6];
        let mut gain = 0.0;
        for (value, vector) in solution.values.iter().zip(&solution.vectors) {
            // Motions that the operations do not see, such as a slide along the axis, are left out.
            if *value > VANISHING * solution.values[5] {
                let along: f64 = vector.iter().zip(&self.b).map(|(v, b)| v * b).sum();
                gain += along * along / value;
                for (x, v) in x.iter_mut().zip(vector) {
                    *x += along / value * v;
                }
            }
        }
        let turn = DVec3::new(x[0], x[1], x[2]);
        let shift = DVec3::new(x[3], x[4], x[5]);
        let scale = (LONGEST_STEP / turn.length().max(shift.length())).min(1.0);
        Some(Step {
            frame: moved(frame, turn * scale, shift * scale),
            mean_square: self.sum / self.count,
            promised: (self.sum - gain) / self.count,
        })
    }
}

/// The frame turned by a small rotation vector about its origin and shifted.
fn moved(frame: &Frame, turn: DVec3, shift: DVec3) -> Frame {
    let angle = turn.length();
    let rotate = |v: DVec3| {
        if angle == 0.0 {
            return v;
        }
        let (s, c) = libm::sincos(angle);
        let axis = turn / angle;
        v * c + axis.cross(v) * s + axis * (axis.dot(v) * (1.0 - c))
    };
    let z = rotate(frame.rotation.z_axis);
    let x = rotate(frame.rotation.x_axis);
    Frame::from_axis(frame.origin + shift, z, x).unwrap_or(*frame)
}
