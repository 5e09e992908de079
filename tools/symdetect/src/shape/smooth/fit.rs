//! Curvature told by where the vertices around a facet are.
//!
//! Folds tell how a surface bends across them, and nothing of a facet between two sharp edges along these; and they
//! depend on which diagonals were drawn: on a surface that is curved in two directions, and drawn coarsely, every other fold may turn the
//! wrong way. The vertices are on the shape however it was drawn.

use crate::shape::smooth::curvature::outer;
use crate::shape::smooth::facets::{Facets, Fold};
use crate::shape::table::Table;
use crate::threads;
use crate::tolerance::{SINGLE, VANISHING};
use glam::{DMat3, DVec3};

/// What tells of the shape behind facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    /// How they turn at their edges.
    ByFolds,
    /// The places of the vertices around them, too, of facets that may hide as much as this: the shape may be as either tells it.
    ByVertices {
        /// In the units of the shape.
        hiding: f64,
    },
}

impl Told {
    /// Zero, or one.
    pub fn index(self) -> usize {
        usize::from(self != Self::ByFolds)
    }
}

/// Vertices that a quadratic function is fitted to at least, where there are as many: twice as many as it has coefficients.
const ENOUGH: usize = 2 * COEFFICIENTS;

/// Of a quadratic function of two variables.
const COEFFICIENTS: usize = 6;

/// Facets around one that are looked at at most: four rings of triangles have 60. What has more corners is a flat face and no facet.
const AROUND: usize = 60;

/// Corners of a facet at most: kernels draw curved surfaces with triangles and quadrilaterals. What has more is a flat face.
const SIDES: usize = 4;

/// How far the vertices around a facet must reach along its plane, over its size: its own and those close to it tell nothing of how it bends, but how a
/// rounding does that a flat face ends at.
const BEYOND: f64 = 2.0;

/// The largest part of what the fitted function bends by that it may be off the vertices, root mean square. A choice: curvature that changes by
/// more within a few facets is not known.
const OFF: f64 = 0.25;

/// The curvature tensor of each flat as [`super::curvature::curvature`] gives it, by least squares from the vertices around; the one that is
/// `known` where they tell none, or the flat hides less than `hiding`.
pub fn fitted(facets: &Facets<'_>, folds: &[Fold], (known, hiding): (&[DMat3], f64)) -> Vec<DMat3> {
    let both = folds
        .iter()
        .flat_map(|f| [(f.flats[0], f.flats[1]), (f.flats[1], f.flats[0])]);
    let beside = Table::new(facets.flats.count(), both.collect::<Vec<_>>().into_iter());
    let mut normals = vec![DVec3::ZERO; facets.flats.count()];
    for (&flat, &normal) in facets.flats.of.iter().zip(facets.normals) {
        normals[flat as usize] = normal;
    }
    let turning = facets.turning_points();
    let turns = turns_near(folds, facets.flats.count());
    let fit = |flat: usize| {
        let mut around = Around::of_flat(facets, (flat as u32, normals[flat]))?;
        // A chord of that length, and the turns at its ends; twice that, as they may be less there than beyond.
        let is_polygon = turning.of(flat as u32).len() > SIDES;
        if is_polygon || around.size * turns[flat] <= hiding {
            return None;
        }
        around.grow(facets, &beside)?;
        around.curvature()
    };
    let flats: Vec<usize> = (0..known.len()).collect();
    threads::map(&flats, |&flat| fit(flat).unwrap_or(known[flat]))
}

/// Whether a flat has so few corners that it may be one of the facets of a curved surface.
fn is_facet(facets: &Facets<'_>, flat: u32) -> bool {
    facets.flats.corners(flat).len() <= AROUND
}

/// The largest turns at the folds of each flat and of those next to it, radians.
fn turns_near(folds: &[Fold], count: usize) -> Vec<f64> {
    let mut own = vec![0.0_f64; count];
    for fold in folds {
        for flat in fold.flats {
            own[flat as usize] = own[flat as usize].max(fold.turn.abs());
        }
    }
    let mut near = own.clone();
    for fold in folds {
        let largest = fold.flats.map(|flat| own[flat as usize]);
        let largest = largest[0].max(largest[1]);
        for flat in fold.flats {
            near[flat as usize] = near[flat as usize].max(largest);
        }
    }
    near
}

/// The vertices around a flat.
struct Around {
    /// The flat, and those around it.
    flats: Vec<u32>,
    /// Their vertices, each once.
    vertices: Vec<u32>,
    /// Where these are.
    points: Vec<DVec3>,
    /// Middle of the flat.
    middle: DVec3,
    /// Its normal.
    normal: DVec3,
    /// How far its vertices are from the middle at most.
    size: f64,
}

