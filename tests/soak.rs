//! A few random bodies of the soak test through the whole pipe; `make soak` takes many more.

use soak::{Kind, Laboratory, Verdict};
use std::path::Path;
use std::time::Duration;

/// Bodies for which something was mended.
const MENDED: [u64; 12] = [
    // Noise leaves a face in a wall beside the axis.
    3250,    // Points of the two sections are nearly the same.
    200_223, // The column of a hub touches the axis in single points.
    201_047, // Three points on a straight edge make a triangle of the new surface.
    200_788,
    // TetGen gives up on the points in the order in which it takes them, whatever the order they are given in.
    201_460, // ... or on faces whose points are not quite in one plane.
    203_023, // Noise takes the middle of a face off the axis.
    200_999, 201_353, // The rotation exchanges regions, and a divisor of its order is used.
    705_258, // An edge of the drawing lies beside a mirror plane.
    721_010, // A point of the face that wedge and hub share is on a straight edge of the wedge.
    731_504, // The mesher leaves the plane of an uneven facet that has a needle.
    761_201,
];

#[test]
fn random_bodies_are_meshed_and_checked() {
    all_are_meshed(Kind::Solids, false, (1..=24).chain(MENDED));
}

#[test]
fn random_assemblies_are_meshed_and_checked() {
    all_are_meshed(Kind::Assemblies, false, 1..=24);
}

#[test]
fn random_bladed_bodies_are_meshed_and_checked() {
    // With splitters, shrouds, sweep, camber and rake; those of few elements.
    let seeds = [7, 14, 20, 29, 35, 36, 37, 46, 52, 54];
    all_are_meshed(Kind::Bladed, false, seeds.into_iter());
}

#[test]
fn surfaces_stay_within_the_deviation_asked_for() {
    let mended = [
        // Filling uneven facets that meet at a small angle makes them cross.
        9_400_049,  // TetGen's walk goes in circles while it refines.
        9_401_263, // Closing a gap that coarse facets would explain makes solids overlap that do not.
        9_901_334, // A small piece lies between a curved seam and its chords.
        9_902_529, // The mesher divides an uneven facet between three points of its outline on a mirror plane.
        10_237_822, // A corner on a seam moves to where its image is that stays, which is no image to the bit of where it came from.
        10_238_498, // Refinement for volumes alone does not end at the axis.
        10_240_660,
    ];
    all_are_meshed(Kind::Solids, true, (1..=16).chain(mended));
    // Without bounds of the angles, refinement for volumes does not end where blocks are thin.
    all_are_meshed(Kind::Assemblies, true, [561_045].into_iter());
}

#[test]
fn spoilt_files_are_meshed_or_refused() {
    let gear = bodies::Gear::default().build();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("gear.stl");
    let mut out = std::fs::File::create(&file).expect("it can be made");
    let encoding = bodies::Encoding::StlAscii { digits: None };
    bodies::write(&gear, encoding, &mut out).expect("room on the disk");
    let laboratory = laboratory(Kind::Solids, false);
    let (mut meshed, mut refused, mut failed) = (0, 0, Vec::new());
    for seed in 1..=32 {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let trial = laboratory.spoilt(&file, seed, folder.path());
        let trial = trial.expect("it runs");
        match trial.verdict {
            Verdict::Meshed => meshed += 1,
            Verdict::Refused(_) => refused += 1,
            other => failed.push(format!("seed {seed}, {}: {other:?}", trial.description)),
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(meshed > 0 && refused > 0, "{meshed} {refused}");
}

fn laboratory(kind: Kind, surfaces: bool) -> Laboratory {
    let tools = Path::new(env!("CARGO_BIN_EXE_symdetect")).parent();
    Laboratory {
        binaries: tools.expect("a folder").to_owned(),
        limit: Duration::from_secs(300),
        twice: 8,
        kind,
        surfaces,
    }
}

fn all_are_meshed(kind: Kind, surfaces: bool, seeds: impl Iterator<Item = u64>) {
    let laboratory = laboratory(kind, surfaces);
    let mut failed = Vec::new();
    for seed in seeds {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let trial = laboratory.trial(seed, folder.path()).expect("it runs");
        match trial.verdict {
            Verdict::Meshed | Verdict::Asymmetric => {}
            other => failed.push(format!("seed {seed}, {}: {other:?}", trial.description)),
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
