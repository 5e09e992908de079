//! Detection on made bodies.

use crate::bodies::{self, Kind};
use crate::shape::Random;
use crate::{Error, Params, detect};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tmesh::{Axis, Document, Isometry, OtherAxis, Template};

/// What was found, spelled out.
#[derive(Debug, PartialEq)]
struct Symmetry {
    group: String,
    order: u32,
    mirror: bool,
    axis: Axis,
    mirror_direction: [f64; 3],
    residual: f64,
    axisymmetric: bool,
    other_axes: Vec<OtherAxis>,
    rotation_regions: Vec<[u32; 2]>,
    mirror_regions: Vec<[u32; 2]>,
}

impl From<crate::Detection> for Symmetry {
    fn from(found: crate::Detection) -> Self {
        let symmetry = found.symmetry;
        Self {
            group: symmetry.group.symbol(),
            order: symmetry.group.order,
            mirror: symmetry.group.has_vertical_mirrors(),
            rotation_regions: symmetry.rotation_regions().pairs,
            mirror_regions: symmetry.region_map(Isometry::MIRROR).pairs,
            axis: symmetry.axis,
            mirror_direction: symmetry.reference,
            residual: symmetry.residual,
            axisymmetric: symmetry.axisymmetric,
            other_axes: found.search.other_axes,
        }
    }
}

fn find(body: &Document) -> Symmetry {
    find_with(body, &Params::default()).unwrap()
}

fn find_with(body: &Document, params: &Params) -> Result<Symmetry, Error> {
    detect(body, None, params, &mut |_| ()).map(Symmetry::from)
}

#[test]
fn every_kind_of_group_anywhere_at_any_scale() {
    let mut random = Random(1);
    for (i, kind) in Kind::ALL.into_iter().enumerate() {
        for n in [2, 3, 14] {
            let body = kind.body(n, 6, (0.5 / f64::from(n)).min(0.15));
            let scale = [1.0, 1e-6, 1e6][(i + n as usize) % 3];
            let found = find(&bodies::place(&body, &mut random, scale, 0.0));
            assert_eq!(found.group, kind.symbol(n));
            assert!(found.residual < 2e-6, "{} {}", found.group, found.residual);
        }
    }
}

#[test]
fn noise_and_tessellation_do_not_matter() {
    let mut random = Random(2);
    for (kind, n) in [
        (Kind::Cn, 5),
        (Kind::Dnh, 16),
        (Kind::Dn, 3),
        (Kind::Cnv, 12),
    ] {
        for noise in [1e-7, 1e-5, 1e-4] {
            let body = kind.body(n, 8, 0.5 / f64::from(n));
            let body = bodies::split_faces(&body, &mut random, 0.4);
            let found = find(&bodies::place(&body, &mut random, 1.0, noise));
            assert_eq!(found.group, kind.symbol(n), "noise {noise}");
            assert!(found.residual < 6.0 * noise + 1e-6);
        }
    }
}

#[test]
fn chords_that_do_not_share_the_symmetry_do_not_hide_it() {
    // Six lobes drawn with 200 facets around.
    let wave = |a: f64, r: f64, z: f64| (r * (1.0 + 0.1 * (6.0 * a).cos()), z);
    let body = bodies::profile(200, &[(0.9, 0.0), (0.9, 0.5)], wave);
    let found = find(&body);
    assert_eq!((found.order, found.mirror), (6, true));
    assert!((1e-5..1e-3).contains(&found.residual));
    assert!(!found.axisymmetric);
}

#[test]
fn the_axis_is_as_exact_as_the_data() {
    let mut random = Random(3);
    for kind in [Kind::Cn, Kind::Dnd] {
        let body = kind.body(7, 6, 0.1);
        let placed = bodies::place(&body, &mut random, 1.0, 0.0);
        let found = find(&placed);
        // The two rings' centres, from the vertices themselves.
        let v = &placed.templates[0].vertices;
        let ring = |row: usize| v[row * 42..(row + 1) * 42].iter().sum::<DVec3>() / 42.0;
        let axis = (ring(8) - ring(0)).normalize();
        let direction = DVec3::from_array(found.axis.direction);
        assert!(axis.cross(direction).length() < 2e-7);
        let off = DVec3::from_array(found.axis.point) - ring(0);
        assert!((off - axis * off.dot(axis)).length() < 2e-7);
        let x = DVec3::from_array(found.mirror_direction);
        assert!((x.length() - 1.0).abs() < 1e-12 && x.dot(direction).abs() < 1e-12);
    }
}

#[test]
fn facetted_bodies_of_revolution_report_their_facets() {
    let mut random = Random(4);
    for n in [45, 53, 87, 128] {
        let rows = [(0.4, 0.0), (1.0, 0.2), (0.7, 0.9)];
        let body = bodies::profile(n, &rows, |_, r, z| (r, z));
        for noise in [0.0, 2e-6] {
            let found = find(&bodies::place(&body, &mut random, 1.0, noise));
            assert_eq!(found.group, format!("C{n}v"));
            assert!(found.axisymmetric, "{n}");
        }
    }
    let nut = find(&bodies::prism(6, 1.0, 0.4));
    assert_eq!((nut.group.as_str(), nut.axisymmetric), ("D6h", false));
}

