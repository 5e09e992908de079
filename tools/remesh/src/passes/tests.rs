//! Surfaces that are remeshed, without any document.

use super::collapse::collapse;
use super::contract::contracted;
use super::flip::flip;
use super::slender::slenderness;
use super::split::split;
use crate::input::Place;
use crate::mesh::Mesh;
use crate::shape::{Allowance, Curves, Envelope, Near, Patches};
use crate::{Drawn, Link, Remeshed, Rules, Sizes, Surface, remesh};
use geom::contacts::contacts;
use geom::measure::volume_of_region;
use geom::tree::{Tree, closest_point};
use glam::{DMat3, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// Angles between triangles: ten degrees.
const SHARP: f64 = std::f64::consts::PI / 18.0;

/// Nothing is bound to anything.
fn nowhere(_: u32, p: DVec3) -> DVec3 {
    p
}

/// A sphere by longitudes and latitudes, with needles at its poles; its halves have labels of their own.
fn globe(around: u32, up: u32) -> Surface {
    let mut surface = Surface::default();
    let at = |i: u32, j: u32| {
        let (a, b) = (
            std::f64::consts::TAU * f64::from(i) / f64::from(around),
            std::f64::consts::PI * (f64::from(j) / f64::from(up) - 0.5),
        );
        DVec3::new(a.cos() * b.cos(), a.sin() * b.cos(), b.sin())
    };
    surface.points = vec![-DVec3::Z, DVec3::Z];
    for j in 1..up {
        surface.points.extend((0..around).map(|i| at(i, j)));
    }
    let id = |i: u32, j: u32| match j {
        0 => 0,
        j if j == up => 1,
        j => 2 + (j - 1) * around + i % around,
    };
    for j in 0..up {
        for i in 0..around {
            let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            let both = [[a, b, c], [a, c, d]];
            let real = both
                .into_iter()
                .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
            surface.triangles.extend(real);
            surface
                .labels
                .resize(surface.triangles.len(), u32::from(2 * j >= up));
        }
    }
    surface
}

fn done(surface: &Surface, deviation: f64, held: &[bool]) -> Option<Remeshed> {
    sized(surface, deviation, (held, None))
}

/// Usual rules.
fn rules<'a>(
    deviation: f64,
    (held, lengths): (&'a [bool], &'a [f64]),
    (bound, links): (&'a [u32], &'a [Link]),
) -> Rules<'a> {
    Rules {
        held,
        bound,
        links,
        spaces: &[],
        onto: &nowhere,
        deviation,
        nearer: &[],
        noise: deviation,
        flat: 1e-10,
        folds: 0.0,
        feature: 0.75_f64.sqrt(),
        sharp: SHARP,
        drawn: Drawn::Roughly,
        sizes: Sizes {
            turn: std::f64::consts::TAU / 12.0,
            turn_is_asked: false,
            lengths,
            local: None,
            growth: 0.5,
        },
    }
}

fn sized(surface: &Surface, deviation: f64, asked: (&[bool], Option<f64>)) -> Option<Remeshed> {
    linked(surface, deviation, asked, &[])
}

fn linked(
    surface: &Surface,
    deviation: f64,
    (held, length): (&[bool], Option<f64>),
    links: &[Link],
) -> Option<Remeshed> {
    let bound = vec![0; surface.points.len()];
    let lengths = [length.unwrap_or(f64::INFINITY); 8];
    remesh(
        surface,
        &rules(deviation, (held, &lengths), (&bound, links)),
    )
}

/// What `look` finds in the mesh of a surface that nothing has been done to.
fn with_mesh<T>(surface: &Surface, rules: Rules<'_>, look: impl FnOnce(&mut Mesh<'_>) -> T) -> T {
    let patches = Patches::new(surface, &rules);
    let curves = Curves::new(surface, &rules, &patches);
    let allowance = Allowance::new(surface, &rules, &patches, &curves);
    let envelope = Envelope::new((surface, &rules), &patches, &curves, &allowance);
    look(&mut Mesh::new(
        surface,
        rules,
        (&patches, &curves),
        (&envelope, &allowance),
    ))
}

/// The largest distance of points of one surface from another.
fn farthest(from: &Surface, to: &Surface) -> f64 {
    let all = |s: &Surface| -> Vec<[DVec3; 3]> {
        (0..s.triangles.len() as u32)
            .map(|t| s.corners(t))
            .collect()
    };
    let tree = Tree::new(all(to));
    let points = all(from).into_iter().flat_map(|[a, b, c]| {
        [
            a,
            b,
            c,
            0.5 * (a + b),
            0.5 * (b + c),
            0.5 * (c + a),
            (a + b + c) / 3.0,
        ]
    });
    let distances = points.filter_map(|p| Some(tree.nearest(p, f64::INFINITY)?.distance));
    distances.fold(0.0, f64::max)
}

fn smallest_angle(surface: &Surface) -> f64 {
    let corners = (0..surface.triangles.len() as u32).map(|t| surface.corners(t));
    let angles = corners.flat_map(|p| {
        [0, 1, 2].map(|i| (p[(i + 1) % 3] - p[i]).angle_between(p[(i + 2) % 3] - p[i]))
    });
    angles.fold(f64::INFINITY, f64::min).to_degrees()
}

fn volume(surface: &Surface) -> f64 {
    let faces = surface.triangles.iter().map(|t| (*t, [0, 1]));
    volume_of_region(&surface.points, faces, 1)
}

