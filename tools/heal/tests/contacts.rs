//! Solids that cross, overlap, touch with different triangles or cross themselves.

mod common;

use bodies::facets::*;
use bodies::rounds::{Circle, cylinder, tube};
use common::*;
use interchange::Format::Stl;

/// The regions and their volumes, and a check that no two triangles of the surface cross.
fn volumes(imported: &heal::Imported) -> Vec<(String, f64)> {
    let template = &imported.document.templates[0];
    let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    geom::contacts::contacts(
        &template.vertices,
        &triangles,
        |t| t,
        |contact| panic!("{contact:?}"),
    );
    let violations = tmesh::validate(&imported.document);
    assert!(violations.is_empty(), "{violations:?}");
    let volume = |r: &tmesh::Region| (r.name.clone(), r.volume.map_or(0.0, round));
    imported.document.regions.iter().map(volume).collect()
}

fn two(a: Vec<Facet>, b: Vec<Facet>) -> heal::Imported {
    good(&ascii_stl(&[("a", a), ("b", b)]), Stl)
}

fn expect(imported: &heal::Imported, wanted: [f64; 2]) {
    let wanted = vec![("a".to_owned(), wanted[0]), ("b".to_owned(), wanted[1])];
    assert_eq!(volumes(imported), wanted, "{:?}", imported.notices);
}

#[test]
fn the_later_one_of_two_solids_that_overlap_has_what_both_claim() {
    let cube = || unit_cube([0.0; 3]);
    let crossing = two(cube(), unit_cube([0.5, 0.25, 0.125]));
    expect(&crossing, [1.0 - 0.328125, 1.0]);
    let said = crossing.notices.join("\n");
    assert!(
        said.contains("solid 'a' and solid 'b' overlap by a volume of 0.328125: solid 'b' has it"),
        "{said}"
    );
    // With faces in common.
    expect(
        &two(
            cuboid([0.0; 3], [1.0, 1.0, 2.0]),
            cuboid([0.0, 0.0, 1.0], [1.0, 1.0, 3.0]),
        ),
        [1.0, 2.0],
    );
}

#[test]
fn a_solid_inside_another_cuts_its_place_out_whichever_is_first() {
    let outer = || cuboid([-1.0; 3], [2.0; 3]);
    let inner = || unit_cube([0.0; 3]);
    expect(&two(outer(), inner()), [26.0, 1.0]);
    let nested = two(inner(), outer());
    expect(&nested, [1.0, 26.0]);
    let said = nested.notices.join("\n");
    assert!(said.contains("solid 'a' lies inside solid 'b'"), "{said}");
    // With a face in common.
    let flush = two(unit_cube([0.0; 3]), cuboid([0.0; 3], [1.0, 1.0, 2.0]));
    expect(&flush, [1.0, 1.0]);
}

#[test]
fn a_solid_that_is_there_twice_is_refused() {
    let said = refused(
        &ascii_stl(&[("a", unit_cube([0.0; 3])), ("b", unit_cube([0.0; 3]))]),
        Stl,
    );
    assert!(said.contains("region 'a' encloses no volume"), "{said}");
}

#[test]
fn edges_along_which_solids_touch_are_divided() {
    // Along a part of an edge from a corner that they have in common, from the middle of it, in the middle of it, and one in the middle
    // of the other.
    for (low, high) in [
        ([1.0, 1.0, 0.0], [2.0, 2.0, 0.52]),
        ([1.0, 1.0, 0.5], [2.0, 2.0, 1.5]),
        ([1.0, 1.0, 0.25], [2.0, 2.0, 0.75]),
        ([1.0, 1.0, -1.0], [2.0, 2.0, 2.0]),
    ] {
        let size: f64 = (0..3).map(|i| high[i] - low[i]).product();
        expect(&two(unit_cube([0.0; 3]), cuboid(low, high)), [1.0, size]);
    }
}