#[test]
fn nearly_symmetric_bodies_are_not_over_read() {
    let mut random = Random(5);
    let rows: Vec<(f64, f64)> = (0..=6).map(|i| (0.9, 0.1 * f64::from(i))).collect();
    let lobes = |a: f64| 0.05 * (12.0 * a).cos();
    let turn = std::f64::consts::TAU;
    type Shape = Box<dyn Fn(f64, f64, f64) -> (f64, f64)>;
    let cases: [(&str, Shape, Option<&str>); 5] = [
        // A keyway: one facet set in.
        (
            "keyway",
            Box::new(move |a, r, z| {
                let depth = if a < 0.5 / 96.0 * turn || a > 95.5 / 96.0 * turn {
                    6e-3
                } else {
                    0.0
                };
                (r + lobes(a) - depth, z)
            }),
            Some("D1h"),
        ),
        (
            "oval",
            Box::new(move |a, r, z| (r + lobes(a) + 5e-3 * (2.0 * a).cos(), z)),
            Some("D2h"),
        ),
        // A thread: it turns about an axis across it, but the lobes do not.
        (
            "thread",
            Box::new(move |a, r, z| (r + lobes(a) + 5e-3 * (a - 10.0 * z).cos(), z)),
            None,
        ),
        // A keyway hardly deeper than the tolerance.
        (
            "groove",
            Box::new(move |a, r, z| {
                let inside = a < 0.5 / 96.0 * turn || a > 95.5 / 96.0 * turn;
                (r + lobes(a) - if inside { 1.6e-3 } else { 0.0 }, z)
            }),
            Some("D1h"),
        ),
        // A dent anywhere.
        (
            "dent",
            Box::new(move |a, r, z| {
                let near = (a - 1.0).abs() < 0.05 && (z - 0.2).abs() < 0.05;
                (r + lobes(a) - if near { 4e-3 } else { 0.0 }, z)
            }),
            None,
        ),
    ];
    for (name, shape, expected) in cases {
        let body = bodies::profile(96, &rows, shape);
        let found = find_with(
            &bodies::place(&body, &mut random, 1.0, 0.0),
            &Params::default(),
        );
        match (expected, found) {
            // One keyway: two mirror planes that meet in an axis across the part.
            (Some("D1h"), Ok(s)) => assert_eq!(s.group, "C2v", "{name}"),
            (Some(group), Ok(s)) => assert_eq!(s.group, group, "{name}"),
            (None, Err(Error::Asymmetric { .. })) => {}
            (e, f) => panic!("{name}: expected {e:?}, found {f:?}"),
        }
    }
}

/// What is wrong with the bore of a [`wheel`].
#[derive(Clone, Copy, Debug, PartialEq)]
enum Flaw {
    None,
    /// Half the difference of the diameters.
    Oval(f64),
    /// Half the largest deviation.
    Eccentric(f64),
    /// Depth of a groove, one in fifteen of the turn wide.
    Groove(f64),
    /// Depth of a dent as long as wide.
    Dent(f64),
    /// Depth of a groove in the outside.
    Keyway(f64),
    /// How much lower one lobe is than the others.
    Lobe(f64),
}

/// A wheel of `n` lobes, `per_lobe` facets each, around a cavity of the given radius with `facets`
/// facets around that start at `phase`.
fn wheel(
    n: usize,
    per_lobe: usize,
    radius: f64,
    facets: usize,
    phase: f64,
    flaw: Flaw,
) -> Document {
    let n_f = n as f64;
    let lobed = move |a: f64, r: f64, z: f64| {
        let missing = match flaw {
            Flaw::Keyway(depth) if (a - 1.0).abs() < 0.21 => depth,
            Flaw::Lobe(by) if a * n_f < TAU => by * (0.5 - 0.5 * (n_f * a).cos()),
            _ => 0.0,
        };
        (r * (1.0 + 0.04 * (n_f * a).cos()) - missing, z)
    };
    let mut body = bodies::profile(n * per_lobe, &[(0.96, 0.0), (0.96, 0.4)], lobed);
    let rows: Vec<(f64, f64)> = (0..=4)
        .map(|i| (radius, 0.1 + 0.05 * f64::from(i)))
        .collect();
    let mut bore = bodies::profile(facets, &rows, |a, r, z| {
        let near = (a - 1.0).abs() < 0.21;
        let change = match flaw {
            Flaw::Oval(by) => by * (2.0 * (a + phase)).cos(),
            Flaw::Eccentric(by) => by * (a + phase).cos(),
            Flaw::Groove(depth) if near => depth,
            Flaw::Dent(depth) if near && (z - 0.2).abs() < 0.06 => depth,
            _ => 0.0,
        };
        (r + change, z)
    });
    let turned = glam::DMat3::from_rotation_z(phase);
    // A void: its surface the other way around.
    let (outer, inner) = (&mut body.templates[0], &mut bore.templates[0]);
    let first = outer.vertices.len() as u32;
    outer
        .vertices
        .extend(inner.vertices.iter().map(|p| turned * *p));
    outer.triangles.extend(inner.triangles.iter().map(|t| {
        let [a, b, c] = t.vertices.map(|v| v + first);
        tmesh::Triangle {
            vertices: [a, c, b],
            ..*t
        }
    }));
    body
}