impl Around {
    /// Those of the flat itself, with its normal; `None` if it is no facet.
    fn of_flat(facets: &Facets<'_>, (flat, normal): (u32, DVec3)) -> Option<Self> {
        let vertices = facets.flats.corners(flat).to_vec();
        let points = vertices.iter().map(|v| facets.vertices[*v as usize]);
        let points: Vec<DVec3> = points.collect();
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let mut around = Self {
            flats: vec![flat],
            vertices,
            points,
            middle,
            normal,
            size: 0.0,
        };
        around.size = around.reach();
        is_facet(facets, flat).then_some(around)
    }

    /// How far the vertices are from the middle at most, along the plane of the flat.
    fn reach(&self) -> f64 {
        let distances =
            (self.points.iter()).map(|p| (p - self.middle).reject_from(self.normal).length());
        distances.fold(0.0, f64::max)
    }

    /// As far as smooth edges lead from there, ring by ring, until they are [`ENOUGH`] and reach [`BEYOND`] it; `None` if they never do.
    fn grow(&mut self, facets: &Facets<'_>, beside: &Table) -> Option<()> {
        let mut ring = 0..1;
        while self.points.len() < ENOUGH || self.reach() < BEYOND * self.size {
            if ring.is_empty() || self.flats.len() > AROUND {
                return None;
            }
            let end = self.flats.len();
            for i in ring {
                for &other in beside.of(self.flats[i]).iter().take(AROUND) {
                    if !self.flats.contains(&other) && is_facet(facets, other) {
                        self.flats.push(other);
                        self.vertices.extend(facets.flats.corners(other));
                    }
                }
            }
            self.vertices.sort_unstable();
            self.vertices.dedup();
            let points = self.vertices.iter().map(|v| facets.vertices[*v as usize]);
            self.points.clear();
            self.points.extend(points);
            ring = end..self.flats.len();
        }
        Some(())
    }

    /// Minus the second derivatives of the quadratic function over the plane of the facet that is nearest to the points; `None` if it is
    /// [`OFF`] them. Each of them counts by one over its distance squared, as what a quadratic function leaves grows faster than that.
    fn curvature(&self) -> Option<DMat3> {
        let Self {
            ref points,
            middle,
            normal,
            size,
            ..
        } = *self;
        let x = normal.any_orthonormal_vector();
        let y = normal.cross(x);
        let row = |p: &DVec3| {
            let d = (*p - middle) / size;
            let (u, v) = (d.dot(x), d.dot(y));
            let weight = 1.0 / d.length_squared().max(1.0);
            let all = [0.5 * u * u, u * v, 0.5 * v * v, u, v, 1.0, d.dot(normal)];
            all.map(|c| c * weight)
        };
        let rows: Vec<[f64; COEFFICIENTS + 1]> = points.iter().map(row).collect();
        let solution = least_squares(&rows);
        let of = |row: &[f64; COEFFICIENTS + 1], count: usize| -> f64 {
            (row.iter().zip(&solution).take(count))
                .map(|(r, s)| r * s)
                .sum()
        };
        let square = |x: f64| x * x;
        let bends: f64 = rows.iter().map(|row| square(of(row, 3))).sum();
        let off: f64 = (rows.iter())
            .map(|row| square(of(row, COEFFICIENTS) - row[COEFFICIENTS]))
            .sum();
        let [a, b, c, ..] = solution.map(|s| -s / size);
        let tensor = outer(x, x) * a + (outer(x, y) + outer(y, x)) * b + outer(y, y) * c;
        (off <= OFF * OFF * bends).then_some(tensor)
    }
}