/// Two blocks with a corner in common and an edge of one half of an edge of the other, within eight digits: no vertex is moved by more.
#[test]
fn edges_along_which_rounded_solids_touch_are_divided() {
    const POINTS: [[f64; 3]; 15] = [
        [2.47226984, -2.89819986, -0.56736656],
        [1.10119222, -3.62596397, 1.00008316],
        [0.699408254, -2.72524818, 1.06683593],
        [2.07048587, -1.99748407, -0.500613788],
        [2.62025134, -1.7948605, 0.0743541213],
        [1.24917372, -2.52262461, 1.64180384],
        [1.65095769, -3.4233404, 1.57505106],
        [3.0220353, -2.69557629, 0.00760134927],
        [1.05041522, -2.47992069, -0.130737875],
        [0.33564869, -2.85931673, 0.686400834],
        [-0.544417127, -0.886392884, 0.832615809],
        [0.170349402, -0.506996839, 0.0154771004],
        [0.534108966, -0.372928284, 0.395912194],
        [-0.180657563, -0.752324329, 1.2130509],
        [1.41417478, -2.34585213, 0.249697219],
    ];
    let first = [
        [0, 1, 2],
        [0, 2, 3],
        [4, 5, 6],
        [4, 6, 7],
        [2, 5, 4],
        [2, 4, 3],
        [7, 6, 1],
        [7, 1, 0],
        [3, 4, 7],
        [3, 7, 0],
        [1, 6, 5],
        [1, 5, 2],
    ];
    let second = [
        [8, 9, 10],
        [8, 10, 11],
        [12, 13, 2],
        [12, 2, 14],
        [11, 10, 13],
        [11, 13, 12],
        [14, 2, 9],
        [14, 9, 8],
        [12, 14, 8],
        [12, 8, 11],
        [10, 9, 2],
        [10, 2, 13],
    ];
    let facets = |triangles: [[usize; 3]; 12]| triangles.map(|t| t.map(|v| POINTS[v])).to_vec();
    let imported = two(facets(first), facets(second));
    assert_eq!(volumes(&imported).len(), 2);
    // The last vertex is in the middle of an edge of the first block's.
    let triangles = &imported.document.templates[0].triangles;
    assert!(imported.joined.is_some() && triangles.len() > first.len() + second.len());
}

#[test]
fn faces_that_touch_with_different_triangles_get_the_same_ones() {
    let plate = || cuboid([0.0; 3], [4.0, 3.0, 1.0]);
    // A post in the middle, at an edge, over a corner, and as large as the plate with the other diagonal.
    for (low, high) in [
        ([1.0, 1.0, 1.0], [2.0, 2.0, 3.0]),
        ([0.0, 1.0, 1.0], [2.0, 2.0, 3.0]),
        ([3.0, 2.0, 1.0], [5.0, 5.0, 2.0]),
        ([4.0, 0.5, 0.25], [5.0, 1.5, 0.75]),
    ] {
        let size: f64 = (0..3).map(|i| high[i] - low[i]).product();
        expect(&two(plate(), cuboid(low, high)), [12.0, size]);
    }
    let turned = |f: Facet| {
        let [a, b, c] = f.map(|[x, y, z]| [4.0 - x, y, z + 1.0]);
        [a, c, b]
    };
    let other = plate().into_iter().map(turned).collect();
    expect(&two(plate(), other), [12.0, 12.0]);
    // A tip that touches in a point.
    let tip = [0.5, 0.25, 1.0];
    let (p, q, r) = ([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]);
    let spike = vec![[tip, q, p], [tip, r, q], [tip, p, r], [p, q, r]];
    expect(&two(plate(), spike), [12.0, round(1.0 / 6.0)]);
}

#[test]
fn what_is_off_by_the_precision_touches() {
    let off = 3e-7;
    let upper = cuboid([1.0, 1.0, 1.0 + off], [2.0, 2.0, 3.0]);
    let touching = two(cuboid([0.0; 3], [4.0, 3.0, 1.0]), upper);
    let template = &touching.document.templates[0];
    assert!(
        template
            .triangles
            .iter()
            .any(|t| [t.front, t.back] == [2, 1])
    );
    volumes(&touching);
}