#[test]
fn facets_explain_a_bore_but_not_a_groove() {
    // A bore of 40 facets: twice the tolerance off, all around.
    let found = find(&wheel(13, 12, 0.7, 40, 0.0, Flaw::None));
    assert_eq!((found.order, found.mirror), (13, true));
    assert!(
        (1e-3..2.9e-3).contains(&found.residual),
        "{}",
        found.residual
    );
    // Facets of the bore share two of the six turns: that does not hide the others.
    let found = find(&wheel(6, 12, 0.5, 32, 0.0, Flaw::None));
    assert_eq!((found.order, found.mirror), (6, true));
    // Nothing is left but the mirror across the axis, if that.
    let flawed = find(&wheel(13, 12, 0.7, 40, 0.0, Flaw::Groove(5e-3)));
    assert!(flawed.order <= 2);
}

/// A body of revolution whose rings have corners at angles of their own, in parts of a turn; from the bottom up.
fn rings(rings: &[(f64, f64, Vec<f64>)]) -> Document {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    let mut below: Option<(usize, &[f64])> = None;
    for (r, z, angles) in rings {
        let first = vertices.len();
        vertices.extend(angles.iter().map(|a| {
            let (s, c) = libm::sincos(TAU * a);
            DVec3::new(r * c, r * s, *z)
        }));
        if let Some((lower, old)) = below {
            // The corner that comes next around, of either ring, ends the next triangle.
            let (mut i, mut j) = (0, 0);
            let at =
                |angles: &[f64], i: usize| angles[i % angles.len()] + (i / angles.len()) as f64;
            while i < old.len() || j < angles.len() {
                let [a, b] = [i, i + 1].map(|i| (lower + i % old.len()) as u32);
                let [c, d] = [j, j + 1].map(|j| (first + j % angles.len()) as u32);
                if j >= angles.len() || i < old.len() && at(old, i + 1) <= at(angles, j + 1) {
                    triangles.push([a, b, c]);
                    i += 1;
                } else {
                    triangles.push([a, d, c]);
                    j += 1;
                }
            }
        }
        below = Some((first, angles));
    }
    let (_, _, bottom) = &rings[0];
    let (_, _, top) = &rings[rings.len() - 1];
    let last = vertices.len() - top.len();
    triangles.extend((1..bottom.len() as u32 - 1).map(|i| [0, i + 1, i]));
    triangles.extend((1..top.len() as u32 - 1).map(|i| [0, i, i + 1].map(|i| last as u32 + i)));
    bodies::document(vertices, triangles)
}

fn evenly(count: u32) -> Vec<f64> {
    (0..count)
        .map(|i| f64::from(i) / f64::from(count))
        .collect()
}

/// Bottles were refused whose shoulder the CAD kernel had drawn with seven facets around, and the neck with twenty-six.
#[test]
fn a_shoulder_drawn_more_coarsely_than_the_neck_is_round() {
    let mut random = Random(15);
    // Six and a half of them.
    let coarse: Vec<f64> = (0..7).map(|i| f64::from(i) / 6.5).collect();
    let mut profile = vec![(1.0, -2.0, evenly(26)), (1.0, 1.0, evenly(26))];
    for angle in [20.0_f64, 40.0, 60.0, 80.0] {
        let (s, c) = libm::sincos(angle.to_radians());
        profile.push((0.4 + 0.6 * c, 1.0 + 0.6 * s, coarse.clone()));
    }
    profile.extend([(0.4, 1.6, evenly(26)), (0.4, 2.0, evenly(26))]);
    for _ in 0..3 {
        let found = find(&bodies::place(&rings(&profile), &mut random, 1.0, 0.0));
        assert!(found.axisymmetric && found.mirror, "{found:?}");
    }
}

/// The axis of such a body must be known better than its facets tell, which hide fifty times the tolerance.
#[test]
fn few_facets_at_any_angles_are_round() {
    let mut random = Random(17);
    for (rim, neck) in [(27, 13), (13, 14), (14, 17), (26, 19)] {
        let mut turned = |count: u32| {
            let phase = random.unit() / f64::from(count);
            let angles = evenly(count).into_iter();
            angles.map(|a| a + phase).collect::<Vec<f64>>()
        };
        let profile = [
            (1.0, 0.0, turned(rim)),
            (1.0, 2.0, turned(rim)),
            (0.92, 2.4, turned(neck)),
            (0.73, 2.7, turned(neck)),
            (0.33, 3.0, turned(neck)),
            (0.33, 3.7, turned(neck)),
        ];
        for seed in 0..4 {
            let body = bodies::place(&rings(&profile), &mut Random(seed), 1.0, 0.0);
            let found = find(&body);
            assert!(found.axisymmetric && found.mirror, "{rim} {neck} {found:?}");
        }
    }
}

/// Nor are a flat along a shaft, and six or eight sides of a neck that is meant to have them.
#[test]
fn flats_along_a_round_shaft_are_no_facets() {
    let mut random = Random(16);
    let mut flat = evenly(40);
    flat.retain(|a| (0.3..=1.0).contains(a) || *a == 0.0);
    let shaft = [(1.0, 0.0, flat.clone()), (1.0, 3.0, flat)];
    let found = find(&bodies::place(&rings(&shaft), &mut random, 1.0, 0.0));
    assert!(found.order <= 2 && !found.axisymmetric, "{found:?}");
    for sides in [6, 8] {
        let neck = [
            (1.0, 0.0, evenly(26)),
            (1.0, 1.0, evenly(26)),
            (0.6, 1.0, evenly(sides)),
            (0.6, 2.0, evenly(sides)),
        ];
        let found = find(&bodies::place(&rings(&neck), &mut random, 1.0, 0.0));
        assert_eq!((found.order, found.axisymmetric), (sides, false));
    }
}

