//! A few random bodies of the soak test through the whole pipe; `make soak` takes many more.

#[path = "../examples/soak/dice.rs"]
mod dice;
#[path = "../examples/body/generator/mod.rs"]
#[allow(dead_code, unused_imports)]
mod generator;
#[path = "../examples/soak/solid/mod.rs"]
#[allow(dead_code)]
mod solid;
#[path = "../examples/soak/trial/mod.rs"]
#[allow(dead_code)]
mod trial;

use std::path::Path;
use std::time::Duration;
use trial::{Laboratory, Verdict};

#[test]
fn random_bodies_are_meshed_and_checked() {
    let tools = Path::new(env!("CARGO_BIN_EXE_symdetect")).parent();
    let laboratory = Laboratory {
        binaries: tools.expect("a folder").to_owned(),
        limit: Duration::from_secs(300),
        twice: 8,
    };
    let mut failed = Vec::new();
    // Of the last one, noise leaves a face in a wall beside the axis.
    for seed in (1..=24).chain([3250]) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let trial = laboratory.trial(seed, folder.path()).expect("it runs");
        match trial.verdict {
            Verdict::Meshed | Verdict::Asymmetric => {}
            other => failed.push(format!("seed {seed}, {}: {other:?}", trial.description)),
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