#[test]
fn a_surface_that_crosses_itself_is_the_union_of_itself() {
    let pushed = [unit_cube([0.0; 3]), unit_cube([0.5, 0.25, 0.125])].concat();
    let union = good(&binary_stl(b"", &pushed), Stl);
    assert_eq!(volumes(&union), [("region1".to_owned(), 1.671875)]);
    let said = union.notices.join("\n");
    assert!(
        said.contains("crosses or touches itself") && said.contains("0.328125 more than once"),
        "{said}"
    );
    // Around a common edge.
    let turned = unit_cube([0.0; 3])
        .into_iter()
        .map(|facet| facet.map(|[x, y, z]| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z]));
    let both = [unit_cube([0.0; 3]), turned.collect()].concat();
    volumes(&good(&binary_stl(b"", &both), Stl));
}

/// A bar with a square section of area 1 along a line of which the last piece passes through the first one, `lift` higher:
/// a single shell.
fn bar_through_itself(lift: f64) -> Vec<Facet> {
    // Sections: a corner at the lower left of the way and one at the lower right, and how high they are.
    let sections = [
        ([0.0, 0.5], [0.0, -0.5], 0.0),
        ([3.5, 0.5], [4.5, -0.5], 0.0),
        ([3.5, 2.5], [4.5, 3.5], 0.0),
        ([3.2, 2.5], [3.2, 3.5], 0.0),
        ([2.8, 2.5], [2.8, 3.5], lift),
        ([2.5, 2.5], [1.5, 3.5], lift),
        ([2.5, -2.0], [1.5, -2.0], lift),
    ];
    let corners = sections
        .map(|([a, b], [c, d], z)| [[a, b, z], [c, d, z], [c, d, z + 1.0], [a, b, z + 1.0]]);
    let quad = |[a, b, c, d]: [Point; 4]| [[a, b, c], [a, c, d]];
    let mut facets = Vec::new();
    for pair in corners.windows(2) {
        for i in 0..4 {
            let j = (i + 1) % 4;
            facets.extend(quad([pair[0][i], pair[0][j], pair[1][j], pair[1][i]]));
        }
    }
    let [a, b, c, d] = corners[0];
    facets.extend(quad([d, c, b, a]));
    facets.extend(quad(corners[6]));
    facets
}

#[test]
fn a_single_shell_that_crosses_itself_is_the_union_of_itself() {
    // Only pieces that hang together nowhere were looked at.
    for (lift, common) in [(0.5, 0.5), (0.25, 0.75), (0.0, 1.0)] {
        let imported = good(&ascii_stl(&[("a", bar_through_itself(lift))]), Stl);
        assert_eq!(volumes(&imported)[0].1, 14.0 - common, "{lift}");
        assert!(imported.joined.is_some(), "{lift}");
        let said = imported.notices.join("\n");
        assert!(said.contains("the union of its parts"), "{said}");
    }
    // Beside another solid.
    expect(
        &two(bar_through_itself(0.5), unit_cube([9.0; 3])),
        [13.5, 1.0],
    );
    let apart = good(&ascii_stl(&[("a", bar_through_itself(2.0))]), Stl);
    assert!(apart.joined.is_none() && apart.is_apart);
    assert_eq!(volumes(&apart)[0].1, 14.0);
}

#[test]
fn three_solids_with_one_place_in_common() {
    let solids = [
        ("a", cuboid([0.0; 3], [2.0, 2.0, 1.0])),
        ("b", cuboid([1.0, 1.0, 1.0], [3.0, 3.0, 2.0])),
        ("c", cuboid([0.0, 2.0, 0.0], [2.0, 4.0, 2.0])),
        ("d", cuboid([0.5, 0.5, 0.5], [1.5, 2.5, 1.5])),
    ];
    let imported = good(&ascii_stl(&solids), Stl);
    let volumes: Vec<f64> = volumes(&imported).into_iter().map(|v| v.1).collect();
    // `b` and `c` share 1 by 1 by 1; `d` takes 0.75 of `a`, 0.25 of `b` and `c` each where that has it.
    assert_eq!(volumes, [4.0 - 0.75, 4.0 - 1.0 - 0.25, 8.0 - 0.5, 2.0]);
}