#[test]
fn an_oval_of_a_small_bore_is_not_taken_for_facets() {
    // Drawn with sixteen facets whose sagitta is beyond the tolerance; oval by no more than that.
    for (n, radius) in [(3, 0.07), (5, 0.09)] {
        let flaw = |by: f64| wheel(n, 12, radius, 16, 0.3, Flaw::Oval(by));
        assert_eq!(find(&flaw(0.0)).order, n as u32);
        for size in [0.75e-3, 1e-3] {
            let found = find_with(&flaw(size), &Params::default());
            assert!(found.is_err() || found.is_ok_and(|s| s.order < n as u32));
        }
    }
}

/// Facets were taken to hide as much at their corners, which are on the shape, as in their middles.
#[test]
fn a_shallow_groove_is_seen_at_the_corners_of_its_facets() {
    for (n, facets) in [(3, 16), (5, 40), (6, 23)] {
        let body = |flaw| wheel(n, 12, 0.5, facets, 0.3, flaw);
        assert_eq!(find(&body(Flaw::None)).order, n as u32);
        let found = find_with(&body(Flaw::Keyway(2e-3)), &Params::default());
        assert!(found.is_err() || found.is_ok_and(|s| s.order < n as u32));
    }
}

#[test]
#[ignore = "a table over many bodies; run it with --release"]
fn facets_and_flaws() {
    let mut random = Random(11);
    let flaws: [fn(f64) -> Flaw; 7] = [
        |_| Flaw::None,
        Flaw::Oval,
        Flaw::Eccentric,
        Flaw::Groove,
        Flaw::Dent,
        Flaw::Keyway,
        Flaw::Lobe,
    ];
    // The sagitta of the bore is at most 2.5e-3 in a coarse drawing, which is beyond the tolerance, and below in a fine one.
    for (drawing, per_lobe, facets) in [("coarse", 12, [16, 23, 40]), ("fine", 48, [128, 150, 170])]
    {
        for flaw in flaws {
            for size in [2e-3, 5e-3, 1e-2] {
                let (mut read, mut all, mut worst) = (0, 0, 0.0_f64);
                for n in [3, 5, 6, 10, 13] {
                    for facets in facets {
                        let sagitta = 1.0 - (std::f64::consts::PI / f64::from(facets)).cos();
                        let radius = (2.5e-3 / sagitta).min(0.85) * (0.3 + 0.7 * random.unit());
                        let by = match flaw(size) {
                            // Twice that under the worst power.
                            Flaw::Oval(s) | Flaw::Eccentric(s) => 0.5 * s,
                            _ => size,
                        };
                        let phase = if all % 2 == 0 { 0.0 } else { random.unit() };
                        let body = wheel(n, per_lobe, radius, facets as usize, phase, flaw(by));
                        let body = bodies::split_faces(&body, &mut random, 0.2);
                        let placed = bodies::place(&body, &mut random, 1.0, 0.0);
                        let found = find_with(&placed, &Params::default());
                        all += 1;
                        let right = found.as_ref().is_ok_and(|s| s.order == n as u32);
                        read += u32::from(right);
                        if right {
                            worst = worst.max(found.map_or(0.0, |s| s.residual));
                        } else if flaw(0.0) == Flaw::None {
                            let what = found.map_or_else(|e| e.to_string(), |s| s.group);
                            eprintln!("{n} lobes, {facets} facets, radius {radius}: {what}");
                        }
                    }
                }
                eprintln!(
                    "{drawing}, {:?}: {read} of {all} taken for symmetric, residual up to {worst:.1e}",
                    flaw(size)
                );
                if flaw(0.0) == Flaw::None {
                    break;
                }
            }
        }
    }
}

/// Its facets are so large that they shift the centre of mass by more than the tolerance, hide more of the faces than tells
/// where the axes are, and make edges inside of its faces that look sharp. What tells are the corners and the borders.
#[test]
fn a_bar_that_is_drawn_as_coarsely_as_it_twists() {
    // Steps as a kernel takes them, from one end.
    let levels = [0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.875, 1.0];
    let section = [
        (6.0, 10.0),
        (-6.0, 10.0),
        (-6.0, 0.0),
        (-6.0, -10.0),
        (6.0, -10.0),
        (6.0, 0.0),
    ];
    let vertex = |(level, (x, y)): (f64, (f64, f64))| {
        let (s, c) = (PI * level).sin_cos();
        DVec3::new(c * x - s * y, s * x + c * y, 60.0 * level)
    };
    let vertices = levels
        .iter()
        .flat_map(|l| section.map(|p| vertex((*l, p))))
        .collect();
    let n = section.len() as u32;
    let mut triangles = Vec::new();
    for k in 0..levels.len() as u32 - 1 {
        for i in 0..n {
            let [a, b] = [i, (i + 1) % n].map(|i| k * n + i);
            triangles.extend([[a, b, a + n], [b, b + n, a + n]]);
        }
    }
    let top = (levels.len() as u32 - 1) * n;
    for i in 1..n - 1 {
        triangles.extend([[0, i + 1, i], [top, top + i, top + i + 1]]);
    }
    let body = bodies::document(vertices, triangles);
    for seed in 0..4 {
        let placed = bodies::place(&body, &mut Random(seed), 1.0, 0.0);
        assert_eq!(find(&placed).group, "D2");
    }
}

