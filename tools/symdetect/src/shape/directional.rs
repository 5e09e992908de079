//! Moments of high degree in every direction, whose critical points are where symmetry axes can lie.

use crate::budget::REPORTED;
use crate::tolerance::VANISHING;
use geom::eigen;
use geom::measure::double_area_vector;
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;

/// Degree of the directional moment: the lowest at which no polyhedral group leaves the moment the same in every
/// direction. The invariant polynomials of the icosahedron have the degrees 2, 6 and 10, the first of which is the
/// distance from the centre; those of the other groups begin at lower ones.
const DEGREE: usize = 6;
/// Monomials of that degree.
const TERMS: usize = (DEGREE + 1) * (DEGREE + 2) / 2;
/// Longest step of the search for critical points, radians: along a great circle, the moment is a trigonometric
/// polynomial of its degree, whose derivative is at most the degree times its size (Bernstein).
const LONGEST_STEP: f64 = 1.0 / DEGREE as f64;
/// Newton steps after which a start is given up: the longest ones go around half of the sphere in three times the
/// degree, and half a dozen reach the precision of numbers once they converge.
const STEPS: usize = 4 * DEGREE;
/// Length of a step, in radians, after which there is nothing to gain: what rounding leaves of the gradient, a sum of so
/// many terms, each a product of so many numbers. With more, points along curves of nearly critical points pass as
/// well, each of which costs a search about it.
const CONVERGED: f64 = (TERMS * DEGREE) as f64 * f64::EPSILON;
/// The golden section of one: multiples of it, whole turns left out, are spread evenly however many there are.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// The function `f(w) = integral of (x . w)^6` over the surface plus the volume, `|w| = 1`, each
/// divided by its total.
///
/// Every symmetry axis of the body, and every normal of a mirror plane, is a critical point of it,
/// because the gradient there is a tangent vector that some half turn or rotation about the
/// direction preserves. This is the generalized moment of Martinet et al., "Accurate detection of
/// symmetries in 3D shapes" (ACM TOG 2006), with the power of the distance to a plane in place of
/// the distance to a line; both span the even spherical harmonics up to the degree.
pub struct DirectionalMoment {
    /// Of the monomials, in the order of [`exponents`].
    coefficients: [f64; TERMS],
}

/// Exponents of the monomials. Those of lower degrees are in the same order, with smaller exponents of the first
/// coordinate, and end sooner.
fn exponents() -> impl Iterator<Item = [usize; 3]> {
    (0..=DEGREE).flat_map(|rest| (0..=rest).map(move |z| [DEGREE - rest, rest - z, z]))
}

impl DirectionalMoment {
    /// Critical directions at most, where they are isolated: the number of eigenvectors, up to sign, of a symmetric
    /// tensor of three dimensions and this order (Cartwright and Sturmfels 2013). An icosahedron has as many axes.
    pub const MOST_DIRECTIONS: usize = DEGREE * DEGREE - DEGREE + 1;

    /// Integrates over triangles as [`Moments::new`] does; coordinates are relative to the centre.
    pub fn new(triangles: impl Iterator<Item = ([DVec3; 3], f64)>) -> Self {
        // The integral of a power of a linear form over a simplex is, up to a constant, the complete
        // homogeneous polynomial of its values at the corners; the centre adds nothing.
        let (mut area, mut volume) = ([0.0; TERMS], [0.0; TERMS]);
        let (mut total_area, mut total_volume) = (0.0_f64, 0.0_f64);
        for ([a, b, c], sign) in triangles {
            let s = double_area_vector(a, b, c).length();
            let v = sign * a.dot(b.cross(c));
            total_area += s;
            total_volume += v;
            let moments = complete([a, b, c]);
            for ((area, volume), h) in area.iter_mut().zip(&mut volume).zip(moments) {
                *area += s * h;
                *volume += v * h;
            }
        }
        let inverse = |total: f64, least: f64| if total > least { 1.0 / total } else { 0.0 };
        let scale_area = inverse(total_area, 0.0);
        let scale_volume = inverse(total_volume, VANISHING * total_area);
        let mut coefficients = area.map(|a| a * scale_area);
        for (c, v) in coefficients.iter_mut().zip(volume) {
            *c += v * scale_volume;
        }
        Self { coefficients }
    }

    /// Value, gradient and second derivatives at `w`.
    pub fn derivatives(&self, w: DVec3) -> (f64, DVec3, DMat3) {
        let powers: [[f64; DEGREE + 1]; 3] = w.to_array().map(|x| {
            let mut p = [1.0; DEGREE + 1];
            for k in 1..=DEGREE {
                p[k] = p[k - 1] * x;
            }
            p
        });
        // Derivative of order `d` of x^e.
        let term = |axis: usize, e: usize, d: usize| match (d, e) {
            (0, e) => powers[axis][e],
            (1, e) if e >= 1 => e as f64 * powers[axis][e - 1],
            (2, e) if e >= 2 => (e * (e - 1)) as f64 * powers[axis][e - 2],
            _ => 0.0,
        };
        let (mut value, mut gradient, mut hessian) = (0.0, DVec3::ZERO, [[0.0; 3]; 3]);
        for (c, e) in self.coefficients.iter().zip(exponents()) {
            let product =
                |d: [usize; 3]| c * term(0, e[0], d[0]) * term(1, e[1], d[1]) * term(2, e[2], d[2]);
            value += product([0, 0, 0]);
            for i in 0..3 {
                let mut d = [0; 3];
                d[i] += 1;
                gradient[i] += product(d);
                for (j, h) in hessian[i].iter_mut().enumerate() {
                    let mut d = d;
                    d[j] += 1;
                    *h += product(d);
                }
            }
        }
        (value, gradient, DMat3::from_cols_array_2d(&hessian))
    }