/// A circle of radius 5.
fn circle(corners: u32, phase: f64) -> Circle {
    Circle {
        radius: 5.0,
        corners,
        phase,
    }
}

fn outside() -> Circle {
    Circle {
        radius: 8.0,
        corners: 40,
        phase: 0.0,
    }
}

/// A shaft in a bore, each drawn in its own way; then every triangle between them is between them alone.
fn shaft(corners: [u32; 2], phase: f64, heights: [[f64; 2]; 2]) -> heal::Imported {
    let shaft = cylinder(circle(corners[0], 0.0), heights[0]);
    let hub = tube(circle(corners[1], phase), outside(), heights[1]);
    let body = two(shaft, hub);
    let [a, b] = &volumes(&body)[..] else {
        panic!("two regions")
    };
    let height = |h: [f64; 2]| h[1] - h[0];
    let disc = circle(4, 0.0).disc();
    // Both are within what their facets are off the circle.
    let coarse = corners
        .map(|n| circle(n, 0.0).area())
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let off = |found: f64, wanted: f64, h: f64| {
        assert!(
            (found - wanted).abs() <= (disc - coarse) * h + 1e-6 * wanted,
            "{found} {wanted} {:?}",
            body.notices
        );
    };
    off(a.1, disc * height(heights[0]), height(heights[0]));
    off(
        b.1,
        (outside().area() - disc) * height(heights[1]),
        height(heights[1]),
    );
    let template = &body.document.templates[0];
    let area: f64 = template
        .triangles
        .iter()
        .filter(|t| [t.front, t.back] == [2, 1])
        .map(|t| {
            let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        })
        .sum();
    let common = heights[0][1].min(heights[1][1]) - heights[0][0].max(heights[1][0]);
    let wanted = 10.0 * std::f64::consts::PI * common;
    assert!((area / wanted - 1.0).abs() < 0.03, "{area} of {wanted}");
    body
}

#[test]
fn a_shaft_fills_its_bore_however_both_are_drawn() {
    for (corners, phase) in [
        ([32, 32], 0.5),
        ([32, 32], 0.1),
        ([32, 48], 0.0),
        ([31, 32], 0.0),
        ([24, 60], 0.3),
        ([60, 24], 0.7),
        ([40, 40], 0.001),
    ] {
        for heights in [
            [[0.0, 4.0], [0.0, 4.0]],
            [[-3.0, 6.0], [0.0, 4.0]],
            [[1.0, 3.0], [0.0, 4.0]],
            [[0.0, 4.0], [1.0, 4.0]],
        ] {
            let body = shaft(corners, phase, heights);
            let said = body.notices.join("\n");
            assert!(
                !said.contains("overlap"),
                "{corners:?} {phase} {heights:?} {said}"
            );
        }
    }
}

/// Where one triangle is divided.
#[derive(Clone, Copy, Debug)]
enum At {
    /// At the middle of an edge, times so much more than one from the axis: the triangle beside it keeps the edge.
    Edge(f64),
    /// In its own middle.
    Middle,
}

/// A shaft in its bore, both with the same triangles, of which one that both have is divided on one side.
fn divided_on_one_side(at: At, of_shaft: bool) -> heal::Imported {
    let corners = || circle(32, 0.0);
    let mut solids = [
        cylinder(corners(), [0.0, 4.0]),
        tube(corners(), outside(), [0.0, 4.0]),
    ];
    let solid = &mut solids[usize::from(!of_shaft)];
    let between = |p: &[f64; 3]| (p[0].hypot(p[1]) - 5.0).abs() < 1e-9;
    let facet = solid.iter().position(|f| f.iter().all(between));
    let [a, b, c] = solid.remove(facet.expect("a facet of the bore"));
    match at {
        At::Edge(beside) => {
            let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
            let [x, y] = [0, 1].map(|i| middle[i] * (1.0 + beside));
            let middle = [x, y, middle[2]];
            solid.extend([[a, middle, c], [middle, b, c]]);
        }
        At::Middle => {
            let middle = [0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0);
            solid.extend([[a, b, middle], [b, c, middle], [c, a, middle]]);
        }
    }
    let [shaft, bore] = solids;
    two(shaft, bore)
}