/// A part with a flaw was said to be nearest to half a turn, with the place of some other feature.
#[test]
fn what_breaks_an_order_is_named_with_its_place() {
    for n in [5, 8, 12] {
        let mut random = Random(u64::from(n));
        let body = wheel(n as usize, 12, 0.5, 23, 0.3, Flaw::Keyway(2e-2));
        let placed = bodies::place(&body, &mut random, 1.0, 0.0);

        let params = Params {
            allow_asymmetric: true,
            ..Params::default()
        };
        let found = detect(&placed, None, &params, &mut |_| ()).expect("passed on");
        let nearly = found.nearly.expect("something nearly holds");
        assert_eq!(nearly.order, Some(n), "{nearly}");
        assert!(nearly.share < 0.05, "{nearly}");
        assert!((0.5e-2..3e-2).contains(&nearly.residual), "{nearly}");
    }
    let whole = wheel(5, 12, 0.5, 23, 0.3, Flaw::None);
    let found = detect(&whole, None, &Params::default(), &mut |_| ()).expect("symmetric");
    assert!(found.nearly.is_none());
}

/// The centre of mass was taken for a point of the axis, which it is not where much is missing.
#[test]
fn a_large_part_that_is_missing_does_not_hide_the_order() {
    let mut random = Random(3);
    let body = |missing: bool| {
        let lobed = |a: f64, r: f64, z: f64| {
            let is_gone = missing && !(0.2..=TAU - 0.2).contains(&a);
            let lobe = if is_gone {
                0.0
            } else {
                (8.0 * a).cos().max(0.0)
            };
            (r * (1.0 + 0.4 * lobe), z)
        };
        bodies::profile(160, &[(0.6, 0.0), (0.6, 0.3)], lobed)
    };
    assert_eq!(find(&body(false)).order, 8);
    let placed = bodies::place(&body(true), &mut random, 1.0, 0.0);
    let params = Params {
        allow_asymmetric: true,
        ..Params::default()
    };
    let found = detect(&placed, None, &params, &mut |_| ()).expect("passed on");
    let nearly = found.nearly.expect("something nearly holds");
    assert_eq!(nearly.order, Some(8), "{nearly}");
}

#[test]
fn polyhedra_and_their_axes() {
    let cube = find(&bodies::cubes([1, 1, 1], |_| 7));
    assert_eq!(
        (cube.group.as_str(), cube.axis.direction),
        ("D4h", [0.0, 0.0, 1.0])
    );
    let count = |s: &Symmetry, n: u32| s.other_axes.iter().filter(|a| a.order == n).count();
    assert_eq!([4, 3, 2].map(|n| count(&cube, n)), [2, 4, 6]);
    assert_eq!(cube.axis.point, [0.5; 3]);

    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut points = Vec::new();
    for (a, b) in [
        (1.0, golden),
        (1.0, -golden),
        (-1.0, golden),
        (-1.0, -golden),
    ] {
        points.extend([
            DVec3::new(0.0, a, b),
            DVec3::new(a, b, 0.0),
            DVec3::new(b, 0.0, a),
        ]);
    }
    let mut random = Random(6);
    let body = bodies::place(&bodies::hull(&points), &mut random, 1.0, 0.0);
    let detection = detect(&body, None, &Params::default(), &mut |_| ()).unwrap();
    assert!(detection.notes.iter().any(|n| n.contains("Ih")));
    let found = Symmetry::from(detection);
    assert_eq!(found.group, "D5d");
    assert_eq!([5, 3, 2].map(|n| count(&found, n)), [5, 10, 15]);

    let corners = [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ];
    let body = bodies::hull(&corners.map(DVec3::from_array));
    let detection = detect(&body, None, &Params::default(), &mut |_| ()).unwrap();
    assert_eq!(detection.symmetry.group.symbol(), "C3v");
    assert!(detection.notes.iter().any(|n| n.contains("Td")));
}

#[test]
fn isotropic_inertia_does_not_hide_an_axis() {
    // A square column whose height makes all principal moments equal is a cube; a hexagonal one is
    // not, but its inertia is that of a ball as well.
    let side = 1.0_f64;
    let area = 1.5 * 3.0_f64.sqrt();
    let second = 5.0 * 3.0_f64.sqrt() / 16.0 * side;
    let height = (12.0 * second / area).sqrt();
    let mut random = Random(8);
    let body = bodies::place(&bodies::prism(6, side, height), &mut random, 1.0, 0.0);
    assert_eq!(find(&body).group, "D6h");
}

/// Of orders about an axis that moments tell roughly, many are off by no more than the facets' own.
#[test]
fn facets_are_told_about_a_rough_axis() {
    let mut random = Random(17);
    // As long as its principal moments are equal but for a few thousandths.
    let half = 0.75_f64.sqrt();
    for n in [22, 24, 25] {
        let body = bodies::profile(n, &[(1.0, -half), (1.02, 0.0), (1.0, half)], |_, r, z| {
            (r, z)
        });
        for _ in 0..2 {
            let found = find(&bodies::place(&body, &mut random, 1.0, 5e-5));
            assert_eq!(found.group, format!("D{n}h"));
        }
    }
}