/// Whether each edge has two triangles that are wound alike.
fn is_closed(surface: &Surface) -> bool {
    let mut edges: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    for t in &surface.triangles {
        for i in 0..3 {
            let (a, b) = (t[i], t[(i + 1) % 3]);
            *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    edges.values().all(|&sum| sum == 0)
}

#[test]
fn a_remeshed_surface_stands_on_the_patches_of_the_input() {
    let globe = globe(40, 20);
    let held = vec![false; globe.points.len()];
    let deviation = 0.02;
    let made = done(&globe, deviation, &held).expect("needles at the poles");
    let ground = made.ground.expect("a shape");
    assert_eq!(made.patches.len(), made.surface.triangles.len());
    for (t, &patch) in (0..).zip(&made.patches) {
        let [a, b, c] = made.surface.corners(t);
        let (at, normal) = ground.nearest(patch, a).expect("a place");
        assert!(
            at.distance(a) <= deviation && normal.dot(a) > 0.9,
            "{at} {normal}"
        );
        assert!(ground.holds(patch, [a, b, c]));
        // Not what faces the other way, nor what is farther off, also where its sides are not.
        assert!(!ground.holds(patch, [a, c, b]));
        assert!(!ground.holds(patch, [a * (1.0 + 2.0 * deviation), b, c]));
        let small = [a, b, c].map(|p| p * (1.0 - 2.0 * deviation));
        assert!(!ground.holds(patch, small));
    }
}

/// Who moves the surface further has points all along folds that are longer than edges are to be, as far off as they may be at most, or are.
#[test]
fn folds_that_are_long_have_points_all_along() {
    let globe = globe(40, 4);
    let held = vec![false; globe.points.len()];
    let deviation = 0.02;
    let made = sized(&globe, deviation, (&held, Some(0.2))).expect("long facets");
    let triangles = made.surface.triangles.len() as u32;
    assert_eq!(made.samples.len() as u32, triangles);
    let on_meridian = |p: DVec3| p.y.abs() < 1e-12 && p.x > 0.0 && p.z > 0.01;
    let mut heights = Vec::new();
    for (t, samples) in (0..triangles).zip(&made.samples) {
        let corners = made.surface.corners(t);
        for sample in samples {
            let off = closest_point(sample.point, &corners).distance(sample.point);
            assert!(off <= sample.reach, "{off} {}", sample.reach);
            heights.extend(on_meridian(sample.point).then_some(sample.point.z));
        }
    }
    heights.sort_by(f64::total_cmp);
    assert!(heights.len() > 12, "{heights:?}");
    assert!(
        heights.windows(2).all(|pair| pair[1] - pair[0] < 0.1),
        "{heights:?}"
    );
}

#[test]
fn needles_go_and_the_surface_stays_in_its_envelope() {
    let globe = globe(40, 20);
    let held = vec![false; globe.points.len()];
    for deviation in [0.003, 0.02] {
        let made = done(&globe, deviation, &held).expect("needles at the poles");
        let again = done(&globe, deviation, &held).unwrap();
        let all = |made: &Remeshed| {
            let numbers =
                [&made.vertices, &made.triangles, &made.bound, &made.patches].map(Vec::clone);
            (made.surface.clone(), numbers, made.links.clone(), made.told)
        };
        assert_eq!(all(&made), all(&again));
        let surface = &made.surface;
        assert!(is_closed(surface));
        assert!(
            smallest_angle(&globe) < 10.0 && smallest_angle(surface) > 20.0,
            "{}",
            smallest_angle(surface)
        );
        let distances = [farthest(surface, &globe), farthest(&globe, surface)];
        assert!(distances.iter().all(|d| *d <= deviation), "{distances:?}");
        assert!((volume(surface) / volume(&globe) - 1.0).abs() < 4.0 * deviation);
        contacts(
            &surface.points,
            &surface.triangles,
            |t| t,
            |contact| panic!("{contact:?}"),
        );
        // The border between the labels is a curve that stays one, on the equator.
        let mut border = 0;
        let mut of_edge: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
        for (t, label) in surface.triangles.iter().zip(&surface.labels) {
            for i in 0..3 {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                of_edge
                    .entry([a.min(b), a.max(b)])
                    .or_default()
                    .push(*label);
            }
        }
        for (ends, labels) in of_edge {
            if labels[0] != labels[1] {
                border += 1;
                let level = |v: u32| surface.points[v as usize].z.abs() <= 1e-12;
                assert!(ends.into_iter().all(level));
            }
        }
        assert!(border >= 8, "{border}");
    }
}

/// The cosine of the smallest angle between triangles at an edge.
fn cosine_of_sharpest(surface: &Surface) -> f64 {
    let mut across: FxHashMap<[u32; 2], Vec<DVec3>> = FxHashMap::default();
    for t in &surface.triangles {
        for i in 0..3 {
            let [a, b, c] = [i, i + 1, i + 2].map(|i| t[i % 3]);
            let [p, q, r] = [a, b, c].map(|v| surface.points[v as usize]);
            let away = (r - p).reject_from(q - p).normalize();
            across.entry([a.min(b), a.max(b)]).or_default().push(away);
        }
    }
    let cosines = across.values().map(|at| at[0].dot(at[1]));
    cosines.fold(-1.0, f64::max)
}

/// What is rough, and smooth by the angle asked for, may turn farther from edge to edge than would fold it.
#[test]
fn edges_get_no_sharper_than_elements_may_be() {
    let mut rough = globe(24, 12);
    for (i, p) in rough.points.iter_mut().enumerate() {
        *p *= 1.0 + 0.3 * (7.0 * (i * i) as f64).sin();
    }
    let most = SHARP.cos();
    assert!(cosine_of_sharpest(&rough) < most);
    let held = vec![false; rough.points.len()];
    let bound = vec![0; rough.points.len()];
    for deviation in [0.03, 0.06, 0.1] {
        let usual = rules(deviation, (&held, &[]), (&bound, &[]));
        let feature = 72_f64.to_radians().cos();
        let made = remesh(&rough, &Rules { feature, ..usual }).expect("needles");
        let cosine = cosine_of_sharpest(&made.surface);
        assert!(cosine <= most, "{deviation} {}", cosine.acos().to_degrees());
    }
}

/// Edges get the length that is asked for, where the input has longer ones and where it has shorter ones.
#[test]
fn edges_get_the_length_asked_for() {
    let globe = globe(120, 60);
    let held = vec![false; globe.points.len()];
    for length in [0.3, 0.1, 0.03] {
        let made = sized(&globe, 0.05, (&held, Some(length))).expect("other lengths");
        let surface = &made.surface;
        assert!(is_closed(surface));
        let (mut sum, mut count) = (0.0, 0.0);
        for t in 0..surface.triangles.len() as u32 {
            let [a, b, c] = surface.corners(t);
            sum += a.distance(b) + b.distance(c) + c.distance(a);
            count += 3.0;
        }
        let mean = sum / count / length;
        assert!((mean - 1.0).abs() < 0.15, "{length}: {mean}");
        assert!(smallest_angle(surface) > 20.0);
    }
}

#[test]
fn what_is_held_stays_to_the_bit() {
    let globe = globe(40, 20);
    let held: Vec<bool> = globe.points.iter().map(|p| p.y <= 1e-12).collect();
    let made = done(&globe, 0.02, &held).expect("needles at the poles");
    for (v, held) in held.iter().enumerate() {
        if *held {
            let new = made.vertices[v];
            assert_eq!(made.surface.points[new as usize], globe.points[v]);
        }
    }
    for (t, corners) in globe.triangles.iter().enumerate() {
        if corners.iter().all(|&v| held[v as usize]) {
            let new = made.surface.triangles[made.triangles[t] as usize];
            assert_eq!(new, corners.map(|v| made.vertices[v as usize]));
        }
    }
}

#[test]
fn flat_faces_and_what_has_no_needles_stay() {
    // A box with a needle in its top.
    let (p, q) = (DVec3::ZERO, DVec3::ONE);
    let mut surface = Surface::default();
    for i in 0..8_u32 {
        let at = |k: u32| if i >> k & 1 == 1 { q } else { p };
        surface.points.push(DVec3::new(at(0).x, at(1).y, at(2).z));
    }
    surface.points.push(DVec3::new(0.5, 0.4, 1.0));
    surface.triangles = vec![
        [0, 2, 1],
        [1, 2, 3],
        [0, 1, 4],
        [1, 5, 4],
        [1, 3, 5],
        [3, 7, 5],
        [3, 2, 7],
        [2, 6, 7],
        [2, 0, 6],
        [0, 4, 6],
        [4, 5, 8],
        [5, 7, 8],
        [7, 6, 8],
        [6, 4, 8],
    ];
    surface.labels = vec![0; surface.triangles.len()];
    let held = vec![false; surface.points.len()];
    if let Some(made) = done(&surface, 0.01, &held) {
        assert_eq!(volume(&made.surface), 1.0);
    }
}

/// A prism of 14 sides and unit height, with a vertex on each of its upright edges, that much above its lower end.
fn prism(above: f64) -> Surface {
    let sides = 14;
    let at = |i: u32, z: f64| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(sides)).sin_cos();
        DVec3::new(cos, sin, z)
    };
    let rings = [0.0, above, 1.0];
    let mut surface = Surface {
        points: rings
            .iter()
            .flat_map(|&z| (0..sides).map(move |i| at(i, z)))
            .collect(),
        ..Surface::default()
    };
    for i in 0..sides {
        let j = (i + 1) % sides;
        for ring in [0, sides] {
            let [a, b, c, d] = [ring + i, ring + j, ring + sides + j, ring + sides + i];
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    for i in 2..sides {
        let upper = 2 * sides;
        surface
            .triangles
            .extend([[0, i, i - 1], [upper, upper + i - 1, upper + i]]);
    }
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

/// The upright edges are no features, as the sides turn by less than those do.
#[test]
fn vertices_that_no_facet_needs_go_where_they_are_near_others() {
    let as_drawn = |surface: &Surface, held: &[u32]| {
        let mut holds = vec![false; surface.points.len()];
        held.iter().for_each(|&v| holds[v as usize] = true);
        let (bound, lengths) = (vec![0; holds.len()], [f64::INFINITY; 8]);
        let rules = Rules {
            drawn: Drawn::Kept,
            ..rules(1e-10, (&holds, &lengths), (&bound, &[]))
        };
        remesh(surface, &rules)
    };
    let drawn = prism(0.01);
    let made = as_drawn(&drawn, &[]).expect("vertices that are spare");
    assert_eq!(
        (made.surface.points.len(), made.surface.triangles.len()),
        (28, 52)
    );
    assert!(is_closed(&made.surface));
    assert!((volume(&made.surface) - volume(&drawn)).abs() < 1e-12);
    assert_eq!(as_drawn(&made.surface, &[]).map(|made| made.told), None);
    // What is held stays, as does what is not near anything, or off the edge that it is on.
    let held = as_drawn(&drawn, &[14, 15]).expect("others");
    assert_eq!(held.surface.points.len(), 30);
    assert_eq!(as_drawn(&prism(0.4), &[]).map(|made| made.told), None);
    let mut bent = drawn.clone();
    bent.points[14] *= DVec3::new(1.001, 1.001, 1.0);
    let bent = as_drawn(&bent, &[]).expect("others");
    // Folds from it end at the next ones.
    assert_eq!(bent.surface.points.len(), 31);
}

/// Two vertices next to each other, 1e-5 apart, make needles between folds of many degrees, which a deviation of 1e-8 cannot bridge.
/// Vertices along them would ask for elements of their width.
#[test]
fn needles_that_stay_are_not_divided() {
    let mut globe = globe(24, 12);
    let [a, b] = [2 + 5 * 24 + 3, 2 + 5 * 24 + 4];
    globe.points[b] = globe.points[a].lerp(globe.points[b], 4e-5);
    let held = vec![false; globe.points.len()];
    let bound = vec![0; globe.points.len()];
    let mut rules = rules(1e-8, (&held, &[]), (&bound, &[]));
    rules.sizes.turn /= 8.0;
    let made = remesh(&globe, &rules).expect("long edges");
    assert!(made.told.split > 0);
    // Their heights, from the side between the two to the third corner.
    let needles = |surface: &Surface, ends: [u32; 2]| -> Vec<f64> {
        let both = surface.triangles.iter();
        let both = both.filter(|t| ends.iter().all(|v| t.contains(v)));
        let third = both.flat_map(|t| t.iter().find(|v| !ends.contains(v)));
        let [p, q] = ends.map(|v| surface.points[v as usize]);
        third
            .map(|&v| surface.points[v as usize].distance(p.midpoint(q)))
            .collect()
    };
    let before = needles(&globe, [a, b].map(|v| v as u32));
    let after = needles(&made.surface, [a, b].map(|v| made.vertices[v]));
    assert_eq!((before.len(), after.len()), (2, 2));
    assert!(
        after.iter().all(|h| *h > 0.9 * before[0].min(before[1])),
        "{before:?} {after:?}"
    );
}

/// A round bar beside the axis, which it touches along an edge, and with it its image under half a turn.
fn bar() -> Surface {
    let around = 24;
    let at = |i: u32, z: f64| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(around);
        match 2 * i == around {
            true => DVec3::new(0.0, 0.0, z),
            false => DVec3::new(1.0 + angle.cos(), angle.sin(), z),
        }
    };
    let rings = (0..around).flat_map(|i| [at(i, -1.0), at(i, 1.0)]);
    let mut surface = Surface {
        points: rings
            .chain([DVec3::new(1.0, 0.0, -1.0), DVec3::new(1.0, 0.0, 1.0)])
            .collect(),
        ..Surface::default()
    };
    for i in 0..around {
        let [low, high] = [2 * i, 2 * i + 1];
        let [next, above] = [low, high].map(|v| (v + 2) % (2 * around));
        surface
            .triangles
            .extend([[low, next, above], [low, above, high]]);
        surface
            .triangles
            .extend([[2 * around, next, low], [2 * around + 1, high, above]]);
    }
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

#[test]
fn an_edge_along_which_a_body_touches_its_image_stays_its_image() {
    let surface = bar();
    let half_turn: Place = Arc::new(|p| DVec3::new(-p.x, -p.y, p.z));
    let links = [Link {
        pairs: vec![[24, 24], [25, 25]],
        labels: Vec::new(),
        image: Arc::clone(&half_turn),
        back: half_turn,
    }];
    let free = vec![false; surface.points.len()];
    let done = linked(&surface, 1e-2, (&free, Some(0.2)), &links).unwrap();
    let on_axis = (0..).zip(&done.surface.points);
    let on_axis = on_axis.filter(|(_, p)| p.truncate().length() < 1e-9);
    let images: Vec<[u32; 2]> = on_axis.map(|(v, _): (u32, _)| [v, v]).collect();
    assert!(images.len() > 4, "{}", images.len());
    assert_eq!(done.links, [images]);
}

/// An edge at an axis is in two faces there, of each of which one half is the image of the other under a half turn of its own, and
/// has the same image by both.
#[test]
fn an_edge_with_one_image_by_two_links_is_split_with_it() {
    let mut surface = bar();
    let middle = surface.points.len() as u32;
    surface.points.push(DVec3::ZERO);
    for t in 0..surface.triangles.len() {
        let corners = surface.triangles[t];
        if corners.contains(&24) && corners.contains(&25) {
            let half = |from: u32| corners.map(|v| if v == from { middle } else { v });
            surface.triangles[t] = half(24);
            surface.triangles.push(half(25));
            surface.labels.push(0);
        }
    }
    let half_turn = |angle: f64| {
        let image: Place = Arc::new(move |p| {
            let (sine, cosine) = (2.0 * angle).sin_cos();
            DVec3::new(cosine * p.x + sine * p.y, sine * p.x - cosine * p.y, -p.z)
        });
        Link {
            pairs: vec![[24, 25], [middle, middle]],
            labels: Vec::new(),
            image: Arc::clone(&image),
            back: image,
        }
    };
    let free = vec![false; surface.points.len()];
    let links = [half_turn(0.0), half_turn(std::f64::consts::FRAC_PI_6)];
    let done = linked(&surface, 1e-2, (&free, Some(0.2)), &links).unwrap();
    assert!(done.links[0].len() > 4, "{}", done.links[0].len());
    assert_eq!(done.links[0], done.links[1]);
    for &[v, image] in &done.links[0] {
        let [p, q] = [v, image].map(|v| done.surface.points[v as usize]);
        assert!(p.truncate().length() == 0.0 && p.z == -q.z, "{p} {q}");
    }
}

/// A globe of two halves with steps along their border, which are detail: a needle across each edge of it, that stands upright beside the triangles
/// on both sides.
fn stepped_globe(around: u32) -> Surface {
    let mut globe = globe(around, around / 2);
    let is_level = |p: DVec3| p.z.abs() <= 1e-12;
    for t in 0..globe.triangles.len() {
        let corners = globe.triangles[t];
        let turned = (0..3).map(|i| [0, 1, 2].map(|k| corners[(i + k) % 3]));
        let at = |v: u32| globe.points[v as usize];
        let on_border = |&[a, b, _]: &[u32; 3]| is_level(at(a)) && is_level(at(b));
        let Some([a, b, c]) = turned.into_iter().find(on_border) else {
            continue;
        };
        if globe.labels[t] == 0 {
            continue;
        }
        let middle = 0.5 * (at(a) + at(b));
        let raised = middle * 1.004 + 0.002 * DVec3::Z;
        let m = globe.points.len() as u32;
        globe.points.push(raised);
        globe.triangles[t] = [a, m, c];
        globe.triangles.extend([[m, b, c], [a, b, m]]);
        globe.labels.extend([1, 1]);
    }
    globe
}

#[test]
fn needles_between_features_go_where_they_are_detail() {
    let globe = stepped_globe(24);
    let held = vec![false; globe.points.len()];
    assert!(is_closed(&globe) && smallest_angle(&globe) < 3.0);
    let made = done(&globe, 0.02, &held).expect("needles along the border");
    assert!(made.told.joined > 0, "{:?}", made.told);
    let surface = &made.surface;
    assert!(is_closed(surface));
    assert!(
        smallest_angle(surface) > 15.0,
        "{}",
        smallest_angle(surface)
    );
    let distances = [farthest(surface, &globe), farthest(&globe, surface)];
    assert!(distances.iter().all(|d| *d <= 0.02), "{distances:?}");
    // Within much less than the needles are high, they are features and stay.
    let made = done(&globe, 1e-4, &held);
    assert!(made.is_none_or(|made| made.told.joined == 0));
}

/// The tips of needles that were joined to a border are vertices of it like others, and go where longer edges are asked for; only where needles ended beside each
/// other is a corner.
#[test]
fn what_was_joined_gets_coarser() {
    let around = 48;
    let globe = stepped_globe(around);
    let held = vec![false; globe.points.len()];
    let made = sized(&globe, 0.05, (&held, Some(0.5))).expect("longer edges");
    assert!(made.told.joined > 0 && is_closed(&made.surface));
    let has = |label: u32| -> FxHashSet<u32> {
        let all = made.surface.triangles.iter().zip(&made.surface.labels);
        all.filter(|(_, l)| **l == label)
            .flat_map(|(corners, _)| *corners)
            .collect()
    };
    let border = has(0).intersection(&has(1)).count();
    assert!(border <= around as usize, "{border} vertices around");
}

/// A lens that is drawn long, whose sides meet at strips that are so wide.
fn lens(width: f64) -> Surface {
    let (across, long) = (8, 4.0);
    let mut surface = Surface::default();
    for i in 0..=across {
        let x = 2.0 * f64::from(i) / f64::from(across) - 1.0;
        let y = 0.3 * (1.0 - x * x) + 0.5 * width;
        for (y, z) in [(-y, 0.0), (y, 0.0), (-y, long), (y, long)] {
            surface.points.push(DVec3::new(x, y, z));
        }
    }
    let mut quad = |[a, b, c, d]: [u32; 4]| surface.triangles.extend([[a, b, c], [a, c, d]]);
    for i in 0..across {
        for sides in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3]] {
            quad(sides.map(|side: u32| 4 * i + side));
        }
    }
    quad([0, 2, 3, 1]);
    quad([0, 1, 3, 2].map(|side| 4 * across + side));
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

/// Strips between the sides of a blade, as flat as they are, are detail: sides meet at an edge then.
#[test]
fn strips_between_sides_of_a_blade_go_where_they_are_detail() {
    let lens = lens(0.01);
    let held = vec![false; lens.points.len()];
    assert!(is_closed(&lens) && smallest_angle(&lens) < 0.2);
    let is_without_strips = |lens: &Surface, made: Option<Remeshed>| {
        let made = made.expect("strips along both edges");
        assert!(made.told.joined > 0, "{:?}", made.told);
        let surface = &made.surface;
        assert!(is_closed(surface));
        let edges = surface
            .triangles
            .iter()
            .flat_map(|t| [0, 1, 2].map(|i| [t[i], t[(i + 1) % 3]]));
        let lengths = edges.map(|ends| {
            let [a, b] = ends.map(|v| surface.points[v as usize]);
            a.distance(b)
        });
        let shortest = lengths.fold(f64::INFINITY, f64::min);
        assert!(shortest > 0.02, "{shortest}");
        let distances = [farthest(surface, lens), farthest(lens, surface)];
        assert!(distances.iter().all(|d| *d <= 0.02), "{distances:?}");
    };
    is_without_strips(&lens, done(&lens, 0.02, &held));
    // A face that has a label of its own stays, without the triangles at the ends of the strips, which are all that it has there.
    let mut walled = lens.clone();
    for (corners, label) in walled.triangles.iter().zip(&mut walled.labels) {
        let is_wall = corners.iter().all(|&v| lens.points[v as usize].z == 0.0);
        *label = u32::from(is_wall);
    }
    let one_of_each = |v: usize| v == 0 || v == 33;
    let ends: Vec<bool> = (0..lens.points.len()).map(one_of_each).collect();
    is_without_strips(&walled, done(&walled, 0.02, &ends));
    // Walls at both ends, that are sharp where the strips meet them.
    let mut leaning = lens.clone();
    (leaning.points.iter_mut()).for_each(|p| p.x += 3.0 * p.z);
    let bound: Vec<u32> = leaning
        .points
        .iter()
        .map(|p| if p.z == 0.0 { 1 } else { 2 })
        .collect();
    let onto = |bit: u32, p: DVec3| DVec3::new(p.x, p.y, 4.0 * f64::from(bit));
    let between_walls = Rules {
        onto: &onto,
        ..rules(0.02, (&held, &[]), (&bound, &[]))
    };
    is_without_strips(&leaning, remesh(&leaning, &between_walls));
    // Within less than the strips are wide, they stay.
    let made = done(&lens, 1e-3, &held);
    assert!(made.is_none_or(|made| made.told.joined == 0));
}

/// A step between two wide facets, much lower than wide, that faces neither way that they do: halves of its needles face as it does.
#[test]
fn needles_that_do_not_face_as_the_shape_are_halved() {
    let rows = [(-2.0, 0.0), (0.0, 0.0), (0.0, 0.01), (2.0, 0.01)];
    let ends = [0.0, 4.0];
    let points = rows.into_iter().flat_map(|(x, y)| {
        // Twisted, so that no two triangles are in one plane.
        ends.map(|z: f64| DVec3::new(x + 0.001 * y * z, y + 0.01 * x * x * z, z))
    });
    let surface = Surface {
        points: points.collect(),
        triangles: (0..3)
            .flat_map(|i| [[0, 1, 3], [0, 3, 2]].map(|t| t.map(|v| 2 * i + v)))
            .collect(),
        labels: vec![0; 6],
    };
    let bound = vec![0; surface.points.len()];
    let held = vec![false; surface.points.len()];
    let rules = Rules {
        // Nothing is a feature.
        feature: -1.0,
        ..rules(0.05, (&held, &[]), (&bound, &[]))
    };
    with_mesh(&surface, rules, |mesh| {
        assert_eq!(mesh.planes.len(), 1);
        // The diagonal of the step, between its two needles.
        assert!(split(mesh, [2, 5]));
        assert_eq!(mesh.at_edge(2, 5), []);
    });
}

/// Half a cylinder of strips, a power of two, whose ends are drawn with ears cut off their rims, and off what is left, and so on.
fn half_cylinder(strips: u32) -> Surface {
    let rim = |i: u32, z: f64| {
        let a = std::f64::consts::PI * f64::from(i) / f64::from(strips);
        DVec3::new(a.cos(), a.sin(), z)
    };
    let mut surface = Surface {
        points: (0..=strips)
            .flat_map(|i| [rim(i, 0.0), rim(i, 1.0)])
            .collect(),
        ..Surface::default()
    };
    let [low, high] = [|i: u32| 2 * i, |i: u32| 2 * i + 1];
    let mut add = |triangle, label| {
        surface.triangles.push(triangle);
        surface.labels.push(label);
    };
    for i in 0..strips {
        add([low(i), low(i + 1), high(i)], 0);
        add([high(i), low(i + 1), high(i + 1)], 0);
    }
    let mut step = 1;
    while 2 * step <= strips {
        for i in (0..strips).step_by(2 * step as usize) {
            let [j, k] = [i + step, i + 2 * step];
            add([low(i), low(k), low(j)], 1);
            add([high(i), high(j), high(k)], 2);
        }
        step *= 2;
    }
    add([low(0), high(0), low(strips)], 3);
    add([low(strips), high(0), high(strips)], 3);
    surface
}

/// A surface that is drawn so, remeshed within 0.02.
fn remade(surface: &Surface, drawn: Drawn) -> Option<Remeshed> {
    let none = vec![false; surface.points.len()];
    let bound = vec![0; surface.points.len()];
    let rules = Rules {
        noise: 1e-9,
        drawn,
        ..rules(0.02, (&none, &[]), (&bound, &[]))
    };
    remesh(surface, &rules)
}

/// What is drawn exactly is given up where strips are far longer than wide, so that they would be nearly all of the mesh, and not where they are
/// about as long as wide, or as wide as edges are wanted.
#[test]
fn an_exact_drawing_is_given_up_where_its_strips_cost_more_than_the_shape() {
    let done = |strips: u32, longer: f64| {
        let mut surface = half_cylinder(strips);
        surface.points.iter_mut().for_each(|p| p.z *= longer);
        remade(&surface, Drawn::Exactly)
    };
    assert!(done(64, 4.0).is_some());
    assert!(done(32, 0.05).is_none());
    assert!(done(8, 4.0).is_none());
}

/// Edges around what has a radius of five deviations are four of these long, so that what is nearer together than one of them is detail, and not as short as turns
/// of 30 degrees would have them. Around a radius of twenty they turn by that.
#[test]
fn edges_around_small_roundings_are_no_shorter_than_detail_allows() {
    let triangle_around = |radius: f64| {
        let mut surface = half_cylinder(32);
        let scaled = |p: &DVec3| DVec3::new(radius * p.x, radius * p.y, 4.0 * p.z);
        surface.points = surface.points.iter().map(scaled).collect();
        let made = remade(&surface, Drawn::Roughly).expect("strips").surface;
        let curved = (0..).zip(&made.labels).filter(|(_, label)| **label == 0);
        let areas: Vec<f64> = curved
            .map(|(t, _)| {
                let [a, b, c] = made.corners(t);
                geom::measure::triangle_area(a, b, c)
            })
            .collect();
        let side = radius * std::f64::consts::TAU / 12.0;
        areas.iter().sum::<f64>() / areas.len() as f64 / (0.75_f64.sqrt() / 2.0 * side * side)
    };
    let [small, large] = [5.0, 20.0].map(|times| triangle_around(times * 0.02));
    assert!(small > 1.5 && large < 1.5, "{small} {large}");
}

/// Strips that lie side by side within an edge's length are joined while they are halved: they do not get as many vertices each as one that is as wide as
/// edges are to be.
#[test]
fn needles_side_by_side_are_not_all_divided() {
    let (strips, longer) = (256, 32.0);
    let mut surface = half_cylinder(strips);
    surface.points.iter_mut().for_each(|p| p.z *= longer);
    let made = remade(&surface, Drawn::Roughly).expect("fine strips");
    let turn = std::f64::consts::TAU / 12.0;
    let all = f64::from(strips) * longer / turn;
    assert!((made.told.split as f64) < all, "{:?} {all}", made.told);
}

/// Facets that are as long as the body is high may be there for a symmetry about z, of a wedge that has several of them; those that are longest around z
/// are not.
#[test]
fn strips_around_the_axis_are_not_there_for_the_sake_of_a_symmetry() {
    let done = |place: fn(DVec3) -> DVec3, drawn: Drawn| {
        let mut surface = half_cylinder(64);
        let stretched = |p: &DVec3| place(DVec3::new(p.x, p.y, 4.0 * p.z));
        surface.points = surface.points.iter().map(stretched).collect();
        remade(&surface, drawn).is_some()
    };
    let along = |p: DVec3| p;
    let around = |p: DVec3| DVec3::new(p.z - 2.0, p.x + 10.0, p.y);
    assert!(done(along, Drawn::Exactly) && done(around, Drawn::Exactly));
    assert!(!done(along, Drawn::ExactlyAbout) && done(around, Drawn::ExactlyAbout));
}

/// A prism over a square of side 2, of which the corner at (1, 1) is cut off by a strip so wide.
fn cut_off(width: f64) -> Surface {
    let off = width / std::f64::consts::SQRT_2;
    let outline = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 1.0 - off],
        [1.0 - off, 1.0],
        [-1.0, 1.0],
    ];
    upright(&outline, 1.0)
}

