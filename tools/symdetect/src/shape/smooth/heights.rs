//! Heights of the shape above triangles.

use crate::shape::smooth::curvature::outer;
use crate::shape::smooth::facets::Facets;
use geom::edges::EdgeUse;
use geom::measure::double_area_vector;
use glam::{DMat3, DVec3};

/// The shape above one triangle, in single precision: heights are small against coordinates.
#[derive(Clone, Copy, Default)]
pub struct Heights {
    /// Height above each corner: zero but for vertices that only divide a facet.
    pub corner: [f32; 3],
    /// Height above the middle of each side, over what it is at its ends.
    pub side: [f32; 3],
    /// Both where edges are smooth that may be sharp.
    pub bent: [[f32; 3]; 2],
    /// Both by the vertices around, however they are joined, as far as edges are smooth, and as far as they may be.
    pub fitted: [[[f32; 3]; 2]; 2],
    /// Height there of the other diagonal of the quadrilateral that the triangle makes with the one beyond.
    pub flipped: [f32; 3],
    /// What two estimates of the heights differ by where the corners are far away.
    pub slack: f32,
    /// The chord that each side is part of where it is a sharp edge.
    pub border: [Border; 3],
}

/// A part of a chord of a curve.
#[derive(Clone, Copy, Default)]
pub struct Border {
    /// Where it starts and ends along the chord.
    pub along: [f32; 2],
    /// Length of the chord; zero where there is none.
    pub length: f32,
    /// Curvature of the curve.
    pub curvature: f32,
    /// What vertices add to what edges tell of it.
    pub fitted: f32,
}

impl Border {
    /// Height of the curve over the middle of the chord.
    pub fn sagitta(&self) -> f32 {
        0.125 * self.length * self.length * (self.curvature + self.fitted)
    }

    /// How far a curve of curvature one may be from the chord at a part of this piece of it. A circle rises above it
    /// by `k s (L - s) / 2`; any curve that bends one way stays below the extensions of the chords next to it, which
    /// rise twice as steeply from the corners, where all of them are on the curve.
    pub fn bow(&self, part: f64) -> f64 {
        let [from, to] = self.along.map(f64::from);
        let length = f64::from(self.length);
        let at = from + part * (to - from);
        let most = 0.125 * length * length;
        (at * (length - at)).clamp(0.0, most)
    }
}

impl Heights {
    /// Height of the shape at barycentric coordinates.
    pub fn shape(&self, b: [f64; 3]) -> f64 {
        patch([self.corner, self.side], b)
    }

    /// The heights, least and largest, between which the shape may be at barycentric coordinates.
    pub fn range(&self, b: [f64; 3]) -> [f64; 2] {
        let mut range = [0.0_f64; 2];
        let flipped = (0..3).map(|c| bubble_of(self.flipped[c], b, c));
        let fitted = self.fitted.map(|fitted| patch(fitted, b));
        let patches = [self.shape(b), patch(self.bent, b)]
            .into_iter()
            .chain(fitted);
        for height in flipped.chain(patches) {
            range = [range[0].min(height), range[1].max(height)];
        }
        range
    }

    /// The part of the slack that counts at barycentric coordinates. Corners of a facet are on the shape, and from there
    /// it rises no more steeply than the facets next to it, twice as steeply as a circle does.
    pub fn away(&self, b: [f64; 3]) -> f64 {
        let divides = (0..3).filter(|c| self.corner[*c] != 0.0);
        let away = 2.0 * bubble([1.0; 3], b) + divides.map(|c| b[c]).sum::<f64>();
        away.min(1.0)
    }

    /// Adds what another reading of the edges says.
    pub fn add(&mut self, other: &Self) {
        self.bent = [other.corner, other.side];
        self.fitted[1] = other.fitted[0];
        // Either diagonal of an edge that may be sharp: of a smooth one, both readings say the same.
        self.flipped = other.flipped;
        self.slack = self.slack.max(other.slack);
        for (border, other) in self.border.iter_mut().zip(other.border) {
            if other.sagitta() > border.sagitta() {
                *border = other;
            }
        }
    }