#[test]
fn regions_must_match_or_be_permuted() {
    // One material per quarter.
    let quarters = bodies::cubes([2, 2, 1], |[x, y, _]| (x + 2 * y) as u32);
    let found = find(&quarters);
    assert_eq!((found.order, found.mirror), (4, true));
    assert_eq!(found.rotation_regions, [[0, 1], [1, 3], [2, 0], [3, 2]]);
    assert!(!found.mirror_regions.is_empty());

    // One material below, another above: no flip, no permutation.
    let layers = bodies::cubes([2, 2, 2], |[_, _, z]| 5 + (z as u32));
    let found = find(&layers);
    assert_eq!(found.order, 4);
    assert!(found.rotation_regions.is_empty());

    // Three of one and one of another: only the diagonal mirror is left.
    let odd = bodies::cubes([2, 2, 1], |[x, y, _]| u32::from(x == 1 && y == 1));
    let found = find(&odd);
    assert!(found.order < 4);
    assert!(found.rotation_regions.is_empty() && found.mirror_regions.is_empty());

    let eight = bodies::cubes([2, 2, 2], |[x, y, z]| (x + 2 * y + 4 * z) as u32);
    let found = find(&eight);
    assert_eq!(
        (found.group.as_str(), found.rotation_regions.len()),
        ("D4h", 8)
    );
    assert_eq!(found.axis.direction, [0.0, 0.0, 1.0]);
}

/// Of three half-turn axes, the one across which the body is widest: mirror planes through it leave a plate as thick as it is.
#[test]
fn the_axis_of_a_plate_is_across_it() {
    for (sizes, axis) in [
        ([1, 4, 6], DVec3::X),
        ([6, 1, 4], DVec3::Y),
        ([4, 6, 1], DVec3::Z),
    ] {
        let found = find(&bodies::cubes(sizes, |_| 0));
        assert_eq!((found.group.as_str(), found.order), ("D2h", 2));
        assert_eq!(found.axis.direction, axis.to_array(), "{sizes:?}");
    }
}

#[test]
fn overrides_are_verified() {
    let body = Kind::Dnh.body(12, 6, 0.05);
    let with = |change: fn(&mut Params)| {
        let mut params = Params::default();
        change(&mut params);
        find_with(&body, &params)
    };
    let s = with(|p| p.order = Some(4)).unwrap();
    assert_eq!((s.order, s.mirror), (4, true));
    match with(|p| p.order = Some(5)) {
        Err(Error::OrderFails { residual, .. }) => assert!((1e-2..0.2).contains(&residual)),
        other => panic!("{other:?}"),
    }
    let s = with(|p| p.axis = Some(DVec3::NEG_Z)).unwrap();
    assert_eq!((s.order, s.axis.direction), (12, [0.0, 0.0, -1.0]));
    let s = with(|p| p.axis = Some(DVec3::X)).unwrap();
    assert_eq!(s.group, "D2h");
    assert!(with(|p| p.axis = Some(DVec3::new(0.5, 0.2, 0.3).normalize())).is_err());
    assert!(with(|p| p.center = Some(DVec3::new(0.3, 0.11, 0.07))).is_err());
    let s = with(|p| p.max_order = 10).unwrap();
    assert_eq!(s.order, 6);
}

#[test]
fn bodies_without_symmetry() {
    let mut random = Random(9);
    let points: Vec<DVec3> = (0..12)
        .map(|_| bodies::random_vector(&mut random).normalize())
        .map(|p| DVec3::new(p.x, p.y.abs() + 0.1, p.z))
        .collect();
    let body = bodies::hull(&points);
    match find_with(&body, &Params::default()) {
        Err(Error::Asymmetric {
            closest: Some(closest),
            ..
        }) => assert!(closest.residual > 1e-2),
        other => panic!("{other:?}"),
    }
    let params = Params {
        allow_asymmetric: true,
        ..Params::default()
    };
    let s = find_with(&body, &params).unwrap();
    assert_eq!((s.group.as_str(), s.order, s.mirror), ("C1", 1, false));

    // Off-centre waves of different lengths, even in the angle.
    let wave = |a: f64, r: f64, z: f64| {
        let r = r * (1.0 + 0.1 * a.cos() + 0.07 * (2.0 * a).cos() + 0.05 * (3.0 * a).cos());
        (r * (1.2 - 0.4 * z), z)
    };
    let body = bodies::profile(60, &[(0.9, 0.0), (0.9, 0.3), (0.8, 0.6)], wave);
    let s = find(&bodies::place(&body, &mut random, 1.0, 0.0));
    assert_eq!((s.group.as_str(), s.order, s.mirror), ("C1v", 1, true));
    assert!(s.residual < 1e-6);
}

#[test]
fn bodies_of_nothing() {
    let empty = Document::single(Template::default());
    assert!(matches!(
        find_with(&empty, &Params::default()),
        Err(Error::NoSurface)
    ));
    let point = bodies::document(vec![DVec3::ONE; 3], vec![[0, 1, 2]]);
    assert!(matches!(
        find_with(&point, &Params::default()),
        Err(Error::NoExtent { triangles: 1 })
    ));
    // A needle and a flat square: no volume, an extent all the same.
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let square = square.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let flat = bodies::document(square, vec![[0, 1, 2], [0, 2, 3]]);
    assert_eq!(find(&flat).order, 4);
    let needle = bodies::document(
        vec![DVec3::ZERO, DVec3::X, DVec3::new(2.0, 0.0, 0.0)],
        vec![[0, 1, 2]],
    );
    let _ = find_with(&needle, &Params::default());
}

