//! Bent bodies are closed, keep what they are symmetric to, and are off the flat ones by no more than they were bent.

mod common;

use bodies::folded::{bend, folded, unfolded};
use bodies::{Gear, Prism, Ratchet, Tessellation};
use common::{has_volumes, is_closed, polygon};
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;

#[test]
fn bodies_of_seeds_are_closed_and_hardly_differ_from_the_flat_ones() {
    for seed in 1..60 {
        let [bent, flat] = [folded(seed), unfolded(seed)];
        assert!(
            bent.angle > 0.0 && bent.angle <= 2.0,
            "{seed}: {}",
            bent.angle
        );
        assert_eq!(flat.angle, 0.0);
        let (angle, bent, flat) = (bent.angle.to_radians(), bent.solid, flat.solid);
        is_closed(&bent.body);
        assert_eq!(bent.body.faces, flat.body.faces);
        assert_eq!(bent.facts.order, flat.facts.order);
        // A facet is no wider than the body is long, and the angle is that of the steepest one.
        let vertices = bent.body.vertices.iter().zip(&flat.body.vertices);
        let moved = vertices.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        let reach = 8.0 * bent.facts.radius;
        assert!(
            moved > 0.0 && moved <= reach * angle.tan(),
            "{seed}: {moved}"
        );
        let volume = bent.body.total_volume() / flat.body.total_volume();
        assert!((volume - 1.0).abs() < 0.2, "{seed}: {volume}");
    }
}

#[test]
fn bent_bodies_are_as_symmetric_as_before() {
    let tessellation = Tessellation::Symmetric;
    let prism = Prism {
        order: 6,
        tessellation,
        ..Prism::default()
    };
    let gear = Gear {
        order: 5,
        radius: 1.0,
        bore: 0.3,
        height: 0.5,
        tessellation,
    };
    let ratchet = Ratchet {
        order: 7,
        radius: 1.0,
        bore: 0.3,
        coating: 0.0,
        height: 0.5,
        tessellation,
    };
    for (name, flat) in [
        ("prism", prism.build()),
        ("gear", gear.build()),
        ("ratchet", ratchet.build()),
    ] {
        // Without an angle, only the triangles change.
        let mut divided = flat.clone();
        bend(&mut divided, 0.0, 1);
        has_volumes(&divided, &[flat.volume(0)]);
        assert!(name != "prism" || divided.volume(0) < polygon(6, 1.0) * 1.001);
        // Where no point finds room in the triangles that a seed chooses, nothing is bent.
        let mut moved = 0;
        for seed in 0..8 {
            let mut body = flat.clone();
            let bent = bend(&mut body, 0.5, seed);
            is_closed(&body);
            let turn = DMat3::from_rotation_z(TAU / f64::from(body.order));
            let image = |p: &DVec3| {
                let near = body.vertices.iter().map(|q| q.distance(turn * *p));
                near.fold(f64::INFINITY, f64::min)
            };
            let off = body.vertices.iter().map(image).fold(0.0, f64::max);
            assert!(off < 1e-12, "{name} {seed}: {off}");
            moved += bent;
        }
        assert!(moved > 0, "{name}");
    }
}
