//! Shape and triangles of a body have the group that is written beside it, and no larger one.

mod common;

use bodies::{
    AlternatingWheel, Antiprism, Body, Coating, Gear, HelicalGear, PracticalTsv, Prism, Ratchet,
    SawWheel, Tessellation, TwistedBar,
};
use common::{has_volumes, is_closed, polygon};
use glam::{DMat3, DVec3};
use std::collections::{BTreeSet, HashMap};
use std::f64::consts::{PI, TAU};

/// Ids of the images of all vertices, if every image is a vertex.
fn permutation(body: &Body, operation: DMat3, low: f64) -> Option<Vec<u32>> {
    let cell = |p: DVec3| (p * 1e9).round().as_i64vec3().to_array();
    let ids: HashMap<_, _> = (0_u32..)
        .zip(&body.vertices)
        .map(|(i, &p)| (cell(p - DVec3::Z * low), i))
        .collect();
    let image = |&p: &DVec3| {
        let [x, y, z] = cell(operation * (p - DVec3::Z * low));
        let near = (0..27).map(|n| [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]);
        near.into_iter().find_map(|cell| ids.get(&cell).copied())
    };
    body.vertices.iter().map(image).collect()
}

/// Whether the triangles, with the materials on their sides, are mapped onto themselves.
fn is_symmetric(body: &Body, operation: DMat3) -> bool {
    let (low, high) = body
        .vertices
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
            (l.min(p.z), h.max(p.z))
        });
    let Some(image) = permutation(body, operation, 0.5 * (low + high)) else {
        return false;
    };
    let faces = |map: &dyn Fn(u32) -> u32| -> BTreeSet<_> {
        let face = |f: &bodies::Face| {
            let mut vertices = f.vertices.map(map);
            vertices.sort_unstable();
            (vertices, BTreeSet::from([f.front, f.back]))
        };
        body.faces.iter().map(face).collect()
    };
    faces(&|v| v) == faces(&|v| image[v as usize])
}

/// Rotation by a share of a turn.
fn rotation(share: f64) -> DMat3 {
    DMat3::from_rotation_z(TAU * share)
}

const HORIZONTAL: DMat3 = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::NEG_Z);

/// Whether some half-plane through the axis is mirror plane or axis of a half turn, as `half_turn` asks; where
/// they are follows from the vertices.
fn across(body: &Body, half_turn: bool) -> bool {
    let first = body.vertices.iter().find(|p| p.truncate().length() > 1e-3);
    let from = first.expect("a vertex").truncate().to_angle();
    let radius = |p: &DVec3| p.truncate().length();
    let same = |p: &&DVec3| (radius(p) - radius(first.expect("a vertex"))).abs() < 1e-9;
    body.vertices.iter().filter(same).any(|p| {
        let angle = from + p.truncate().to_angle();
        let (c, s) = (angle.cos(), angle.sin());
        let z = if half_turn { DVec3::NEG_Z } else { DVec3::Z };
        is_symmetric(
            body,
            DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(s, -c, 0.0), z),
        )
    })
}

/// The Schoenflies symbol of the triangles' group about the axis.
fn group(body: &Body) -> String {
    let n = (1..=64_u32)
        .rev()
        .find(|&n| is_symmetric(body, rotation(1.0 / f64::from(n))))
        .expect("the identity at least");
    let (vertical, half_turns) = (across(body, false), across(body, true));
    let horizontal = is_symmetric(body, HORIZONTAL);
    let alternating = is_symmetric(body, rotation(0.5 / f64::from(n)) * HORIZONTAL);
    match (vertical, half_turns, horizontal, alternating) {
        (true, true, true, _) => format!("D{n}h"),
        (true, true, false, true) => format!("D{n}d"),
        (false, true, false, false) => format!("D{n}"),
        (false, false, true, _) => format!("C{n}h"),
        (false, false, false, true) => format!("S{}", 2 * n),
        (true, false, false, false) => format!("C{n}v"),
        (false, false, false, false) => format!("C{n}"),
        other => panic!("no group: {other:?}"),
    }
}

#[track_caller]
fn has_group(body: &Body, symbol: &str) {
    is_closed(body);
    assert_eq!(body.group.symbol(), symbol);
    assert_eq!(group(body), symbol);
}

#[test]
fn twisted_sections_have_half_turns_across_the_axis() {
    for bore in [0.0, 0.2] {
        let bar = TwistedBar {
            radius: 1.0,
            aspect: 2.0,
            bore,
            height: 3.0,
            twist: 1.5,
            layers: 7,
        };
        has_group(&bar.build(), "D2");
        let square = TwistedBar { aspect: 1.0, ..bar };
        has_group(&square.build(), "D4");
        for order in [3, 16] {
            let gear = HelicalGear {
                order,
                radius: 1.0,
                bore,
                height: 0.6,
                twist: 0.3,
                layers: 4,
            };
            has_group(&gear.build(), &format!("D{order}"));
        }
    }
}

#[test]
fn antiprisms_have_the_volume_of_a_prismatoid() {
    for order in [3, 7, 8] {
        for bore in [0.0, 0.4] {
            let body = Antiprism {
                order,
                radius: 1.0,
                bore,
                height: 0.8,
            }
            .build();
            has_group(&body, &format!("D{order}d"));
            let volume = |radius: f64| {
                let middle = radius * (0.5 * PI / f64::from(order)).cos();
                0.8 / 6.0 * (2.0 * polygon(order, radius) + 4.0 * polygon(2 * order, middle))
            };
            has_volumes(&body, &[volume(1.0) - volume(bore)]);
        }
    }
}

#[test]
fn wheels_have_no_mirror_plane_through_the_axis() {
    for order in [2, 4, 5] {
        for bore in [0.0, 0.3] {
            let (radius, height) = (1.0, 0.5);
            let saw = SawWheel {
                order,
                radius,
                bore,
                height,
            };
            has_group(&saw.build(), &format!("C{order}h"));
            let alternating = AlternatingWheel {
                order,
                radius,
                bore,
                height,
            };
            has_group(&alternating.build(), &format!("S{}", 2 * order));
        }
    }
}

/// Strips are split by diagonals that no reflection keeps: the shape's group is written beside these bodies,
/// and the triangles have what half turns and rotations there are.
#[test]
fn triangles_of_swept_bodies_keep_the_proper_part_of_their_group() {
    let tessellation = Tessellation::Symmetric;
    let (radius, height, bore, thickness) = (1.0, 0.5, 0.3, 0.02);
    let prism = Prism {
        order: 6,
        radius,
        height,
        bore,
        tessellation,
    };
    let ring = Coating {
        order: 6,
        radius,
        bore,
        thickness,
        height,
        tessellation,
    };
    let open = PracticalTsv {
        order: 8,
        radius,
        hole: bore,
        thickness,
        layers: 3,
        height,
        tessellation,
    };
    let gear = Gear {
        order: 9,
        radius,
        bore,
        height,
        tessellation,
    };
    let ratchet = Ratchet {
        order: 7,
        radius,
        bore,
        coating: 0.0,
        height,
        tessellation,
    };
    for (body, shape, triangles) in [
        (prism.build(), "D6h", "D6"),
        (ring.build(), "D6h", "D6"),
        (open.build(), "C8v", "C8"),
        (gear.build(), "D9h", "D9"),
        (ratchet.build(), "C7h", "C7"),
    ] {
        assert_eq!(
            (body.group.symbol().as_str(), group(&body).as_str()),
            (shape, triangles)
        );
    }
}