#[test]
fn the_same_every_time() {
    let mut random = Random(10);
    let body = bodies::place(&Kind::Cnv.body(9, 10, 0.1), &mut random, 1.0, 1e-5);
    let with = |threads| {
        let params = Params {
            threads,
            ..Params::default()
        };
        find_with(&body, &params).unwrap()
    };
    assert_eq!(with(1), with(1));
    assert_eq!(with(1), with(3));
}

#[test]
fn rings_of_different_facets() {
    let mut random = Random(12);
    for (kind, n) in [(Kind::Dnd, 3), (Kind::Cnv, 5), (Kind::Cnh, 2)] {
        let body = kind.uneven_body(n, 160, 0.12, &mut random);
        let found = find(&bodies::place(&body, &mut random, 1.0, 1e-5));
        assert_eq!(found.group, kind.symbol(n), "residual {}", found.residual);
    }
}

#[test]
#[ignore = "a table over many bodies; run it with --release"]
fn confusion_of_drawings() {
    let mut random = Random(13);
    for noise in [0.0, 1e-6, 1e-5, 1e-4] {
        let (mut right, mut all, mut worst) = (0, 0, 0.0_f64);
        for kind in Kind::ALL {
            for n in [2, 3, 5, 16, 64, 256] {
                // Its cubic bend would be drawn with chords of a whole tolerance.
                let most = if kind == Kind::S2n { 0.03 } else { 0.12 };
                let depth = (0.5 / f64::from(n)).clamp(4e-3, most);
                // The saw has corners, which are drawn with chords as well.
                let bend = 1.0 + depth * f64::from(n * n);
                let saw = matches!(kind, Kind::Cn | Kind::Cnh);
                let facets = match saw {
                    true => (depth * f64::from(n) / 3e-4) as usize,
                    false => (TAU * (bend / 8.0 / 3e-4).sqrt()) as usize,
                };
                let body = kind.uneven_body(n, facets.max(40), depth, &mut random);
                let body = match all % 2 {
                    0 => body,
                    _ => bodies::split_faces(&body, &mut random, 0.3),
                };
                let placed = bodies::place(&body, &mut random, 1.0, noise);
                all += 1;
                match find_with(&placed, &Params::default()) {
                    Ok(s) if s.group == kind.symbol(n) => {
                        right += 1;
                        worst = worst.max(s.residual);
                    }
                    Ok(s) => eprintln!(
                        "noise {noise:e}, {}: found {}, residual {:e}",
                        kind.symbol(n),
                        s.group,
                        s.residual
                    ),
                    Err(e) => eprintln!("noise {noise:e}, {}: {e}", kind.symbol(n)),
                }
            }
        }
        eprintln!("noise {noise:e}: {right} of {all} right, residual up to {worst:.1e}");
    }
}

#[test]
#[ignore = "a table over many bodies; run it with --release"]
fn confusion() {
    let mut random = Random(2);
    let orders = [
        1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 24, 31, 53, 64, 100, 128, 200, 256,
    ];
    for noise in [0.0, 1e-6, 1e-5, 1e-4] {
        let (mut right, mut all) = (0, 0);
        let begun = std::time::Instant::now();
        for kind in Kind::ALL {
            for n in orders {
                let per_lobe = if n < 20 { 12 } else { 6 };
                let depth = (0.5 / f64::from(n)).clamp(0.01, 0.15);
                let mut body = kind.body(n, per_lobe, depth);
                if all % 2 == 1 {
                    body = bodies::split_faces(&body, &mut random, 0.3);
                }
                let scale = [1.0, 1e-6, 1e6][all % 3];
                let placed = bodies::place(&body, &mut random, scale, noise);
                let expected = match (n, kind) {
                    (1, Kind::Cn | Kind::S2n) => continue,
                    (1, Kind::Cnv | Kind::Cnh) => "C1v".to_owned(),
                    (1, Kind::Dn) => "C2".to_owned(),
                    (1, Kind::Dnd) => "C2h".to_owned(),
                    (1, Kind::Dnh) => "C2v".to_owned(),
                    _ => kind.symbol(n),
                };
                all += 1;
                match find_with(&placed, &Params::default()) {
                    Ok(s) if s.group == expected => right += 1,
                    Ok(s) => eprintln!(
                        "noise {noise:e}, {expected}: found {}, residual {:e}",
                        s.group, s.residual
                    ),
                    Err(e) => eprintln!("noise {noise:e}, {expected}: {e}"),
                }
            }
        }
        eprintln!(
            "noise {noise:e}: {right} of {all} right, {:?}",
            begun.elapsed()
        );
    }
}

#[test]
fn tight_tolerances_leave_room_for_an_adjustment() {
    let mut random = Random(24);
    let body = bodies::place(&Kind::Cnv.body(5, 6, 0.1), &mut random, 1.0, 2e-6);
    for tolerance in [1e-4, 2e-5, 1e-5] {
        let params = Params {
            tolerance,
            ..Params::default()
        };
        assert_eq!(find_with(&body, &params).unwrap().group, "C5v");
    }
}

