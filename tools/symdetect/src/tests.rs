//! Detection on made bodies.

use crate::bodies::{self, Kind};
use crate::samples::Random;
use crate::{Error, Params, detect};
use glam::DVec3;
use tmesh::{Document, Symmetry};

fn find(body: &Document) -> Symmetry {
    detect(body, &Params::default(), &mut |_| ())
        .unwrap()
        .symmetry
}

#[test]
fn every_kind_of_group() {
    let mut random = Random(1);
    for kind in Kind::ALL {
        for n in [2, 3, 4, 7, 16] {
            let body = kind.body(n, 8, 0.15);
            let found = find(&bodies::place(&body, &mut random, 1.0, 0.0));
            assert_eq!(found.group, kind.symbol(n));
            assert!(found.residual < 2e-6, "{} {}", found.group, found.residual);
        }
    }
}

#[test]
#[ignore = "a table over many bodies; run it with --release"]
fn confusion() {
    let mut random = Random(2);
    let orders = [1, 2, 3, 4, 6, 7, 16, 31, 100, 256];
    for noise in [0.0, 1e-7, 1e-6, 1e-5, 1e-4] {
        let (mut right, mut all) = (0, 0);
        let begun = std::time::Instant::now();
        for kind in Kind::ALL {
            for n in orders {
                let per_lobe = if n < 20 { 12 } else { 6 };
                let depth = (0.5 / f64::from(n)).clamp(0.01, 0.15);
                let mut body = kind.body(n, per_lobe, depth);
                if all % 2 == 1 {
                    body = bodies::split_faces(&body, &mut random, 0.3);
                }
                let scale = [1.0, 1e-6, 1e6][all % 3];
                let placed = bodies::place(&body, &mut random, scale, noise);
                let expected = match (n, kind) {
                    (1, Kind::Cn | Kind::S2n) => continue,
                    (1, Kind::Cnv | Kind::Cnh) => "C1v".to_owned(),
                    (1, Kind::Dn) => "C2".to_owned(),
                    (1, Kind::Dnd) => "C2h".to_owned(),
                    (1, Kind::Dnh) => "C2v".to_owned(),
                    _ => kind.symbol(n),
                };
                all += 1;
                match detect(&placed, &Params::default(), &mut |_| ()) {
                    Ok(d) if d.symmetry.group == expected => right += 1,
                    Ok(d) => eprintln!(
                        "noise {noise:e} {expected}: found {} residual {:e} {:?}",
                        d.symmetry.group, d.symmetry.residual, d.notes
                    ),
                    Err(e) => eprintln!("noise {noise:e} {expected}: {e}"),
                }
            }
        }
        eprintln!(
            "noise {noise:e}: {right} of {all} right, {:?}",
            begun.elapsed()
        );
    }
}
