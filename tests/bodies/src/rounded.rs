//! Cubes with rounded edges as facets, as a CAD kernel draws them: the roundings of corners by meridians that meet at poles.

use crate::facets::{Facet, Point};
use std::f64::consts::FRAC_PI_2;

/// The cube `[-1/2, 1/2]^3` with all edges rounded by a radius, over as many chords each, and turned and moved somewhere.
pub fn rounded_cube(radius: f64, chords: u32) -> Vec<Facet> {
    let inner = 0.5 - radius;
    let angle = |i: u32| FRAC_PI_2 * f64::from(i) / f64::from(chords);
    let mut facets = Vec::new();
    let mut quad = |[a, b, c, d]: [Point; 4]| {
        for facet in [[a, b, c], [a, c, d]] {
            if facet[0] != facet[1] && facet[1] != facet[2] && facet[2] != facet[0] {
                facets.push(outward(facet).map(placed));
            }
        }
    };
    for signs in 0..8_u32 {
        let at = |i: u32, j: u32| -> Point {
            // The last meridians end where the axis does, to the last bit.
            let [x, y] = direction(angle(i), i == chords);
            let [r, z] = direction(angle(j), j == chords);
            let unit = [r * x, r * y, z];
            std::array::from_fn(|k| {
                let sign = if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
                sign * (inner + radius * unit[k])
            })
        };
        for i in 0..chords {
            for j in 0..chords {
                quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    let sides = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    for axis in 0..3 {
        let point = |along: f64, [x, y]: [f64; 2]| -> Point {
            let mut point = [along; 3];
            point[(axis + 1) % 3] = x;
            point[(axis + 2) % 3] = y;
            point
        };
        for [x, y] in sides {
            let at = |along: f64, i: u32| {
                let unit = direction(angle(i), i == chords);
                point(
                    along,
                    [
                        x * (inner + radius * unit[0]),
                        y * (inner + radius * unit[1]),
                    ],
                )
            };
            for i in 0..chords {
                quad([
                    at(-inner, i),
                    at(inner, i),
                    at(inner, i + 1),
                    at(-inner, i + 1),
                ]);
            }
        }
        for end in [-0.5, 0.5] {
            quad(sides.map(|side| point(end, side.map(|x| inner * x))));
        }
    }
    facets
}

/// Cosine and sine of an angle between nothing and a right one.
fn direction(angle: f64, is_right: bool) -> [f64; 2] {
    match is_right {
        true => [0.0, 1.0],
        false => [libm::cos(angle), libm::sin(angle)],
    }
}

/// A triangle of something convex around the origin as it is seen from outside.
fn outward([a, b, c]: Facet) -> Facet {
    let [p, q, r] = [a, b, c].map(glam::DVec3::from);
    match (q - p).cross(r - p).dot(p + q + r) > 0.0 {
        true => [a, b, c],
        false => [a, c, b],
    }
}

/// Turned about an axis and moved, so that no coordinate is a round number.
fn placed(point: Point) -> Point {
    let turn = glam::DQuat::from_axis_angle(glam::DVec3::new(0.6, 0.0, 0.8), 0.7);
    let moved = turn * glam::DVec3::from(point) + glam::DVec3::new(1.1, 2.2, -3.3);
    moved.to_array()
}