/// An upright prism over a polygon whose first corner sees all of it, from 0 to a height; ends and sides have one label.
fn upright(outline: &[[f64; 2]], height: f64) -> Surface {
    let n = outline.len() as u32;
    let level = |z: f64| outline.iter().map(move |p| DVec3::new(p[0], p[1], z));
    let fan = (1..n - 1).flat_map(|i| [[0, i + 1, i], [n, n + i, n + i + 1]]);
    let sides = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i]]
    });
    let triangles: Vec<[u32; 3]> = fan.chain(sides).collect();
    Surface {
        points: level(0.0).chain(level(height)).collect(),
        labels: vec![0; triangles.len()],
        triangles,
    }
}

/// A corner that was cut off by less than the surface may move is where the faces beside it meet, whether it is drawn exactly or not; these stay where they are.
#[test]
fn faces_meet_where_a_corner_was_cut_off_by_less_than_the_deviation() {
    let done = |width: f64, drawn: Drawn| remade(&cut_off(width), drawn);
    for drawn in [Drawn::Exactly, Drawn::Roughly] {
        let sharp = done(0.01, drawn).expect("a corner").surface;
        assert_eq!((sharp.points.len(), sharp.triangles.len()), (8, 12));
        for p in &sharp.points {
            assert!(p.x.abs() == 1.0 && p.y.abs() == 1.0, "{p}");
        }
        assert!(is_closed(&sharp));
        // What is wider is a face.
        assert!(done(0.05, drawn).is_none_or(|wide| wide.surface.points.len() == 10));
    }
    assert!(done(0.01, Drawn::Kept).is_none());
}

