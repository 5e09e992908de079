//! Bodies whose rotation exchanges regions: two parts that follow each other around the axis.

use crate::support::{pipe, run};
use serde_json::Value;
use std::fmt::Write;

/// `2 n` blocks around the axis, of two parts by turns, as OBJ; `shift`, in steps between blocks, turns all.
fn blocks(n: u32, shift: f64) -> String {
    let mut text = String::new();
    for i in 0..2 * n {
        writeln!(text, "o {}", ["copper", "steel"][i as usize % 2]).expect("a string");
        let middle = f64::from(i) + shift;
        let corner = |part: f64, radius: f64, z: f64| {
            let angle = std::f64::consts::PI * (middle + part) / f64::from(n);
            [radius * angle.cos(), radius * angle.sin(), z]
        };
        for z in [0.0, 0.4] {
            for [part, radius] in [[-0.3, 1.0], [-0.3, 1.5], [0.3, 1.5], [0.3, 1.0]] {
                let [x, y, z] = corner(part, radius, z);
                writeln!(text, "v {x} {y} {z}").expect("a string");
            }
        }
        for face in [
            [4, 3, 2, 1],
            [5, 6, 7, 8],
            [1, 2, 6, 5],
            [2, 3, 7, 6],
            [3, 4, 8, 7],
            [4, 1, 5, 8],
        ] {
            let [a, b, c, d] = face.map(|v| 8 * i + v);
            writeln!(text, "f {a} {b} {c} {d}").expect("a string");
        }
    }
    text
}

/// Volume of each region of the mesh that the pipe makes.
fn volumes(body: &[u8], cut: &[&str]) -> Vec<f64> {
    let stages: [&[&str]; 4] = [
        &["symdetect"],
        &[&["wedgecut"], cut].concat(),
        &["tetwedge"],
        &["rotassemble", "--to", "tmesh"],
    ];
    let mesh = pipe(&stages, body).pop().expect("a stage").success();
    run("meshqual", &["--check"], &mesh).success();
    let report = run("meshqual", &["--json", "-"], &mesh).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let regions = report["regions"].as_array().expect("regions");
    let volume = |r: &Value| r["volume"].as_f64().expect("a number");
    regions.iter().map(volume).collect()
}

#[test]
fn parts_by_turns_keep_their_volumes_however_they_are_cut() {
    for n in [2, 3, 5] {
        for shift in [0.0, 0.5] {
            let body = blocks(n, shift);
            let step = 180.0 / f64::from(2 * n);
            let angles = [0, 1, 2, -1].map(|k| (f64::from(k) * step).to_string());
            let mut cuts: Vec<Vec<&str>> = vec![vec![]];
            for order in ["1", "2", "3", "5"] {
                if (2 * n).is_multiple_of(order.parse().expect("a number")) {
                    cuts.push(vec!["--order", order]);
                    cuts.push(vec!["--order", order, "--domain", "rotation"]);
                    for angle in &angles {
                        cuts.push(vec!["--order", order, "--start-angle", angle]);
                    }
                }
            }
            for cut in cuts {
                let found = volumes(body.as_bytes(), &cut);
                let [copper, steel] = found[..] else {
                    panic!("{n} {shift} {cut:?}: {found:?}")
                };
                let off = (copper - steel).abs() / copper;
                assert!(off < 1e-9, "{n} {shift} {cut:?}: {found:?}");
            }
        }
    }
}