    /// The critical points of the function on the sphere, one of each antipodal pair or more, by Newton's
    /// method from an even spread of starts, several for each. Where they form a curve (a body of revolution), some
    /// points of the curve.
    pub fn critical_directions(&self) -> Vec<DVec3> {
        hemisphere(REPORTED)
            .filter_map(|start| self.newton(start))
            .collect()
    }

    fn newton(&self, mut w: DVec3) -> Option<DVec3> {
        for _ in 0..STEPS {
            let (_, g, h) = self.derivatives(w);
            let (u, v) = w.any_orthonormal_pair();
            let radial = g.dot(w);
            let (gu, gv) = (g.dot(u), g.dot(v));
            let a = u.dot(h * u) - radial;
            let b = u.dot(h * v);
            let d = v.dot(h * v) - radial;
            // Pseudo-inverse: along a curve of critical points there is nothing to correct.
            let e = eigen::symmetric([[a, b], [b, d]]);
            let largest = e.values[0].abs().max(e.values[1].abs());
            if largest == 0.0 {
                return None;
            }
            let mut step = DVec3::ZERO;
            for (value, [p, q]) in e.values.iter().zip(e.vectors) {
                if value.abs() > VANISHING * largest {
                    step -= (u * p + v * q) * ((p * gu + q * gv) / value);
                }
            }
            let length = step.length();
            w = (w + step * (LONGEST_STEP / length).min(1.0)).normalize();
            if length < CONVERGED {
                return Some(w);
            }
        }
        None
    }
}

/// Complete homogeneous symmetric polynomial of degree [`DEGREE`] in the linear forms `x . w`, by the coefficients of its
/// monomials in `w`.
fn complete(corners: [DVec3; 3]) -> [f64; TERMS] {
    // Of each degree; one more form adds itself times the polynomial of one degree less.
    let mut h = [[0.0; TERMS]; DEGREE + 1];
    h[0][0] = 1.0;
    for x in corners {
        for k in 1..=DEGREE {
            let (lower, higher) = h.split_at_mut(k);
            let (from, to) = (&lower[k - 1], &mut higher[0]);
            let mut at = 0;
            for rest in 0..k {
                for _ in 0..=rest {
                    to[at] += x.x * from[at];
                    to[at + rest + 1] += x.y * from[at];
                    to[at + rest + 2] += x.z * from[at];
                    at += 1;
                }
            }
        }
    }
    h[DEGREE]
}

/// `count` directions spread evenly over a hemisphere (a spherical Fibonacci lattice).
fn hemisphere(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let z = (i as f64 + 0.5) / count as f64;
        let r = (1.0 - z * z).sqrt();
        let (s, c) = libm::sincos(TAU * (i as f64 * GOLDEN).fract());
        DVec3::new(r * c, r * s, z)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies;
    use crate::shape::moments::Moments;

    fn cube() -> Vec<([DVec3; 3], f64)> {
        let body = bodies::prism(4, 1.0, std::f64::consts::SQRT_2);
        let t = &body.templates[0];
        t.triangles
            .iter()
            .map(|x| (x.vertices.map(|v| t.vertices[v as usize]), 1.0))
            .collect()
    }

    #[test]
    fn a_cube_has_thirteen_axes() {
        let centre = Moments::new(cube().into_iter()).volume_centre;
        let moved = cube().into_iter().map(|(t, s)| (t.map(|p| p - centre), s));
        let f = DirectionalMoment::new(moved);
        let mut axes: Vec<DVec3> = Vec::new();
        for found in f.critical_directions() {
            if axes.iter().all(|a| a.cross(found).length() > 1e-9) {
                axes.push(found);
            }
        }
        for expected in [
            DVec3::Z,
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::new(std::f64::consts::SQRT_2, 0.0, 1.0),
        ] {
            let e = expected.normalize();
            assert!(axes.iter().any(|a| a.cross(e).length() < 1e-9), "{e}");
        }
        assert_eq!(axes.len(), 13);
    }

    #[test]
    fn the_moment_is_that_of_the_directions_it_is_asked_in() {
        let corners = [
            DVec3::new(0.3, -0.2, 0.9),
            DVec3::new(-0.5, 0.4, 0.1),
            DVec3::new(0.2, 0.8, -0.6),
        ];
        let f = DirectionalMoment::new([(corners, 0.0)].into_iter());
        let w = DVec3::new(2.0, -1.0, 3.0).normalize();
        // The same polynomial of three numbers: all products of powers that add up to the degree.
        let [a, b, c] = corners.map(|p| p.dot(w));
        let mut expected = 0.0;
        for i in 0..=DEGREE as i32 {
            for j in 0..=DEGREE as i32 - i {
                expected += a.powi(i) * b.powi(j) * c.powi(DEGREE as i32 - i - j);
            }
        }
        assert!((f.derivatives(w).0 - expected).abs() < 1e-15);
    }
}
