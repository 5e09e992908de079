//! What is found does not depend on where a body is, nor on the order of its triangles.

use bodies::Dice;
use bodies::facets::{Facet, Point, ascii_stl, cuboid};
use bodies::rounds::{Circle, cylinder};
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use support::run;

/// The group that `symdetect` names, or what it says instead, of solids that are turned and moved anywhere, with their triangles in
/// any order.
fn group_of(solids: &[(&str, Vec<Facet>)], seed: u64) -> String {
    let mut dice = Dice::new(seed);
    let [x, y, z] = [0; 3].map(|_| dice.between(0.0, TAU));
    let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    let shift = DVec3::from_array([0; 3].map(|_| dice.between(-30.0, 30.0)));
    let placed = |p: Point| (turn * DVec3::from_array(p) + shift).to_array();
    let mut anywhere = |facets: &[Facet]| -> Vec<Facet> {
        let mut facets: Vec<Facet> = facets.iter().map(|f| f.map(placed)).collect();
        for last in (1..facets.len()).rev() {
            facets.swap(last, dice.below(last + 1));
        }
        facets
    };
    let moved: Vec<(&str, Vec<Facet>)> = solids.iter().map(|(n, f)| (*n, anywhere(f))).collect();
    let told = run("symdetect", &[], &ascii_stl(&moved)).stderr;
    let group =
        (told.lines()).find_map(|line| line.strip_prefix("symdetect: ")?.split_once(" about "));
    group.map_or(told.clone(), |group| group.0.to_owned())
}

/// Facets turned about the z axis.
fn around(facets: Vec<Facet>, angle: f64) -> Vec<Facet> {
    let (s, c) = libm::sincos(angle);
    let turned = |[x, y, z]: Point| [c * x - s * y, s * x + c * y, z];
    facets.into_iter().map(|f| f.map(turned)).collect()
}

/// Blocks at equal steps around the z axis.
fn wreath(count: u32, low: Point, high: Point) -> Vec<Facet> {
    let block = |k: u32| around(cuboid(low, high), TAU * f64::from(k) / f64::from(count));
    (0..count).flat_map(block).collect()
}

/// What is there 24 times around the axis and what is there 5 times have one mirror plane in common, whose normal no
/// moments tell.
#[test]
fn the_mirror_of_features_of_two_orders() {
    let outer = wreath(24, [1.7, -0.05, 0.0], [2.3, 0.05, 1.0]);
    let inner = wreath(5, [0.9, -0.05, 0.2], [1.1, 0.05, 0.5]);
    let solids = [("vanes and holes", [outer, inner].concat())];
    for seed in 1..=8 {
        assert_eq!(group_of(&solids, seed), "C1v", "seed {seed}");
    }
}

/// Near the lines where rollers touch a shaft, what is nearest to the image of a place may be of another solid than it belongs to.
#[test]
fn rollers_that_touch_a_shaft() {
    let circle = |radius: f64, corners: u32| Circle {
        radius,
        corners,
        phase: 0.0,
    };
    let roller = |k: u32| {
        let (s, c) = libm::sincos(TAU * f64::from(k) / 12.0);
        let moved = |[x, y, z]: Point| [x + 1.2 * c, y + 1.2 * s, z];
        let drawn = cylinder(circle(0.2, 14), [0.1, 0.9]);
        drawn
            .into_iter()
            .map(|f| f.map(moved))
            .collect::<Vec<Facet>>()
    };
    let names: Vec<String> = (0..12).map(|k| format!("roller {k}")).collect();
    let rollers = names
        .iter()
        .zip(0..)
        .map(|(name, k)| (name.as_str(), roller(k)));
    let shaft = ("shaft", cylinder(circle(1.0, 36), [0.0, 1.0]));
    let solids: Vec<(&str, Vec<Facet>)> = [shaft].into_iter().chain(rollers).collect();
    for seed in 1..=8 {
        assert_eq!(group_of(&solids, seed), "D12h", "seed {seed}");
    }
}