    /// Adds what the vertices around tell of the curvature.
    fn add_fitted(&mut self, other: &Self, corners: [DVec3; 3], curvature: DMat3) {
        self.fitted[0] = [other.corner, other.side];
        for (c, border) in self.border.iter_mut().enumerate() {
            let along = (corners[(c + 1) % 3] - corners[c]).normalize_or_zero();
            let bends = along.dot(curvature * along).abs();
            border.fitted = (bends as f32 - border.curvature).max(0.0);
        }
    }

    /// How far what vertices tell is beyond what folds do, in the middles of the sides and at the corners.
    pub fn wider(&self) -> f64 {
        let beyond = |fitted: f32, all: [f32; 3]| {
            let [low, high] = [f32::min, f32::max].map(|f| all.into_iter().fold(0.0, f));
            (fitted - high).max(low - fitted).max(0.0)
        };
        let of = |c: usize| {
            let [corner, side] = self.bent;
            let sides = [self.side[c], side[c], self.flipped[c]];
            let corners = [self.corner[c], corner[c], 0.0];
            let fitted = self
                .fitted
                .map(|[corner, side]| beyond(side[c], sides) + beyond(corner[c], corners));
            fitted[0].max(fitted[1])
        };
        let border = |b: &Border| 0.125 * b.length * b.length * b.fitted;
        let borders = self.border.iter().map(border);
        let all = [0, 1, 2].map(of).into_iter().chain(borders);
        all.fold(0.0, f32::max).into()
    }

    /// The most that the triangle hides.
    pub fn most(&self) -> f64 {
        let largest = |x: [f32; 3]| x.iter().fold(0.0_f32, |m, h| m.max(h.abs()));
        let above = |[corner, side]: [[f32; 3]; 2]| largest(corner) + largest(side);
        let fitted = self.fitted.map(above).into_iter().fold(0.0, f32::max);
        let above = above([self.corner, self.side]).max(above(self.bent));
        let above = above.max(fitted).max(largest(self.flipped)) + 2.0 * self.slack;
        let at_borders = self.border.iter().map(Border::sagitta);
        at_borders.fold(above, f32::max).into()
    }
}

/// A quadratic function from its values at the corners and what it is over those in the middles of the sides.
fn patch([corner, side]: [[f32; 3]; 2], b: [f64; 3]) -> f64 {
    let corners: f64 = (0..3).map(|c| b[c] * f64::from(corner[c])).sum();
    corners + bubble(side, b)
}

/// A quadratic function that is zero at the corners, from its values in the middles of the sides.
fn bubble(side: [f32; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|c| bubble_of(side[c], b, c)).sum()
}

fn bubble_of(side: f32, b: [f64; 3], c: usize) -> f64 {
    4.0 * f64::from(side) * b[c] * b[(c + 1) % 3]
}