/// The edge of a sheet is as narrow as that, but the faces beside it do not meet.
#[test]
fn the_edge_of_a_sheet_stays() {
    let sheet = upright(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]], 0.01);
    for drawn in [Drawn::Exactly, Drawn::Roughly] {
        let done = remade(&sheet, drawn);
        let after = done.map_or(sheet.clone(), |done| done.surface);
        assert!((volume(&after) - volume(&sheet)).abs() < 1e-12);
        assert!(farthest(&sheet, &after) < 1e-12);
    }
}

/// Needles that lean, because their vertices are off the shape by as much as they are wide, go one by one: what takes their place leans as well.
#[test]
fn needles_that_lean_go_though_others_like_them_stay() {
    let columns = [-1.0, 0.0, 0.01, 1.0];
    let points = columns
        .into_iter()
        .flat_map(|x: f64| [0.0, 1.0, 2.0].map(|y| DVec3::new(x, y, 0.05 * x * x + 0.01 * y * x)));
    let quads = (0..3).flat_map(|i| [0, 1].map(|j| 3 * i + j));
    let surface = Surface {
        points: points.collect(),
        triangles: quads
            .flat_map(|v| [[v, v + 3, v + 4], [v, v + 4, v + 1]])
            .collect(),
        labels: vec![0; 12],
    };
    let bound = vec![0; surface.points.len()];
    let held = vec![false; surface.points.len()];
    let rules = rules(0.05, (&held, &[]), (&bound, &[]));
    with_mesh(&surface, rules, |mesh| {
        assert_eq!(mesh.planes, [None]);
        // The middle of the second column of two that are next to each other; its ends, which are on the border, are less far off.
        for (v, off) in [(6, 0.012), (7, 0.016), (8, 0.012)] {
            mesh.points[v].z += off;
        }
        assert!(collapse(mesh, [7, 4], false));
    });
}