/// A ring with teeth on top, drawn with one chord along the rim of a tooth or with two.
fn toothed(chords: &[u32]) -> Document {
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    let mut quad = |corners: [DVec3; 4]| {
        let [a, b, c, d] = corners.map(|p| {
            let known = vertices.iter().position(|q| *q == p);
            known.unwrap_or_else(|| {
                vertices.push(p);
                vertices.len() - 1
            }) as u32
        });
        triangles.extend([[a, b, c], [a, c, d]]);
    };
    let step = std::f64::consts::TAU / chords.len() as f64;
    let at = |angle: f64, r: f64, z: f64| {
        let (s, c) = libm::sincos(angle);
        DVec3::new(r * c, r * s, z)
    };
    let (inner, outer) = (0.6, 1.0);
    let (low, high) = (0.3, 0.6);
    for (i, &count) in (0_u32..).zip(chords) {
        // A tooth over four fifths of the step, then a gap.
        let part = |i: u32, k: u32| {
            let within = 0.8 * f64::from(k) / f64::from(count);
            step * (f64::from(i) + within)
        };
        let next = step * f64::from((i + 1) % chords.len() as u32);
        let mut angles: Vec<(f64, f64)> = (0..=count).map(|k| (part(i, k), high)).collect();
        angles.push((next, low));
        for pair in angles.windows(2) {
            let ([a, _], top) = ([pair[0].0, 0.0], pair[1].1);
            let b = pair[1].0;
            quad([
                at(a, outer, 0.0),
                at(b, outer, 0.0),
                at(b, outer, low),
                at(a, outer, low),
            ]);
            quad([
                at(b, inner, 0.0),
                at(a, inner, 0.0),
                at(a, inner, low),
                at(b, inner, low),
            ]);
            quad([
                at(a, inner, 0.0),
                at(b, inner, 0.0),
                at(b, outer, 0.0),
                at(a, outer, 0.0),
            ]);
            quad([
                at(a, outer, top),
                at(b, outer, top),
                at(b, inner, top),
                at(a, inner, top),
            ]);
            if top > low {
                quad([
                    at(a, outer, low),
                    at(b, outer, low),
                    at(b, outer, top),
                    at(a, outer, top),
                ]);
                quad([
                    at(b, inner, low),
                    at(a, inner, low),
                    at(a, inner, top),
                    at(b, inner, top),
                ]);
            }
        }
        let side = |a: f64| {
            [
                at(a, inner, low),
                at(a, outer, low),
                at(a, outer, high),
                at(a, inner, high),
            ]
        };
        quad(side(part(i, 0)));
        let mut other = side(part(i, count));
        other.reverse();
        quad(other);
    }
    bodies::document(vertices, triangles)
}

/// Wheels and slotted rings were given the few mirror planes that their drawing has: beside a narrow facet, folds tell that the
/// rim of a tooth is a flat face.
#[test]
fn vertices_tell_of_a_curve_that_folds_do_not() {
    let mut random = Random(19);
    for chords in [
        [1, 2, 1, 1, 2, 2, 1, 1, 1, 2, 1, 1],
        [2, 2, 2, 1, 2, 2, 2, 2, 2, 2, 1, 2],
    ] {
        let found = find(&bodies::place(&toothed(&chords), &mut random, 1.0, 0.0));
        assert!(found.order == 12 && found.mirror, "{found:?}");
    }
    // A tooth that is lower by what a chord hides is another tooth.
    let mut lower = toothed(&[1, 2, 1, 1, 2, 2, 1, 1, 1, 2, 1, 1]);
    for p in &mut lower.templates[0].vertices {
        if p.z > 0.3 && p.x > 0.9 {
            p.z -= 0.02;
        }
    }
    let found = find_with(
        &bodies::place(&lower, &mut random, 1.0, 0.0),
        &Params::default(),
    );
    assert!(found.is_err() || found.is_ok_and(|f| f.order == 1));
}

/// A ball drawn between meridians that are not evenly apart was given the half turn of its drawing, about another axis than
/// that of the meridians.
#[test]
fn a_ball_whose_drawing_has_a_half_turn_is_round() {
    const MERIDIANS: u32 = 40;
    const PARALLELS: u32 = 20;
    let at = |i: u32, j: u32| {
        let even = TAU * f64::from(i) / f64::from(MERIDIANS);
        // Alike on both sides of the x axis.
        let (s, c) = libm::sincos(even + 0.15 * libm::sin(even));
        let (r, z) = libm::sincos(PI * f64::from(j) / f64::from(PARALLELS));
        DVec3::new(r * c, r * s, z)
    };
    let rings = (1..PARALLELS).flat_map(|j| (0..MERIDIANS).map(move |i| (i, j)));
    let mut vertices: Vec<DVec3> = rings.map(|(i, j)| at(i, j)).collect();
    let [north, south] = [0, 1].map(|i| vertices.len() as u32 + i);
    vertices.extend([DVec3::Z, -DVec3::Z]);
    let id = |i: u32, j: u32| (j - 1) * MERIDIANS + i % MERIDIANS;
    let mut triangles = Vec::new();
    for i in 0..MERIDIANS {
        triangles.push([north, id(i, 1), id(i + 1, 1)]);
        triangles.push([south, id(i + 1, PARALLELS - 1), id(i, PARALLELS - 1)]);
        for j in 1..PARALLELS - 1 {
            let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            triangles.extend([[a, d, b], [b, d, c]]);
        }
    }
    let mut random = Random(23);
    let ball = bodies::document(vertices, triangles);
    let found = find(&bodies::place(&ball, &mut random, 1.0, 0.0));
    assert!(found.axisymmetric, "{found:?}");
}
