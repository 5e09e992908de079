//! Moments of high degree in every direction, whose critical points are where symmetry axes can lie.

use crate::tolerance::VANISHING;
use geom::eigen;
use geom::measure::double_area_vector;
use glam::{DMat3, DVec3};

/// Starts of the search for critical points: a function of degree eight has less than a hundred of them up to sign, and
/// the basins of all of them must be met.
const STARTS: usize = 400;
/// Newton steps after which a start is given up: within its basin, half a dozen suffice.
const STEPS: usize = 40;
/// Length of a step, in radians, after which there is nothing to gain: what double precision leaves of the gradient of
/// a polynomial of degree eight. With ten times as much, points along curves of nearly critical points pass as well,
/// each of which costs a search about it.
const CONVERGED: f64 = 1e-13;
/// Largest step, in radians: a fraction of the distance between neighbouring critical points.
const LONGEST_STEP: f64 = 0.15;

/// Degree of the directional moment: high enough to tell the axes of every polyhedral group.
const DEGREE: usize = 8;
/// Monomials of that degree.
const TERMS: usize = (DEGREE + 1) * (DEGREE + 2) / 2;

/// The function `f(w) = integral of (x . w)^8` over the surface plus the volume, `|w| = 1`, each
/// divided by its total.
///
/// Every symmetry axis of the body, and every normal of a mirror plane, is a critical point of it,
/// because the gradient there is a tangent vector that some half turn or rotation about the
/// direction preserves. This is the generalized moment of Martinet et al., "Accurate detection of
/// symmetries in 3D shapes" (ACM TOG 2006), with the power of the distance to a plane in place of
/// the distance to a line; both span the even spherical harmonics up to the degree.
pub struct DirectionalMoment {
    coefficients: [f64; TERMS],
}

/// Exponents of the monomials, in a fixed order.
fn exponents() -> impl Iterator<Item = [usize; 3]> {
    (0..=DEGREE).flat_map(|i| (0..=DEGREE - i).map(move |j| [i, j, DEGREE - i - j]))
}

impl DirectionalMoment {
    /// Integrates over triangles as [`Moments::new`] does; coordinates are relative to the centre.
    pub fn new(triangles: impl Iterator<Item = ([DVec3; 3], f64)>) -> Self {
        // The integral of a power of a linear form over a simplex is, up to a constant, the complete
        // homogeneous polynomial of its values at the corners; polarized to monomials by evaluating
        // it in as many directions as there are monomials and more.
        let directions: Vec<DVec3> = hemisphere(3 * TERMS / 2).collect();
        let mut area = vec![0.0; directions.len()];
        let mut volume = vec![0.0; directions.len()];
        let (mut total_area, mut total_volume) = (0.0_f64, 0.0_f64);
        for ([a, b, c], sign) in triangles {
            let s = double_area_vector(a, b, c).length();
            let v = sign * a.dot(b.cross(c));
            total_area += s;
            total_volume += v;
            for (i, w) in directions.iter().enumerate() {
                let h = complete(a.dot(*w), b.dot(*w), c.dot(*w));
                area[i] += s * h;
                volume[i] += v * h;
            }
        }
        let scale_area = if total_area > 0.0 {
            1.0 / total_area
        } else {
            0.0
        };
        let scale_volume = if total_volume > VANISHING * total_area {
            1.0 / total_volume
        } else {
            0.0
        };
        let values: Vec<f64> = area
            .iter()
            .zip(&volume)
            .map(|(a, v)| a * scale_area + v * scale_volume)
            .collect();
        Self {
            coefficients: fit(&directions, &values),
        }
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
    /// method from an even spread of starts. Where they form a curve (a body of revolution), some
    /// points of the curve.
    pub fn critical_directions(&self) -> Vec<DVec3> {
        hemisphere(STARTS)
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

/// Complete homogeneous symmetric polynomial of degree [`DEGREE`] in three variables.
fn complete(u: f64, v: f64, w: f64) -> f64 {
    let mut h = [0.0; DEGREE + 1];
    h[0] = 1.0;
    for x in [u, v, w] {
        for k in 1..=DEGREE {
            h[k] += x * h[k - 1];
        }
    }
    h[DEGREE]
}

/// `count` directions spread evenly over a hemisphere (a spherical Fibonacci lattice).
fn hemisphere(count: usize) -> impl Iterator<Item = DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |i| {
        let z = (i as f64 + 0.5) / count as f64;
        let r = (1.0 - z * z).sqrt();
        let (s, c) = libm::sincos(golden * i as f64 + 0.1);
        // Tilted, so that no start sits on a coordinate axis by construction.
        DVec3::new(r * c, 0.8 * r * s - 0.6 * z, 0.6 * r * s + 0.8 * z)
    })
}

/// Least-squares coefficients of a homogeneous polynomial from its values in given directions.
fn fit(directions: &[DVec3], values: &[f64]) -> [f64; TERMS] {
    let rows: Vec<[f64; TERMS]> = directions
        .iter()
        .map(|w| {
            let mut row = [0.0; TERMS];
            for (x, e) in row.iter_mut().zip(exponents()) {
                *x = libm::pow(w.x, e[0] as f64)
                    * libm::pow(w.y, e[1] as f64)
                    * libm::pow(w.z, e[2] as f64);
            }
            row
        })
        .collect();
    orthogonal_solve(rows, values)
}

/// Least squares by modified Gram-Schmidt.
fn orthogonal_solve(mut rows: Vec<[f64; TERMS]>, values: &[f64]) -> [f64; TERMS] {
    let mut rhs = values.to_vec();
    let mut r = vec![[0.0; TERMS]; TERMS];
    let mut projected = [0.0; TERMS];
    for j in 0..TERMS {
        let norm = rows.iter().map(|row| row[j] * row[j]).sum::<f64>().sqrt();
        r[j][j] = norm;
        for row in &mut rows {
            row[j] /= norm;
        }
        for k in j + 1..TERMS {
            let dot: f64 = rows.iter().map(|row| row[j] * row[k]).sum();
            r[j][k] = dot;
            for row in &mut rows {
                row[k] -= dot * row[j];
            }
        }
        projected[j] = rows.iter().zip(&rhs).map(|(row, y)| row[j] * y).sum();
        for (row, y) in rows.iter().zip(&mut rhs) {
            *y -= projected[j] * row[j];
        }
    }
    let mut x = [0.0; TERMS];
    for j in (0..TERMS).rev() {
        let known: f64 = (j + 1..TERMS).map(|k| r[j][k] * x[k]).sum();
        x[j] = (projected[j] - known) / r[j][j];
    }
    x
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
}