#[test]
fn a_fine_drawing_gets_about_as_many_triangles_as_a_coarse_one() {
    let count = |strips: u32| {
        let surface = half_cylinder(strips);
        assert!(is_closed(&surface));
        let none = vec![false; surface.points.len()];
        let done = sized(&surface, 0.1, (&none, Some(1.0))).map(|done| done.surface);
        let done = done.unwrap_or_else(|| surface.clone());
        assert!(is_closed(&done));
        assert!((volume(&done) / volume(&surface) - 1.0).abs() < 0.1);
        done.triangles.len()
    };
    let coarse = count(8);
    for strips in [64, 256] {
        let fine = count(strips);
        assert!(2 * fine <= 3 * coarse, "{fine} for {coarse}");
    }
}

/// A vertex of a rim goes though the flat end is drawn with an ear at it, which is gone then; not where nothing else of the end would be left.
#[test]
fn rims_get_coarser_where_the_flat_face_has_an_ear() {
    let surface = half_cylinder(32);
    let (bound, held) = (vec![0; 66], vec![false; 66]);
    let rules = rules(0.1, (&held, &[1.0; 8]), (&bound, &[]));
    with_mesh(&surface, rules, |mesh| {
        let [first, ear, next] = [0, 2, 4];
        let ends = |mesh: &Mesh<'_>| {
            let there = (0..mesh.triangles.len()).filter(|&t| mesh.is_there(t as u32));
            let corners = there.map(|t| mesh.triangles[t]);
            corners.filter(|t| t.iter().all(|v| v % 2 == 0)).count()
        };
        let before = ends(mesh);
        assert!(mesh.neighbours(first).contains(&next) && mesh.curve(first, next).is_none());
        assert!(collapse(mesh, [ear, first], false));
        assert!(mesh.curve(first, next).is_some());
        assert_eq!((ends(mesh), mesh.around(ear)), (before - 1, &[][..]));
    });
    // One triangle at each end: the rim has nowhere to go.
    let surface = half_cylinder(2);
    let (bound, held) = (vec![0; 6], vec![false; 6]);
    let rules = self::rules(2.0, (&held, &[1.0; 8]), (&bound, &[]));
    with_mesh(&surface, rules, |mesh| {
        assert!(!collapse(mesh, [2, 0], false));
    });
}

/// Edges of a curve that another one was joined to are as far from it as other curves may be where something else is near, and not as what was joined.
#[test]
fn curves_that_were_joined_stay_near_where_walls_are_thin() {
    let surface = half_cylinder(32);
    let (bound, held) = (vec![0; 66], vec![false; 66]);
    let goes = |nearer: &[f64]| {
        let lengths = [1.0; 8];
        let usual = rules(0.1, (&held, &lengths), (&bound, &[]));
        let rules = Rules {
            nearer,
            noise: 1e-6,
            ..usual
        };
        with_mesh(&surface, rules, |mesh| {
            mesh.loose.iter_mut().for_each(|loose| *loose = true);
            collapse(mesh, [4, 2], false)
        })
    };
    let [a, b, c] = [2, 4, 6].map(|v| surface.points[v]);
    let off = geom::measure::distance_to_segment(b, a, c);
    // The curved face is half as far off in the middle between both rims, where points of it are looked at.
    assert!(goes(&[]) && goes(&[1.1 * off; 66]));
    assert!(!goes(&[0.9 * off; 66]));
}

/// What `look` finds in the mesh of two triangles in a plane, on both sides of the edge from the first point to the second.
fn with_two_triangles(points: [[f64; 2]; 4], look: impl FnOnce(&mut Mesh<'_>)) {
    let surface = Surface {
        points: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
        triangles: vec![[0, 1, 2], [1, 0, 3]],
        labels: vec![0; 2],
    };
    let (bound, held) = ([0; 4], [false; 4]);
    with_mesh(&surface, rules(0.1, (&held, &[]), (&bound, &[])), look);
}

/// Flat faces have a curved one beside them that gets coarser: their needles hinder that, and are flipped.
#[test]
fn needles_of_flat_faces_are_flipped() {
    with_two_triangles([[0.0, 0.0], [4.0, 0.0], [2.0, 0.5], [2.0, -0.5]], |mesh| {
        assert!(mesh.planes[0].is_some());
        assert!(flip(mesh, [0, 1]));
        assert_eq!((mesh.at_edge(0, 1).len(), mesh.at_edge(2, 3).len()), (0, 2));
        assert!(!flip(mesh, [2, 3]));
    });
}

/// Of needles in one line, none is flipped to a good triangle at once. These are 20,000 and 40,000 times as long as high.
#[test]
fn needles_are_flipped_to_wider_ones_however_narrow_those_are() {
    with_two_triangles(
        [[0.0, 0.0], [4.0, 0.0], [2.0, 2e-4], [3.0, -1e-4]],
        |mesh| {
            let before = mesh.worst_shape(&[0, 1]);
            assert!(flip(mesh, [0, 1]));
            let after = mesh.worst_shape(&mesh.at_edge(2, 3));
            assert!(before < after && after < 1e-3, "{before} {after}");
            assert!(!flip(mesh, [2, 3]));
        },
    );
}

/// A cylinder with flat ends, beside whose upper edge there is a vertex below the middle of every side, and as far outside: the triangle
/// there leans by half a right angle and has features on both sides.
fn caps_beside_a_flat_end(around: u32, below: f64) -> Surface {
    let at = |i: u32, z: f64| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(around);
        DVec3::new(angle.cos(), angle.sin(), z)
    };
    let points = (0..around).flat_map(|i| {
        let middle = 0.5 * (at(i, 1.0) + at(i + 1, 1.0));
        let outward = DVec3::new(middle.x, middle.y, 0.0).normalize();
        let middle = middle + (outward - DVec3::Z) * below;
        [at(i, -1.0), at(i, 1.0), middle]
    });
    let mut surface = Surface {
        points: points.chain([-DVec3::Z, DVec3::Z]).collect(),
        ..Surface::default()
    };
    let ends = [3 * around, 3 * around + 1];
    for i in 0..around {
        let [low, high, middle] = [3 * i, 3 * i + 1, 3 * i + 2];
        let [next, above] = [low, high].map(|v| (v + 3) % (3 * around));
        surface.triangles.extend([
            [low, next, middle],
            [low, middle, high],
            [next, above, middle],
            [high, middle, above],
            [ends[0], next, low],
            [ends[1], high, above],
        ]);
    }
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

#[test]
fn needles_beside_the_edge_of_a_flat_face_go_without_bending_it() {
    let surface = caps_beside_a_flat_end(24, 1e-5);
    let free = vec![false; surface.points.len()];
    let made = done(&surface, 1e-3, &free).expect("needles").surface;
    let lowest = made.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| made.points[v as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).cross(c - a).length() / longest
    });
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    assert!(lowest > 1e-3, "{lowest:e}");
    let on_top = made.points.iter().filter(|p| p.z > 0.999);
    assert!(on_top.clone().count() > 24 && on_top.clone().all(|p| p.z == 1.0));
}

