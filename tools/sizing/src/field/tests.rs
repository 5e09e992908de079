//! Folded fields against the least over all images, asked one by one.

use super::fold::SHARE;
use super::{Folded, Limited};
use crate::tree::{Graded, cube};
use glam::{DMat4, DVec3, DVec4};
use std::f64::consts::TAU;
use tmesh::{Document, Frame, Instance, Isometry, SizeField, SizePoint, Template};

const GROWTH: f64 = 0.5;

/// Numbers from 0 to 1 that look random.
fn random(seed: u64) -> f64 {
    let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (x >> 11) as f64 / (1_u64 << 53) as f64
}

/// A cube from -width to width of n cells along each side, divided into tetrahedra, with points and lengths off a grid.
fn field(n: u32, width: f64, size: impl Fn(DVec3) -> f64) -> SizeField {
    let at = |x: u32, y: u32, z: u32| x + (n + 1) * (y + (n + 1) * z);
    let mut field = SizeField::default();
    for z in 0..=n {
        for y in 0..=n {
            for x in 0..=n {
                let p = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                let number = u64::from(at(x, y, z));
                let off = |k: u64| 0.3 * (random(3 * number + k) - 0.5);
                let inner = |i: u32| i > 0 && i < n;
                let p = p + DVec3::new(
                    if inner(x) { off(0) } else { 0.0 },
                    if inner(y) { off(1) } else { 0.0 },
                    if inner(z) { off(2) } else { 0.0 },
                );
                let position = width * (2.0 / f64::from(n) * p - 1.0);
                let size = size(position);
                field.points.push(SizePoint { position, size });
            }
        }
    }
    let orders = [
        [1, 2, 4],
        [2, 1, 4],
        [1, 4, 2],
        [4, 1, 2],
        [2, 4, 1],
        [4, 2, 1],
    ];
    for (x, y, z) in (0..n * n * n).map(|i| (i % n, i / n % n, i / n / n)) {
        for order in orders {
            let mut corner = 0;
            let mut tet = [at(x, y, z); 4];
            for (k, step) in order.into_iter().enumerate() {
                corner |= step;
                tet[k + 1] = at(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
            }
            field.tets.push(tet);
        }
    }
    field
}

/// Eight images of a wedge: four rotations, turned over or not.
fn document(order: u32) -> Document {
    let angle = TAU / f64::from(order);
    let at = |a: f64, z: f64| DVec3::new(a.cos(), a.sin(), z);
    let middle = |z: f64| at(0.5 * angle, z);
    let mut document = Document::single(Template {
        vertices: vec![
            DVec3::ZERO,
            DVec3::Z,
            at(0.0, 0.0),
            at(0.0, 1.0),
            middle(0.0),
            middle(1.0),
            at(angle, 0.0),
            at(angle, 1.0),
        ],
        ..Template::default()
    });
    document.instances = (0..i64::from(order))
        .flat_map(|k| [false, true].map(|over| Isometry::new(k, order, over, over)))
        .map(|isometry| Instance {
            template: 0,
            isometry,
            region_map: 0,
        })
        .collect();
    document
}

/// The length that a field has at a point; `None` beyond it.
fn length(limited: &Limited, p: DVec3) -> Option<f64> {
    limited.tets.iter().find_map(|tet| {
        let columns = tet.map(|v| limited.points[v as usize].extend(1.0));
        let [a, b, c, d] = columns;
        let parts = DMat4::from_cols(a, b, c, d).inverse() * p.extend(1.0);
        let sizes = tet.map(|v| limited.sizes[v as usize]);
        (parts.min_element() >= -1e-9).then(|| parts.dot(DVec4::from_array(sizes)))
    })
}

fn graded(limited: &Limited, document: &Document) -> Graded {
    let vertices = document.templates[0].vertices.iter().copied();
    let low = vertices.clone().reduce(DVec3::min).unwrap();
    let high = vertices.reduce(DVec3::max).unwrap();
    let cube = cube([low, high]);
    let folded = Folded::new(limited, (document, 0), cube).unwrap();
    Graded::with_field(&[], GROWTH, f64::INFINITY, cube, Some(&folded)).unwrap()
}

/// Places in the wedge.
fn places(order: u32) -> impl Iterator<Item = DVec3> {
    (0..300).map(move |i| {
        let [r, a, z] = [0, 1, 2].map(|k| random(1000 + 3 * i + k));
        let angle = a * TAU / f64::from(order);
        // Within chords.
        let r = 0.86 * r;
        DVec3::new(r * angle.cos(), r * angle.sin(), z)
    })
}

#[test]
fn the_least_of_all_images_counts() {
    // Fine in one place, which only one copy has, and coarse in others.
    let spot = DVec3::new(-0.4, 0.3, -0.5);
    let wild = |p: DVec3| 0.05 + 0.3 * p.distance(spot) + 0.1 * (p.x + 1.2);
    for order in [3, 4, 9] {
        let document = document(order);
        let field = field(9, 1.2, wild);
        let limited = Limited::new(&field, &Frame::IDENTITY, GROWTH);
        let graded = graded(&limited, &document);
        assert!(graded.nodes.len() < 200_000, "{}", graded.nodes.len());
        let mut sum = 0.0;
        for p in places(order) {
            let images = document.instances.iter().map(|i| i.isometry.apply(p));
            let each = images.map(|p| length(&limited, p).expect("in the field"));
            let least = SHARE * each.reduce(f64::min).unwrap();
            let found = graded.at(p);
            let ratio = found / least;
            // Half of a quarter on each side, and what single precision adds.
            assert!(
                ratio > 0.87 && ratio < 1.15,
                "{order}, {p}: {found} {least}"
            );
            sum += ratio.ln();
        }
        assert!((sum / 300.0).abs() < 0.05, "{order}: {}", sum / 300.0);
    }
}

#[test]
fn the_frame_takes_the_field_along() {
    let rotation = glam::DMat3::from_rotation_y(0.7) * glam::DMat3::from_rotation_x(2.0);
    let frame = Frame {
        rotation,
        origin: DVec3::new(3.0, -2.0, 1.0),
    };
    let field = field(6, 1.2, |p| 0.1 + 0.05 * (p.x + 1.2));
    let mut moved = field.clone();
    for point in &mut moved.points {
        point.position = frame.to_world(point.position);
    }
    let document = document(5);
    let [here, there] = [(&field, Frame::IDENTITY), (&moved, frame)]
        .map(|(field, frame)| graded(&Limited::new(field, &frame, GROWTH), &document));
    for p in places(5) {
        let ratio = here.at(p) / there.at(p);
        assert!(ratio > 0.8 && ratio < 1.25, "{p}: {ratio}");
    }
}

#[test]
fn lengths_grow_beyond_the_border() {
    // The field ends at a height within the wedge, and at a radius.
    let field = field(5, 0.4, |_| 0.02);
    let document = document(6);
    let limited = Limited::new(&field, &Frame::IDENTITY, GROWTH);
    let graded = graded(&limited, &document);
    for p in places(6) {
        // The cube is the union of no images of itself: near its corners it depends on the image.
        let images = document.instances.iter().map(|i| i.isometry.apply(p));
        let beyond = images.map(|p| (p.abs() - 0.4).max(DVec3::ZERO).length());
        let least = SHARE * 0.02 + GROWTH * beyond.reduce(f64::min).unwrap();
        let ratio = graded.at(p) / least;
        assert!(ratio > 0.66 && ratio < 1.5, "{p}: {ratio} of {least}");
    }
    assert!(graded.nodes.len() < 100_000, "{}", graded.nodes.len());
}

#[test]
fn a_field_that_is_the_same_everywhere_has_few_leaves() {
    let field = field(12, 2.0, |_| 0.01);
    let limited = Limited::new(&field, &Frame::IDENTITY, GROWTH);
    let graded = graded(&limited, &document(3));
    assert!(graded.nodes.len() < 1000, "{}", graded.nodes.len());
    for p in places(3) {
        assert!((graded.at(p) / (SHARE * 0.01) - 1.0).abs() < 1e-5);
    }
}

#[test]
fn triangles_alone_are_fields_on_surfaces() {
    let mut field = field(4, 1.2, |p| 0.1 + 0.02 * (p.z + 1.2));
    let limited = Limited::new(&field, &Frame::IDENTITY, GROWTH);
    field.triangles = limited.border;
    field.tets.clear();
    let limited = Limited::new(&field, &Frame::IDENTITY, GROWTH);
    let graded = graded(&limited, &document(4));
    for p in places(4) {
        let depth = 1.2 - p.abs().max_element();
        let nearest = 0.1 + 0.02 * (p.z + 1.2);
        let found = graded.at(p);
        assert!(
            found > 0.5 * (nearest + GROWTH * depth) * SHARE,
            "{p}: {found}"
        );
        assert!(found < 2.0 * (nearest + GROWTH * depth), "{p}: {found}");
    }
}
