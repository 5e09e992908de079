//! Groups with their frames and what their generators do to regions, on bodies with operations that turn the axis over.

use crate::bodies::{self, Cells};
use crate::shape::Random;
use crate::{Params, detect};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tmesh::{Document, OUTSIDE, Symmetry};

/// A body about z, with its group's symbol, whose x axis is that of the group's canonical frame.
struct Case {
    symbol: &'static str,
    body: Document,
    /// Half the angle between directions that x may as well have; `None` where it is free.
    reference: Option<f64>,
}

fn on_circle(r: f64, angle: f64, z: f64) -> DVec3 {
    DVec3::new(r * angle.cos(), r * angle.sin(), z)
}

/// Levels from -1 to 1, symmetric about 0.
fn levels(count: i32) -> Vec<f64> {
    (-count..=count)
        .map(|i| f64::from(i) / f64::from(count))
        .collect()
}

/// A region for each half.
fn halves(_: usize, layer: usize, layers: usize) -> u32 {
    if 2 * layer < layers { 4 } else { 9 }
}

/// A region for each half of each fifth of the turn.
fn parts(sector: usize, layer: usize, layers: usize) -> u32 {
    (sector / 8) as u32 + if 2 * layer < layers { 1 } else { 20 }
}

/// A rectangular bar, twisted by a third of a turn from end to end.
fn bar() -> Document {
    let cells = Cells {
        sectors: 24,
        levels: levels(6),
        place: |i, z| {
            let a = TAU * (i as f64 + 0.5) / 24.0;
            let reach = (0.5 / a.cos().abs()).min(0.2 / a.sin().abs());
            on_circle(reach, a + PI / 3.0 * z, z)
        },
    };
    cells.document(halves)
}

/// Sixteen trapezoidal teeth along a helix.
fn gear() -> Document {
    let cells = Cells {
        sectors: 64,
        levels: levels(4),
        place: |i, z| {
            let r = if i % 4 < 2 { 1.0 } else { 0.88 };
            on_circle(r, TAU * (i as f64 - 0.5) / 64.0 + 0.15 * z, 0.2 * z)
        },
    };
    cells.document(halves)
}

/// Two heptagons, turned by half a step against each other; x between two of their corners is a mirror.
fn antiprism() -> Document {
    let cells = Cells {
        sectors: 14,
        levels: vec![-1.0, 0.0, 1.0],
        place: |i, z| {
            let corner = (i % 2 == 0) == (z > 0.0);
            let r = if corner || z == 0.0 {
                1.0
            } else {
                (PI / 7.0).cos()
            };
            on_circle(
                r * if z == 0.0 { 0.9 } else { 1.0 },
                TAU * i as f64 / 14.0,
                0.5 * z,
            )
        },
    };
    cells.document(halves)
}

/// Lobes that lean one way above and the other below, turned by half a step.
fn rotary() -> Document {
    let cells = Cells {
        sectors: 64,
        levels: levels(4),
        place: |i, z| {
            let a = TAU * i as f64 / 64.0;
            let wave = z * (4.0 * a).cos() + z * z * z * (4.0 * a).sin();
            on_circle(0.9 + 0.08 * wave, a, 0.6 * z)
        },
    };
    cells.document(halves)
}

/// A saw blade of five teeth.
fn saw() -> Document {
    let cells = Cells {
        sectors: 40,
        levels: levels(2),
        place: |i, z| on_circle(0.8 + 0.02 * (i % 8) as f64, TAU * i as f64 / 40.0, 0.3 * z),
    };
    cells.document(parts)
}

/// Bodies whose regions every generator permutes in some way.
fn cases() -> Vec<Case> {
    let case = |symbol, body, reference| Case {
        symbol,
        body,
        reference,
    };
    vec![
        case("D2", bar(), Some(PI / 4.0)),
        case("D16", gear(), Some(PI / 32.0)),
        case("D7d", antiprism(), Some(PI / 14.0)),
        case("S8", rotary(), None),
        case("C5h", saw(), None),
    ]
}

/// What an operation does to the regions of a body, from the middles of the surface's triangles.
fn regions_moved(body: &Document, operation: impl Fn(DVec3) -> DVec3) -> Vec<[u32; 2]> {
    let template = &body.templates[0];
    let middle = |t: &tmesh::Triangle| {
        t.vertices
            .iter()
            .map(|&v| template.vertices[v as usize])
            .sum::<DVec3>()
            / 3.0
    };
    let outer = || (template.triangles.iter()).filter(|t| t.front == OUTSIDE);
    let mut moved: Vec<[u32; 2]> = outer()
        .map(|t| {
            let image = operation(middle(t));
            let distance = |u: &&tmesh::Triangle| middle(u).distance_squared(image);
            let there = outer().min_by(|u, v| distance(u).total_cmp(&distance(v)));
            [t.back, there.unwrap().back]
        })
        .filter(|[a, b]| a != b)
        .collect();
    moved.sort_unstable();
    moved.dedup();
    moved
}