/// A cylinder of so many strips, four times as high as wide, with a flat end and a cone half as high as wide on the other one.
fn pencil(around: u32) -> Surface {
    let at = |i: u32, z: f64| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(around);
        DVec3::new(angle.cos(), angle.sin(), z)
    };
    let rims = (0..around).flat_map(|i| [at(i, 0.0), at(i, 8.0)]);
    let mut surface = Surface {
        points: rims.chain([DVec3::ZERO, 9.0 * DVec3::Z]).collect(),
        ..Surface::default()
    };
    let [end, tip] = [2 * around, 2 * around + 1];
    for i in 0..around {
        let [low, high] = [2 * i, 2 * i + 1];
        let [next, above] = [low, high].map(|v| (v + 2) % (2 * around));
        surface.triangles.extend([
            [low, next, high],
            [high, next, above],
            [end, next, low],
            [tip, high, above],
        ]);
    }
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

#[test]
fn strips_beside_what_is_remeshed_are_remeshed_where_they_do_not_stay_flat() {
    // The cone has needles; once the rim has other vertices, so has the cylinder, which is drawn coarsely enough.
    let surface = pencil(22);
    let free = vec![false; surface.points.len()];
    let made = done(&surface, 0.1, &free).expect("needles").surface;
    assert!(is_closed(&made));
    let on_side = |t: &&[u32; 3]| {
        let [low, high] = t
            .iter()
            .map(|&v| made.points[v as usize].z)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
                [low.min(z), high.max(z)]
            });
        low < 7.9 && high > 0.1
    };
    let side = Surface {
        points: made.points.clone(),
        triangles: made.triangles.iter().filter(on_side).copied().collect(),
        labels: Vec::new(),
    };
    let angle = smallest_angle(&side);
    assert!(angle > 15.0, "{angle}");
}

