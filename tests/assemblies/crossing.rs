//! Solids that cross themselves: the volume of their union, against manifold3d where `REFEREE` names an environment with it.

use crate::motor::{regions, solid};
use bodies::assembly::assembly;
use bodies::{Body, Dice};
use glam::{DMat3, DVec3};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use support::{EXACT_STL, encode, run};

const BODIES: u64 = 100;

/// Prints the volume of the union of the two solids that each line has: numbers of points and triangles, and both.
const UNION: &str = "
import sys, numpy, manifold3d
for line in sys.stdin:
    words, both = iter(line.split()), []
    for _ in range(2):
        n, m = int(next(words)), int(next(words))
        points = numpy.array([float(next(words)) for _ in range(3 * n)]).reshape(-1, 3)
        corners = numpy.array([int(next(words)) for _ in range(3 * m)], dtype=numpy.uint64).reshape(-1, 3)
        both.append(manifold3d.Manifold(manifold3d.Mesh64(points, corners)))
        assert both[-1].status() == manifold3d.Error.NoError, both[-1].status()
    print(repr((both[0] + both[1]).volume()))
";

/// A solid, and the same turned about a place in it by an angle and moved a little.
fn two(seed: u64) -> [Body; 2] {
    let one = solid(&assembly(seed).body, 0);
    let mut dice = Dice::new(seed);
    let used: Vec<DVec3> = (one.faces.iter().flat_map(|f| f.vertices))
        .map(|v| one.vertices[v as usize])
        .collect();
    let low = used.iter().copied().reduce(DVec3::min).expect("a point");
    let high = used.iter().copied().reduce(DVec3::max).expect("a point");
    let mut random = || DVec3::from_array([(); 3].map(|()| dice.between(-1.0, 1.0)));
    let axis = random().normalize_or(DVec3::Z);
    let place = low.midpoint(high) + 0.2 * random() * (high - low);
    let shift = 0.2 * random() * (high - low);
    let turn = DMat3::from_axis_angle(axis, dice.between(0.1, 3.0));
    let mut other = one.clone();
    for p in &mut other.vertices {
        *p = turn * (*p - place) + place + shift;
    }
    [one, other]
}

/// Both as one solid.
fn crossing([one, other]: &[Body; 2]) -> Body {
    let mut both = one.clone();
    let first = both.vertices.len() as u32;
    both.vertices.extend(&other.vertices);
    for face in &other.faces {
        let mut face = *face;
        face.vertices = face.vertices.map(|v| v + first);
        both.faces.push(face);
    }
    both
}

#[test]
fn the_volume_of_what_crosses_itself_is_that_of_the_union() {
    let python = std::env::var_os("REFEREE").map(|folder| Path::new(&folder).join("bin/python"));
    let has_it = |python: &Path| {
        let check = Command::new(python)
            .args(["-c", "import manifold3d"])
            .output();
        check.is_ok_and(|output| output.status.success())
    };
    let Some(python) = python.filter(|python| has_it(python)) else {
        println!("skipped: REFEREE names no environment with manifold3d");
        return;
    };
    let all: Vec<[Body; 2]> = (1..=BODIES).map(two).collect();
    let mut input = String::new();
    for both in &all {
        for body in both {
            write!(input, "{} {} ", body.vertices.len(), body.faces.len()).expect("a string");
            for x in body.vertices.iter().flat_map(|p| p.to_array()) {
                write!(input, "{x:?} ").expect("a string");
            }
            for v in body.faces.iter().flat_map(|f| f.vertices) {
                write!(input, "{v} ").expect("a string");
            }
        }
        input.push('\n');
    }
    let mut referee = Command::new(python)
        .args(["-c", UNION])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    referee
        .stdin
        .take()
        .expect("a pipe")
        .write_all(input.as_bytes())
        .expect("it reads");
    let output = referee.wait_with_output().expect("it ends");
    let unions: Vec<f64> = (String::from_utf8_lossy(&output.stdout).lines())
        .map(|line| line.parse().expect("a number"))
        .collect();
    assert_eq!(unions.len(), all.len());
    for (i, (both, union)) in all.iter().zip(unions).enumerate() {
        let body = crossing(both);
        let input = encode(&body, EXACT_STL);
        // The search for a symmetry would take most of the time.
        let arguments = ["--allow-asymmetric", "--max-order", "2"];
        let document = run("symdetect", &arguments, &input).success();
        let volume: f64 = regions(&document).iter().map(|r| r.1).sum();
        assert!(
            (volume - union).abs() < 1e-6 * union,
            "seed {}: {volume}, not {union}",
            i + 1
        );
    }
}