#[test]
fn triangles_that_solids_share_are_shared_where_one_side_is_divided() {
    let ring = (outside().area() - circle(32, 0.0).area()) * 4.0;
    for of_shaft in [true, false] {
        for at in [At::Edge(0.0), At::Edge(2e-6), At::Edge(-2e-6), At::Middle] {
            let body = divided_on_one_side(at, of_shaft);
            let found = volumes(&body);
            let template = &body.document.templates[0];
            let area = |t: &&tmesh::Triangle| {
                let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
                0.5 * (b - a).cross(c - a).length()
            };
            let is_between = |t: &&tmesh::Triangle| t.front.max(t.back) != tmesh::OUTSIDE;
            let between = || template.triangles.iter().filter(is_between);
            let wanted = 2.0 * 32.0 * 5.0 * (std::f64::consts::PI / 32.0).sin() * 4.0;
            let case = format!("{at:?} {of_shaft} {:?}", body.notices);
            assert!(
                (between().map(|t| area(&t)).sum::<f64>() / wanted - 1.0).abs() < 1e-5,
                "{case}"
            );
            assert!(between().count() <= 66, "{case}");
            assert!((found[1].1 / ring - 1.0).abs() < 1e-5, "{case}");
        }
    }
}

#[test]
fn an_air_gap_narrower_than_the_chord_error_stays() {
    let rotor = Circle {
        radius: 4.97,
        corners: 30,
        phase: 0.25,
    };
    let body = two(
        cylinder(rotor, [0.0, 4.0]),
        tube(circle(64, 0.0), outside(), [0.0, 4.0]),
    );
    let found = volumes(&body);
    assert_eq!(found[0].1, round(rotor.area() * 4.0), "{:?}", body.notices);
    let template = &body.document.templates[0];
    assert!(template.triangles.iter().all(|t| t.front == tmesh::OUTSIDE));
    assert!(body.joined.is_none());
}

#[test]
fn the_gap_that_is_closed_can_be_said() {
    let contacts = |gap, overlap| heal::Repairing::Auto(heal::Contacts { gap, overlap });
    let file = ascii_stl(&[
        ("a", cuboid([0.0; 3], [4.0, 3.0, 1.0])),
        ("b", cuboid([1.0, 1.0, 1.01], [2.0, 2.0, 3.0])),
    ]);
    let read =
        |gap| heal::read_with(&file, Stl, contacts(gap, heal::Overlap::Later)).expect("read");
    let touching = |imported: &heal::Imported| {
        let triangles = &imported.document.templates[0].triangles;
        triangles.iter().any(|t| [t.front, t.back] == [2, 1])
    };
    assert!(!touching(&read(None)));
    assert!(touching(&read(Some(0.02))));
    volumes(&read(Some(0.02)));
    let file = ascii_stl(&[("a", unit_cube([0.0; 3])), ("b", unit_cube([0.5; 3]))]);
    let read = |overlap| heal::read_with(&file, Stl, contacts(None, overlap));
    let earlier = read(heal::Overlap::Earlier).expect("read");
    expect(&earlier, [1.0, 0.875]);
    let joined = earlier.joined.expect("what was done");
    assert_eq!(joined.overlaps.len(), 1);
    assert_eq!(joined.overlaps[0].by, "a");
    let refused = read(heal::Overlap::Refuse)
        .map(|_| ())
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("overlap by a volume of 0.125"),
        "{refused}"
    );
}