#[test]
fn a_facet_that_is_narrow_only_at_its_end_costs_more_than_a_strip() {
    let cost = |points: Vec<DVec3>, triangles: Vec<[u32; 3]>| {
        let surface = Surface {
            labels: vec![0; triangles.len()],
            points,
            triangles,
        };
        let held = vec![false; surface.points.len()];
        let bound = vec![0; surface.points.len()];
        let rules = rules(1e-3, (&held, &[]), (&bound, &[]));
        with_mesh(&surface, rules, |mesh| {
            slenderness(&mesh.points, &mesh.triangles, &mesh.facets())
        })
    };
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    // As large, and as long around.
    let strip = cost(
        vec![at(0.0, 0.0), at(10.0, 0.0), at(10.0, 0.02), at(0.0, 0.02)],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let wedge = cost(
        vec![at(0.0, 0.0), at(10.0, 0.0), at(10.0, 0.04)],
        vec![[0, 1, 2]],
    );
    assert!(wedge > 1.2 * strip, "{wedge} {strip}");
}

/// A square plate with a hole of 32 corners in its middle. What faces all around has no direction in the mean, to the last bit.
fn plate_with_a_hole() -> Surface {
    // Of 33.2 units from the middle, and the corner of the square.
    #[rustfmt::skip]
    let quadrant = [
        [33, 4], [32, 9], [31, 12], [24, 23], [23, 24], [12, 31], [9, 32], [4, 33], [64, 64],
    ];
    let turned = |[x, y]: [i32; 2], times: usize| (0..times).fold([x, y], |[x, y], _| [-y, x]);
    let mut surface = Surface::default();
    for z in [0, 16] {
        for k in 0..4 {
            let points = quadrant.map(|p| turned(p, k));
            let points = points.map(|[x, y]| [x, y, z].map(f64::from));
            surface.points.extend(points.map(DVec3::from_array));
        }
    }
    let at = |k: u32, i: u32, up: u32| 36 * up + 9 * (k % 4) + i;
    let mut add = |[a, b, c]: [u32; 3], label| {
        surface.triangles.push([a, b, c]);
        surface.labels.push(label);
    };
    let next = |k: u32, i: u32| if i < 7 { (k, i + 1) } else { (k + 1, 0) };
    // What cancels out follows each other.
    for (i, k) in (0..8).flat_map(|i| [0, 2, 1, 3].map(|k| (i, k))) {
        let (l, j) = next(k, i);
        add([at(k, i, 0), at(k, i, 1), at(l, j, 0)], 0);
        // Around the corner.
        add([at(k, 8, 1), at(l, j, 1), at(k, i, 1)], 1);
        add([at(k, 8, 0), at(k, i, 0), at(l, j, 0)], 2);
    }
    for (i, k) in (0..8).flat_map(|i| [0, 2, 1, 3].map(|k| (i, k))) {
        let (l, j) = next(k, i);
        add([at(k, i, 1), at(l, j, 1), at(l, j, 0)], 0);
    }
    for k in 0..4 {
        add([at(k, 8, 1), at(k + 1, 8, 1), at(k + 1, 0, 1)], 1);
        add([at(k, 8, 0), at(k + 1, 0, 0), at(k + 1, 8, 0)], 2);
        add([at(k, 8, 0), at(k + 1, 8, 0), at(k, 8, 1)], 3);
        add([at(k, 8, 1), at(k + 1, 8, 0), at(k + 1, 8, 1)], 3);
    }
    surface
}

#[test]
fn what_faces_all_around_is_curved() {
    let plate = plate_with_a_hole();
    assert!(is_closed(&plate));
    let none = vec![false; plate.points.len()];
    let bound = vec![0; plate.points.len()];
    let rules = Rules {
        noise: 1e-9,
        ..rules(4.0, (&none, &[64.0; 4]), (&bound, &[]))
    };
    let done = remesh(&plate, &rules).expect("a coarser hole");
    assert!(is_closed(&done.surface));
    let of_the_hole = |surface: &Surface| surface.labels.iter().filter(|&&l| l == 0).count();
    let [drawn, coarser] = [&plate, &done.surface].map(of_the_hole);
    assert!(2 * coarser <= drawn, "{coarser} of {drawn}");
    assert!((volume(&done.surface) / volume(&plate) - 1.0).abs() < 0.05);
}

/// An edge that cuts off a fold is nearer to the facets beside it than to the fold.
#[test]
fn folds_are_no_farther_from_the_surface_than_the_deviation() {
    let (strips, deviation) = (4, 0.05);
    let surface = half_cylinder(strips);
    let held = vec![false; surface.points.len()];
    let bound = vec![0; surface.points.len()];
    let rules = Rules {
        // Folds of 45 degrees are none.
        feature: 0.25,
        ..rules(deviation, (&held, &[f64::INFINITY; 4]), (&bound, &[]))
    };
    with_mesh(&surface, rules, |mesh| {
        let patch = Near::Patch(mesh.patch[2]);
        let is_held_below = |by: f64| {
            let p = DVec3::new(0.0, 1.0 - by, 0.5);
            let ahead = DVec3::new(0.0, 0.0, 0.01);
            mesh.envelope.holds(patch, [p - ahead, p + ahead], 0.0)
        };
        assert!(is_held_below(0.99 * deviation));
        assert!(!is_held_below(1.01 * deviation));
    });
}

/// At the poles of a fine drawing facets are as thin as coordinates are uncertain, and turn to and fro: a cube with rounded edges that was drawn
/// with 600 facets in a turn got edges of a twenty-fifth of the length asked for along its roundings.
#[test]
fn facets_as_thin_as_noise_do_not_tell_how_the_surface_bends() {
    let (noise, flat) = (1e-6, 2e-6);
    let (around, rings) = (400, 5);
    let shortest = |noise: f64| {
        let mut globe = globe(around, 200);
        for (i, p) in (0_u32..).zip(&mut globe.points[2..][..(rings * around) as usize]) {
            // Scattered from -1 to 1.
            let off = 2.0 * f64::from(i.wrapping_mul(2_654_435_769)) / f64::from(u32::MAX) - 1.0;
            *p *= 1.0 + noise * off;
        }
        let (held, bound) = (vec![false; globe.points.len()], vec![0; globe.points.len()]);
        let mut rules = rules(1e-3, (&held, &[]), (&bound, &[]));
        rules.flat = flat;
        rules.sizes.turn_is_asked = true;
        let least = |mesh: &mut Mesh<'_>| mesh.size.iter().copied().fold(f64::INFINITY, f64::min);
        with_mesh(&globe, rules, least)
    };
    let (smooth, rough) = (shortest(0.0), shortest(noise));
    assert!(rough > 0.9 * smooth, "{rough} for {smooth}");
}

/// A body between polygons of as many points each, one above the other, with a fan of triangles from one of these points at both ends.
fn lofted(rings: &[Vec<DVec3>], first: u32) -> Surface {
    let around = rings[0].len() as u32;
    let mut surface = Surface {
        points: rings.concat(),
        ..Surface::default()
    };
    for (ring, _) in (0..).zip(&rings[1..]) {
        for i in 0..around {
            let [a, b] = [i, (i + 1) % around].map(|i| ring * around + i);
            let sides = [[a, b, b + around], [a, b + around, a + around]];
            surface.triangles.extend(sides);
        }
    }
    let last = (rings.len() as u32 - 1) * around;
    for i in 1..around - 1 {
        let [a, b] = [i, i + 1].map(|i| (first + i) % around);
        surface.triangles.push([first, b, a]);
        surface.triangles.push([last + first, last + a, last + b]);
    }
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

/// A square of this half width at a height.
fn square(half: f64, z: f64) -> Vec<DVec3> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let corner = |[x, y]: [f64; 2]| DVec3::new(half * x, half * y, z);
    corners.into_iter().map(corner).collect()
}

/// A block with a smaller one on it.
fn stepped(height: f64) -> Surface {
    let rings = [(1.0, 0.0), (1.0, 1.0), (0.5, 1.0), (0.5, 1.0 + height)];
    lofted(&rings.map(|(half, z)| square(half, z)), 0)
}

/// How many flat faces there are.
fn count_of_faces(surface: &Surface) -> usize {
    let none = vec![false; surface.points.len()];
    let bound = vec![0; surface.points.len()];
    let rules = rules(0.02, (&none, &[]), (&bound, &[]));
    let mut faces = Patches::of_facets(surface, &rules).of;
    faces.sort_unstable();
    faces.dedup();
    faces.len()
}

/// A step that is no higher than half of the deviation is gone, up or down, and what is left is a block; a higher one is there to the last bit.
#[test]
fn low_steps_between_flat_faces_are_gone() {
    for height in [0.009, -0.009] {
        let before = stepped(height);
        assert_eq!(count_of_faces(&before), 11);
        for drawn in [Drawn::Roughly, Drawn::Exactly] {
            let made = remade(&before, drawn).expect("a step").surface;
            assert_eq!(count_of_faces(&made), 6);
            assert!(is_closed(&made));
            assert!((volume(&made) - 4.0).abs() < 1e-12, "{}", volume(&made));
            assert!(farthest(&made, &before).max(farthest(&before, &made)) <= 0.02);
        }
    }
    let before = stepped(0.011);
    let heights = |surface: &Surface| -> FxHashSet<u64> {
        surface.points.iter().map(|p| p.z.to_bits()).collect()
    };
    let made = remade(&before, Drawn::Roughly).map_or(before.clone(), |made| made.surface);
    assert_eq!(heights(&made), heights(&before));
}

/// A block of two parts: the second one stands above the first one by so much, and below its top reaches so deep into it. The first has label 0,
/// the second 1, and what is between them 2.
fn inlaid(above: f64, depth: f64) -> Surface {
    let rings = [(1.0, 0.0), (1.0, 1.0), (0.5, 1.0), (0.5, 1.0 - depth)];
    let rings = &rings[..if depth > 0.0 { 4 } else { 3 }];
    let rings: Vec<Vec<DVec3>> = rings.iter().map(|(half, z)| square(*half, *z)).collect();
    let mut surface = lofted(&rings, 0);
    for (corners, label) in surface.triangles.iter().zip(&mut surface.labels) {
        let inside = corners.iter().filter(|&&v| v >= 8).count();
        let is_between = inside == 3 && corners.iter().all(|v| *v < 16);
        *label = if is_between { 2 } else { 0 };
    }
    let second = lofted(&[square(0.5, 1.0), square(0.5, 1.0 + above)], 0);
    let first = surface.points.len() as u32;
    surface.points.extend(&second.points[4..]);
    for corners in second.triangles {
        if corners.iter().any(|v| *v >= 4) {
            let number = |v: u32| if v < 4 { v + 8 } else { first + v - 4 };
            surface.triangles.push(corners.map(number));
            surface.labels.push(1);
        }
    }
    surface
}

/// What stands above something else that it is a part of comes to the level of that; what lies on it does not, nor does a sheet, whose faces look away
/// from each other.
#[test]
fn parts_that_are_inlaid_come_to_one_level() {
    let highest = |surface: &Surface| surface.points.iter().fold(0.0, |z: f64, p| z.max(p.z));
    let area = |surface: &Surface, label: u32| -> f64 {
        let all = (0..).zip(&surface.labels).filter(|(_, l)| **l == label);
        let areas = all.map(|(t, _)| {
            let [a, b, c] = surface.corners(t);
            geom::measure::triangle_area(a, b, c)
        });
        areas.sum()
    };
    let before = inlaid(0.009, 0.3);
    for drawn in [Drawn::Exactly, Drawn::Roughly] {
        let made = remade(&before, drawn).expect("a step").surface;
        assert_eq!(highest(&made), 1.0);
        for (label, expected) in [(0, 15.0), (1, 1.0), (2, 2.2)] {
            let area = area(&made, label);
            assert!((area - expected).abs() < 1e-9, "{label}: {area}");
        }
    }
    let lying = inlaid(0.009, 0.0);
    let sheet = lofted(&[square(1.0, 0.0), square(1.0, 0.009)], 0);
    for before in [lying, sheet] {
        let made = remade(&before, Drawn::Roughly).map_or(before.clone(), |made| made.surface);
        assert_eq!(highest(&made), highest(&before));
        assert_eq!(count_of_faces(&made), count_of_faces(&before));
    }
}

/// A band around a block with rounded edges: all of its strips get to the level of those below.
#[test]
fn steps_go_all_around_rounded_edges() {
    let outline = |wider: f64, z: f64| -> Vec<DVec3> {
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let corner = |(i, [x, y]): (usize, [f64; 2])| {
            (0..=4).map(move |k| {
                let angle = std::f64::consts::FRAC_PI_8 * f64::from(4 * i as u32 + k);
                let away = DVec3::new(angle.cos(), angle.sin(), 0.0) * (0.4 + wider);
                DVec3::new(x, y, z) + away
            })
        };
        corners.into_iter().enumerate().flat_map(corner).collect()
    };
    // The same distance for each of the strips, that of their corners is larger.
    let wider = 0.009 / libm::cos(std::f64::consts::FRAC_PI_8 / 2.0);
    let rings = [(0.0, 0.0), (0.0, 2.0), (wider, 2.0), (wider, 3.0)];
    let before = lofted(&rings.map(|(wider, z)| outline(wider, z)), 0);
    let made = remade(&before, Drawn::Roughly).expect("a step").surface;
    assert!(is_closed(&made));
    for p in &made.points {
        assert!(p.truncate().abs().max_element() <= 1.4 + 1e-12, "{p}");
    }
    assert!(farthest(&made, &before).max(farthest(&before, &made)) <= 0.02);
}

/// A step that goes on in the image of a wedge: both ends of a bar stay images of each other, whether they are shifted or turned, but for rounding.
#[test]
fn steps_go_where_faces_are_images_of_each_other() {
    let outline = [
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.009],
        [1.3, 1.009],
        [1.3, 1.0],
        [1.0, 1.0],
    ];
    let shifted = |by: f64| -> Place { Arc::new(move |p| p + by * DVec3::Y) };
    let turned = |by: f64| -> Place {
        let turned = DMat3::from_rotation_z(by);
        Arc::new(move |p| turned * p)
    };
    let seventh = std::f64::consts::TAU / 7.0;
    for (image, back) in [
        (shifted(0.7), shifted(-0.7)),
        (turned(seventh), turned(-seventh)),
    ] {
        // As far off the planes as counts as in them.
        let first = (0..).zip(outline).map(|(i, [x, z])| {
            let off = [3e-11, -3e-11][i % 2];
            DVec3::new(x + off, 0.0, z + [off, -off][i / 2 % 2])
        });
        let first: Vec<DVec3> = first.collect();
        let second: Vec<DVec3> = first.iter().map(|&p| image(p)).collect();
        let mut before = lofted(&[first, second], 4);
        for corners in &mut before.triangles {
            corners.reverse();
        }
        for (corners, label) in before.triangles.iter().zip(&mut before.labels) {
            let low = corners.iter().filter(|v| **v < 6).count();
            *label = [2, 0, 0, 1][low];
        }
        let links = [Link {
            pairs: (0..6).map(|v| [v, v + 6]).collect(),
            labels: vec![1, 2],
            image: Arc::clone(&image),
            back,
        }];
        let free = vec![false; before.points.len()];
        let made = linked(&before, 0.02, (&free, None), &links).expect("a step");
        assert!(is_closed(&made.surface));
        assert_eq!(count_of_faces(&made.surface), 6);
        let end = |label: u32| -> FxHashSet<u32> {
            let all = made.surface.triangles.iter().zip(&made.surface.labels);
            let all = all.filter(|(_, l)| **l == label);
            all.flat_map(|(corners, _)| *corners).collect()
        };
        assert_eq!(made.links[0].len(), end(1).len());
        assert_eq!(made.links[0].len(), end(2).len());
        for pair in &made.links[0] {
            let [p, q] = pair.map(|v| made.surface.points[v as usize]);
            let off = image(p).distance(q);
            assert!(off <= 64.0 * f64::EPSILON * 2.0, "{p} {q}: {off:e}");
        }
    }
}