/// Asserts that the frame found is one of those that the group has, given how the body was placed.
fn assert_frame(case: &Case, found: &Symmetry, place: impl Fn(DVec3) -> DVec3, scale: f64) {
    let frame = found.frame().unwrap();
    let [centre, z, x] = [DVec3::ZERO, DVec3::Z, DVec3::X].map(&place);
    let (z, x) = ((z - centre) / scale, (x - centre) / scale);
    let near = 1e-5;
    let symbol = case.symbol;
    assert!((frame.origin - centre).length() < near * scale, "{symbol}");
    if symbol == "D2" {
        // Any of three axes may be the main one.
        for found in [frame.rotation.z_axis, frame.rotation.x_axis] {
            let along = [x, z, z.cross(x)].map(|e| found.cross(e).length() < near);
            assert!(along.contains(&true), "{symbol}: {found}");
        }
        return;
    }
    assert!(frame.rotation.z_axis.cross(z).length() < near, "{symbol}");
    if let Some(half) = case.reference {
        let y = z.cross(x);
        let angle = frame
            .rotation
            .x_axis
            .dot(y)
            .atan2(frame.rotation.x_axis.dot(x));
        let steps = angle / (2.0 * half);
        assert!(
            (steps - steps.round()).abs() * half < near,
            "{symbol}: {angle}"
        );
    }
}

#[test]
fn operations_that_turn_the_axis_over_have_their_frame_and_regions() {
    let mut random = Random(21);
    for case in cases() {
        for (round, noise) in [0.0, 1e-6, 1e-6].into_iter().enumerate() {
            let scale = [1.0, 1e-3, 40.0][round];
            let state = random.clone();
            let placed = bodies::place(&case.body, &mut random, scale, noise);
            let place = bodies::placement(&mut state.clone(), scale);
            let detection = detect(&placed, None, &Params::default(), &mut |_| ()).unwrap();
            let found = detection.symmetry;
            assert_eq!(found.group.symbol(), case.symbol);
            assert!(found.residual < 10.0 * noise + 4e-6, "{}", found.residual);
            assert_frame(&case, &found, place, scale);
            // Some generator permutes regions, and each as the body itself says.
            let generators = found.group.generators();
            assert_eq!(found.regions.len(), generators.len(), "{}", case.symbol);
            let frame = found.frame().unwrap();
            for (generator, map) in generators.into_iter().zip(&found.regions) {
                let moved = |p| frame.to_world(generator.apply(frame.to_canonical(p)));
                assert_eq!(map.pairs, regions_moved(&placed, moved), "{}", case.symbol);
            }
        }
    }
}

#[test]
fn the_centre_stays_under_what_turns_the_axis_over() {
    let mut random = Random(22);
    for case in cases() {
        let placed = bodies::place(&case.body, &mut random, 1.0, 1e-6);
        let found = detect(&placed, None, &Params::default(), &mut |_| ()).unwrap();
        let frame = found.symmetry.frame().unwrap();
        let over = found.symmetry.group.turning_over().unwrap();
        // The highest points go to the lowest, at equal distances from the centre.
        let heights = placed.templates[0].vertices.iter();
        let heights = heights.map(|p| frame.to_canonical(*p).z);
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(l, h), z| (l.min(z), h.max(z)));
        assert!((low + high).abs() < 1e-5, "{}", case.symbol);
        assert_eq!(over.apply(DVec3::ZERO), DVec3::ZERO);
    }
}

#[test]
fn a_group_that_loses_its_half_turns_is_not_taken_for_the_whole() {
    // Wider at one end: nothing turns it over.
    let mut random = Random(23);
    for case in cases().into_iter().take(2) {
        let mut body = case.body.clone();
        for p in &mut body.templates[0].vertices {
            *p *= 1.0 + 0.05 * p.z;
        }
        let placed = bodies::place(&body, &mut random, 1.0, 1e-6);
        let found = detect(&placed, None, &Params::default(), &mut |_| ()).unwrap();
        assert_eq!(found.symmetry.group.symbol(), case.symbol.replace('D', "C"));
        assert!(found.symmetry.group.turning_over().is_none());
    }
}

/// A column of lobes of a few facets each, none of them a mirror image, twisted, between flat ends.
fn lobed_column(lobes: u32, facets: u32) -> Document {
    let n = lobes * facets;
    let mut vertices: Vec<DVec3> = (levels(1).into_iter())
        .flat_map(|z| {
            (0..n).map(move |i| {
                let a = TAU * f64::from(i) / f64::from(n);
                let phase = f64::from(lobes) * a;
                let r = 1.0 + 0.01 * phase.sin() + 0.005 * (2.0 * phase + 1.0).sin();
                on_circle(r, a + 0.05 * z, z)
            })
        })
        .collect();
    let ends = vertices.len() as u32;
    vertices.extend([DVec3::NEG_Z, DVec3::Z]);
    let mut triangles = Vec::new();
    for i in 0..n {
        let next = (i + 1) % n;
        for ring in [0, n] {
            let [p, q] = [ring + i, ring + next];
            triangles.extend([[p, q, q + n], [p, q + n, p + n]]);
        }
        triangles.extend([[ends, next, i], [ends + 1, 2 * n + i, 2 * n + next]]);
    }
    bodies::document(vertices, triangles)
}

#[test]
fn facets_too_coarse_to_tell_leave_the_group_of_the_drawing() {
    for (lobes, facets) in [(6, 3), (6, 4), (7, 3), (7, 4), (8, 3)] {
        let body = lobed_column(lobes, facets);
        let found = detect(&body, None, &Params::default(), &mut |_| ()).unwrap();
        let symmetry = found.symmetry;
        assert_eq!(symmetry.group.order, lobes);
        assert!(symmetry.residual < 1e-3, "{}", symmetry.residual);
    }
}
