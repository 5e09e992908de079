//! The generated bodies are what they say: closed, of the volume of their formula.

mod common;

use bodies::{
    Coating, Gear, Impeller, Placement, PracticalTsv, Prism, Ratchet, Tessellation, Tsv, cube,
};
use common::{has_volumes, is_closed, polygon};
use std::f64::consts::PI;

fn step(order: u32, distance: f64) -> f64 {
    distance / (PI / f64::from(order)).cos()
}

const BOTH: [Tessellation; 2] = [Tessellation::Symmetric, Tessellation::Asymmetric];

#[test]
fn regular_sections_have_the_volumes_of_their_formulas() {
    let (radius, height) = (1.0, 0.75);
    for tessellation in BOTH {
        for order in [3, 4, 7, 16, 128] {
            let prism = Prism {
                order,
                radius,
                height,
                bore: 0.0,
                tessellation,
            };
            let body = prism.build();
            is_closed(&body);
            has_volumes(&body, &[height * polygon(order, radius)]);
            let bored = Prism {
                bore: 0.25,
                ..prism
            }
            .build();
            is_closed(&bored);
            has_volumes(
                &bored,
                &[height * (polygon(order, radius) - polygon(order, 0.25))],
            );

            let thickness = 5e-3;
            let body = Coating {
                order,
                radius,
                bore: 0.4,
                thickness,
                height,
                tessellation,
            }
            .build();
            is_closed(&body);
            let middle = polygon(order, 0.4 + step(order, thickness));
            let expected = [polygon(order, 1.0) - middle, middle - polygon(order, 0.4)];
            has_volumes(&body, &expected.map(|a| height * a));

            let body = Tsv {
                order,
                radius,
                core: 0.2,
                thickness,
                height,
                tessellation,
            }
            .build();
            is_closed(&body);
            let (core, middle) = (
                polygon(order, 0.2),
                polygon(order, 0.2 + step(order, thickness)),
            );
            let expected = [polygon(order, 1.0) - middle, middle - core, core];
            has_volumes(&body, &expected.map(|a| height * a));
        }
        let body = cube(2.0, tessellation);
        is_closed(&body);
        has_volumes(&body, &[8.0]);
    }
}

#[test]
fn films_of_the_open_via_are_cups_one_in_the_other() {
    let (order, hole, thickness, layers) = (24, 0.5, 7e-4, 6_u32);
    for tessellation in BOTH {
        let body = PracticalTsv {
            order,
            radius: 1.0,
            hole,
            thickness,
            layers,
            height: 1.0,
            tessellation,
        }
        .build();
        is_closed(&body);
        // What is left open above film k.
        let open = |k: u32| {
            let depth = thickness * f64::from(k);
            (1.0 - depth) * polygon(order, hole - step(order, depth))
        };
        let substrate = polygon(order, 1.0) - polygon(order, hole);
        let films = (0..layers).map(|k| open(k) - open(k + 1));
        let expected: Vec<_> = std::iter::once(substrate).chain(films).collect();
        has_volumes(&body, &expected);
    }
}

#[test]
fn toothed_bodies_are_closed_however_they_are_split() {
    for order in [3, 7, 12, 64] {
        for bore in [0.0, 0.2] {
            let [a, b] = BOTH.map(|tessellation| {
                let (radius, height) = (1.0, 0.5);
                let gear = Gear {
                    order,
                    radius,
                    bore,
                    height,
                    tessellation,
                };
                let ratchet = Ratchet {
                    order,
                    radius,
                    bore,
                    coating: bore / 10.0,
                    height,
                    tessellation,
                };
                let impeller = Impeller {
                    order,
                    radius,
                    bore,
                    height,
                    twist: 0.02,
                    layers: 4,
                    tessellation,
                };
                [gear.build(), ratchet.build(), impeller.build()]
            });
            for (a, b) in a.iter().zip(&b) {
                is_closed(a);
                is_closed(b);
                let volumes: Vec<f64> = (0..a.materials.len()).map(|i| a.volume(i)).collect();
                has_volumes(b, &volumes);
                assert!(a.faces != b.faces || a.vertices != b.vertices);
            }
        }
    }
}

#[test]
fn placements_keep_volumes() {
    let mut body = cube(1.0, Tessellation::Symmetric);
    let placement = Placement {
        rotate: Some(3),
        scale: 1e-6,
        jitter: 0.0,
    };
    placement.apply(&mut body);
    has_volumes(&body, &[1e-18]);
    assert!(body.seed(0).is_some());
}