/// Where vertices are joined at both ends of a bar and those that stay were moved at one end only, by as little as counts as one place, they are images of each other
/// but for rounding afterwards.
#[test]
fn what_is_joined_is_where_its_image_says() {
    let outline = [
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.009],
        [1.3, 1.009],
        [1.3, 1.0],
        [1.0, 1.0],
    ];
    let turn = DMat3::from_rotation_z(0.94);
    let first = outline.map(|[x, z]| DVec3::new(x, 0.0, z)).to_vec();
    let second: Vec<DVec3> = first.iter().map(|&p| turn * p).collect();
    let before = lofted(&[first, second], 4);
    let links = [Link {
        pairs: (0..6).map(|v| [v, v + 6]).collect(),
        labels: Vec::new(),
        image: Arc::new(move |p| turn * p),
        back: Arc::new(move |p| turn.transpose() * p),
    }];
    let mut places = before.points.clone();
    for (v, to) in [(4, 3), (10, 9)] {
        places[v] = before.points[to];
    }
    for v in [5, 11] {
        places[v].z = 1.009;
    }
    places[9].z += 5e-11;
    // Of these the first is moved, and its image is where nothing is taken to the bit by way of where it came from.
    for v in [0, 1, 2] {
        places[v].z += 5e-11;
    }
    let free = vec![false; before.points.len()];
    let bound = vec![0; before.points.len()];
    let rules = rules(0.02, (&free, &[]), (&bound, &links));
    let patches = Patches::of_facets(&before, &rules);
    let made = contracted(&before, &rules, &patches, &places).expect("joined");
    assert_eq!((made.links[0].len(), made.surface.points.len()), (5, 10));
    for pair in &made.links[0] {
        let [p, q] = pair.map(|v| made.surface.points[v as usize]);
        assert_eq!(turn * p, q);
    }
}

/// A plate whose top is at a height of its own above each square of a grid, with upright walls between these.
fn terrain(heights: &[Vec<f64>]) -> Surface {
    let n = heights.len();
    let cell = |i: i32, j: i32| -> Option<f64> {
        let [i, j] = [usize::try_from(i).ok()?, usize::try_from(j).ok()?];
        heights.get(i)?.get(j).copied()
    };
    let mut surface = Surface::default();
    let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    let mut id = |surface: &mut Surface, p: DVec3| {
        let key = p.to_array().map(f64::to_bits);
        *known.entry(key).or_insert_with(|| {
            surface.points.push(p);
            surface.points.len() as u32 - 1
        })
    };
    // The heights between two of them at which squares around a corner end.
    let column = |i: i32, j: i32, [low, high]: [f64; 2]| -> Vec<DVec3> {
        let around = [[0, 0], [-1, 0], [0, -1], [-1, -1]];
        let squares = around.map(|[k, l]| cell(i + k, j + l));
        let mut all: Vec<f64> = squares.into_iter().flatten().chain([low, high]).collect();
        all.retain(|z| (low..=high).contains(z));
        all.sort_by(f64::total_cmp);
        all.dedup();
        let at = |z| DVec3::new(f64::from(i), f64::from(j), z);
        all.into_iter().map(at).collect()
    };
    for i in 0..=n as i32 {
        for j in 0..=n as i32 {
            if let Some(z) = cell(i, j) {
                for (z, turned) in [(z, false), (0.0, true)] {
                    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[k, l]| {
                        let p = DVec3::new(f64::from(i + k), f64::from(j + l), z);
                        id(&mut surface, p)
                    });
                    let [a, b, c, d] = corners;
                    surface.triangles.extend(match turned {
                        false => [[a, b, c], [a, c, d]],
                        true => [[a, c, b], [a, d, c]],
                    });
                }
            }
            for (k, l) in [(1, 0), (0, 1)] {
                let [here, before] = [cell(i, j), cell(i - k, j - l)].map(|z| z.unwrap_or(0.0));
                if here == before {
                    continue;
                }
                let span = [here.min(before), here.max(before)];
                let mut sides = [column(i, j, span), column(i + l, j + k, span)];
                // Seen from where it is lower.
                if (here > before) == (k == 1) {
                    sides.reverse();
                }
                let [left, right] = sides.map(|side| -> Vec<u32> {
                    side.into_iter().map(|p| id(&mut surface, p)).collect()
                });
                for pair in left.windows(2) {
                    surface.triangles.push([pair[0], right[0], pair[1]]);
                }
                for pair in right.windows(2) {
                    surface
                        .triangles
                        .push([left[left.len() - 1], pair[0], pair[1]]);
                }
            }
        }
    }
    surface.labels = vec![0; surface.triangles.len()];
    surface
}

/// Steps of any height beside and above each other: whatever goes, the surface stays closed, does not meet itself and is no farther off than the deviation.
#[test]
fn terraces_stay_whole_whatever_steps_they_have() {
    let mut state = 20_261_130_u64;
    let mut below = |n: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) % n
    };
    const ROUNDS: usize = 60;
    let mut fewer = 0;
    for round in 0..ROUNDS {
        let kinds = [0.0, 0.004, 0.009, 0.013, 0.5];
        let used = 2 + below(4) as usize;
        let n = 2 + below(5) as usize;
        let mut row = || -> Vec<f64> {
            let each = (0..n).map(|_| 1.0 + kinds[below(used.min(5) as u64) as usize]);
            each.collect()
        };
        let heights: Vec<Vec<f64>> = (0..n).map(|_| row()).collect();
        let mut before = terrain(&heights);
        let all: f64 = heights.iter().flatten().sum();
        assert!((volume(&before) - all).abs() < 1e-9, "{round}");
        // Walls lean, and planes are those of no coordinates.
        let turned = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7 * round as f64);
        let lean = [0.0, 0.3][round % 2];
        for p in &mut before.points {
            *p = turned * DVec3::new(p.x + lean * p.z, p.y, p.z);
        }
        let drawn = [Drawn::Roughly, Drawn::Exactly, Drawn::WithNeedles][round % 3];
        let Some(made) = remade(&before, drawn) else {
            continue;
        };
        let after = made.surface;
        fewer += usize::from(2 * after.triangles.len() < before.triangles.len());
        assert_eq!(is_closed(&before), is_closed(&after), "{round}");
        let mut found = 0;
        contacts(
            &after.points,
            &after.triangles,
            |t| t,
            |_| {
                found += 1;
                true
            },
        );
        assert_eq!(found, 0, "{round}: {heights:?}");
        let off = farthest(&after, &before).max(farthest(&before, &after));
        assert!(off <= 0.02 * (1.0 + 1e-9), "{round}: {off}");
        let change = (volume(&after) - volume(&before)).abs();
        assert!(change <= 0.02 * (n * n) as f64, "{round}: {change}");
    }
    assert!(fewer > 20, "{fewer}");
}