/// Barycentric coordinates of a point in the plane of a triangle.
pub fn barycentric([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let n = double_area_vector(a, b, c);
    let whole = n.length_squared();
    if whole <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let part = |a: DVec3, b: DVec3| (double_area_vector(a, b, p).dot(n) / whole).clamp(0.0, 1.0);
    [part(b, c), part(c, a), part(a, b)]
}

/// Heights of quadratic patches with these curvatures through the corners of the facets.
pub fn patches(facets: &Facets<'_>, curvature: &[DMat3]) -> Vec<Heights> {
    let corners = facets.turning_points();
    let mut planes = vec![None; facets.flats.count()];
    let with_normals = facets.flats.of.iter().zip(facets.normals);
    for (&flat, &normal) in with_normals {
        let flat = flat as usize;
        if planes[flat].is_none() && !facets.single[flat] && curvature[flat] != DMat3::ZERO {
            let corners = corners.of(flat as u32);
            let corners = corners.iter().map(|v| facets.vertices[*v as usize]);
            planes[flat] = Patch::through(&corners.collect::<Vec<_>>(), normal, curvature[flat]);
        }
    }
    let heights = |(t, &flat): (usize, &u32)| {
        let turning = corners.of(flat);
        let is_turning = |v| facets.single[flat as usize] || turning.binary_search(&v).is_ok();
        let is_turning = facets.triangles[t].map(is_turning);
        let (corners, h) = (facets.corners(t), curvature[flat as usize]);
        let side = |c: usize| {
            let e = corners[(c + 1) % 3] - corners[c];
            (0.125 * e.dot(h * e)) as f32
        };
        let patch = planes[flat as usize].as_ref();
        Heights {
            side: [0, 1, 2].map(side),
            corner: [0, 1, 2].map(|c| match (is_turning[c], patch) {
                (false, Some(patch)) => patch.height(corners[c]) as f32,
                _ => 0.0,
            }),
            slack: patch.map_or(0.0, |q| q.off as f32),
            ..Heights::default()
        }
    };
    facets.flats.of.iter().enumerate().map(heights).collect()
}

/// Lets the shape be where patches with these curvatures have it, too.
pub fn add_fitted(facets: &Facets<'_>, curvature: &[DMat3], heights: &mut [Heights]) {
    let other = patches(facets, curvature);
    for (t, (heights, other)) in heights.iter_mut().zip(&other).enumerate() {
        let curvature = curvature[facets.flats.of[t] as usize];
        heights.add_fitted(other, facets.corners(t), curvature);
    }
}

/// A quadratic function in the plane of a facet.
#[derive(Clone)]
struct Patch {
    middle: DVec3,
    curvature: DMat3,
    slope: DVec3,
    constant: f64,
    /// How far it is from the corners of the facet at most.
    off: f64,
}

impl Patch {
    /// The patch that passes closest to the corners of a polygon, by least squares; exactly where there are three.
    fn through(corners: &[DVec3], normal: DVec3, curvature: DMat3) -> Option<Self> {
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let size = (corners.iter().map(|p| (p - middle).length())).fold(0.0, f64::max);
        let x = normal.any_orthonormal_vector();
        let y = normal.cross(x);
        let mut patch = Self {
            middle,
            curvature,
            slope: DVec3::ZERO,
            constant: 0.0,
            off: 0.0,
        };
        let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for p in corners {
            let at = (p - middle) / size;
            let row = DVec3::new(at.dot(x), at.dot(y), 1.0);
            matrix += outer(row, row);
            right -= row * patch.height(*p);
        }
        // Corners on one line tell no plane.
        if matrix.determinant() <= f64::EPSILON * corners.len() as f64 {
            return None;
        }
        let solution = matrix.inverse() * right;
        patch.slope = (x * solution.x + y * solution.y) / size;
        patch.constant = solution.z;
        patch.off = (corners.iter().map(|p| patch.height(*p).abs())).fold(0.0, f64::max);
        Some(patch)
    }

    fn height(&self, p: DVec3) -> f64 {
        let d = p - self.middle;
        self.constant + self.slope.dot(d) - 0.5 * d.dot(self.curvature * d)
    }
}

/// Sets the heights of the diagonals that another drawing of the same corners may have: where two single triangles make
/// a convex quadrilateral, either of its diagonals may have been drawn.
pub fn flip(facets: &Facets<'_>, is_smooth: &[bool], heights: &mut [Heights]) {
    for edge in (0..facets.edges.len()).filter(|e| is_smooth[*e]) {
        let [u, v] = facets.edges.around(edge) else {
            continue;
        };
        let single = |u: &EdgeUse| facets.single[facets.flat(u) as usize];
        if !(single(u) && single(v)) {
            continue;
        }
        if let Some(height) = other_diagonal(facets, [u, v]) {
            for u in [u, v] {
                heights[u.triangle as usize].flipped[u.corner as usize] = height as f32;
            }
        }
    }
}

/// Height of the other diagonal above an edge where they cross, seen along the normal between.
fn other_diagonal(facets: &Facets<'_>, [u, v]: [&EdgeUse; 2]) -> Option<f64> {
    let normal = (facets.normal(u) + facets.normal(v)).normalize_or_zero();
    let [a, b] = facets.ends(u);
    let [c, d] = [u, v].map(|u| facets.apex(u));
    // The point of p q that the line r s passes.
    let crossing = |p: DVec3, q: DVec3, r: DVec3, s: DVec3| {
        let across = normal.cross(s - r);
        let (x, y) = (across.dot(p - r), across.dot(q - r));
        (x * y < 0.0).then(|| p.lerp(q, x / (x - y)))
    };
    Some((crossing(c, d, a, b)? - crossing(a, b, c, d)?).dot(normal))
}