/// The coefficients of these rows that come nearest to their last columns; of second derivatives that make no difference there, none.
fn least_squares(rows: &[[f64; COEFFICIENTS + 1]]) -> [f64; COEFFICIENTS] {
    let mut matrix = [[0.0; COEFFICIENTS + 1]; COEFFICIENTS];
    for row in rows {
        for (i, line) in matrix.iter_mut().enumerate() {
            for (sum, r) in line.iter_mut().zip(row) {
                *sum += row[i] * r;
            }
        }
    }
    let trace: f64 = (0..COEFFICIENTS).map(|i| matrix[i][i]).sum();
    for (i, line) in matrix.iter_mut().enumerate() {
        line[i] += trace * if i < 3 { SINGLE } else { VANISHING };
    }
    // Symmetric and positive definite: no pivots are looked for.
    for i in 0..COEFFICIENTS {
        let pivot = matrix[i];
        for line in &mut matrix[i + 1..] {
            let times = line[i] / pivot[i];
            for (x, p) in line.iter_mut().zip(pivot) {
                *x -= times * p;
            }
        }
    }
    let mut solution = [0.0; COEFFICIENTS];
    for i in (0..COEFFICIENTS).rev() {
        let line = &matrix[i];
        let known: f64 = (i + 1..COEFFICIENTS).map(|k| line[k] * solution[k]).sum();
        solution[i] = (line[COEFFICIENTS] - known) / line[i];
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::measure::double_area_vector;
    use std::f64::consts::TAU;

    fn curvature(points: Vec<DVec3>, own: &[DVec3], normal: DVec3) -> Option<DMat3> {
        let middle = own.iter().sum::<DVec3>() / own.len() as f64;
        let distances = own.iter().map(|p| p.distance(middle));
        let around = Around {
            flats: Vec::new(),
            vertices: Vec::new(),
            points,
            middle,
            normal,
            size: distances.fold(0.0, f64::max),
        };
        around.curvature()
    }

    #[test]
    fn quadratic_functions_are_found() {
        let at = |i: i32| {
            let (u, v) = (f64::from(i % 4), f64::from(i / 4));
            DVec3::new(u, v, 0.3 * u * u - 0.1 * u * v - 0.2 * v * v + 0.5 * u)
        };
        let points = (0..16).map(at).collect();
        let found = curvature(points, &[0, 1, 4].map(at), DVec3::Z).unwrap();
        let bends = |d: DVec3| d.dot(found * d);
        assert!((bends(DVec3::X) + 0.6).abs() < 1e-3, "{found}");
        assert!((bends(DVec3::Y) - 0.4).abs() < 1e-3, "{found}");
        assert!((bends(DVec3::X + DVec3::Y)).abs() < 1e-3, "{found}");
    }

    #[test]
    fn what_two_rows_of_vertices_do_not_tell_is_none() {
        // A strip of a cylinder along y.
        let at = |i: i32| {
            let (s, c) = libm::sincos(0.2 * f64::from(i.div_euclid(2)) - 0.1);
            DVec3::new(s, f64::from(i.rem_euclid(2)), c)
        };
        let found = curvature((-6..10).map(at).collect(), &[0, 1, 2, 3].map(at), DVec3::Z);
        let found = found.unwrap();
        assert!(DVec3::Y.dot(found * DVec3::Y).abs() < 1e-3, "{found}");
        assert!(
            (DVec3::X.dot(found * DVec3::X) - 1.0).abs() < 0.15,
            "{found}"
        );
    }

    /// The curvature of a face with so many corners, and rings of facets around it, each given by its radius and its height.
    fn in_the_middle(sides: u32, rings: &[(f64, f64)]) -> DMat3 {
        let ring = |&(r, z): &(f64, f64)| {
            (0..sides).map(move |i| {
                let (s, c) = libm::sincos(TAU / f64::from(sides) * f64::from(i));
                DVec3::new(r * c, r * s, z)
            })
        };
        let vertices: Vec<DVec3> = rings.iter().flat_map(ring).collect();
        let fan = (1..sides - 1).map(|i| [0, i, i + 1]);
        let between = |k: u32| {
            let [low, high] = [sides * k, sides * (k + 1)];
            (0..sides).flat_map(move |i| {
                let next = (i + 1) % sides;
                let [a, b, c, d] = [low + i, low + next, high + next, high + i];
                [[a, c, b], [a, d, c]]
            })
        };
        let triangles: Vec<[u32; 3]> = fan
            .chain((0..rings.len() as u32 - 1).flat_map(between))
            .collect();
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            double_area_vector(a, b, c).normalize()
        };
        let normals: Vec<DVec3> = triangles.iter().map(normal).collect();
        let facets = Facets::new(&vertices, &triangles, &normals);
        let known = vec![DMat3::ZERO; facets.flats.count()];
        fitted(&facets, &facets.folds(), (&known, 1e-3))[facets.flats.of[0] as usize]
    }

    #[test]
    fn a_face_with_a_rounding_around_it_is_no_dome() {
        let rounding = [(1.0, 0.0), (1.05, -0.013), (1.087, -0.05), (1.1, -0.1)];
        for (depth, sides) in [(0.3, 8), (1.0, 8), (3.0, 8), (0.3, 4), (1.0, 4), (3.0, 4)] {
            let wall = [(1.1, -0.1 - depth)];
            let found = in_the_middle(sides, &[&rounding[..], &wall].concat());
            assert_eq!(found, DMat3::ZERO, "{depth} {sides}");
            let hollow = [
                (1.113, -0.15 - depth),
                (1.15, -0.187 - depth),
                (1.2, -0.2 - depth),
            ];
            let floor = [(2.5, -0.2 - depth)];
            let step = [&rounding[..], &wall, &hollow, &floor].concat();
            assert_eq!(in_the_middle(sides, &step), DMat3::ZERO, "{depth} {sides}");
        }
        // And the cap of a sphere is one.
        let cap = [0.1_f64, 0.3, 0.5, 0.7].map(|angle| (angle.sin(), angle.cos()));
        let found = in_the_middle(4, &cap);
        assert!(
            (found.x_axis.x - 1.0).abs() < 0.1 && (found.y_axis.y - 1.0).abs() < 0.1,
            "{found}"
        );
    }
}
