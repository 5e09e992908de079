//! The same bytes from the same input: in every run, with any number of threads, and on processors with and
//! without vector and fused instructions.

use bodies::{Body, Gear, Placement, Ratchet, Tessellation, Tsv};
use std::process::Command;
use support::{EXACT_STL, Outcome, binary, encode, finish};

/// What glibc's functions such as `sin` are computed without: they have a version for processors with fused
/// multiplication, which differs in the last bit.
const WITHOUT: &str = "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F,-AVX_Usable,-AVX2_Usable,\
                       -FMA_Usable,-FMA4_Usable,-AVX512F_Usable";

fn bodies() -> [(&'static str, Body); 3] {
    let mut bodies = [
        (
            "via",
            Tsv {
                order: 16,
                core: 0.2,
                thickness: 0.02,
                height: 0.5,
                ..Tsv::default()
            }
            .build(),
        ),
        (
            "gear",
            Gear {
                order: 12,
                bore: 0.3,
                tessellation: Tessellation::Asymmetric,
                ..Gear::default()
            }
            .build(),
        ),
        (
            "ratchet",
            Ratchet {
                order: 7,
                bore: 0.3,
                tessellation: Tessellation::Asymmetric,
                ..Ratchet::default()
            }
            .build(),
        ),
    ];
    for (i, (_, body)) in bodies.iter_mut().enumerate() {
        Placement {
            rotate: Some(i as u64),
            ..Placement::default()
        }
        .apply(body);
    }
    bodies
}

/// What every stage of the pipe writes.
fn stages(input: &[u8], prepare: impl Fn(&mut Command, &str)) -> Vec<Vec<u8>> {
    let stages: [&[&str]; 6] = [
        &["symdetect", "-q"],
        &["wedgecut", "-q"],
        &["periodic-surf", "-q"],
        &["tetwedge", "-q"],
        &["rotassemble", "-q"],
        &["meshqual", "--check"],
    ];
    let mut written: Vec<Vec<u8>> = Vec::new();
    for stage in stages {
        let mut command = Command::new(binary(stage[0]));
        command.args(&stage[1..]);
        prepare(&mut command, stage[0]);
        let input = written.last().map_or(input, Vec::as_slice);
        let outcome: Outcome = finish(stage[0], command, input);
        written.push(outcome.success());
    }
    written
}

#[test]
fn the_bytes_do_not_depend_on_threads_or_instructions() {
    for (name, body) in bodies() {
        let input = encode(&body, EXACT_STL);
        let usual = stages(&input, |_, _| {});
        let others = [
            ("again", stages(&input, |_, _| {})),
            // The history has the arguments, so that runs with other ones differ in it.
            (
                "without vector instructions",
                stages(&input, |command, _| {
                    command.env("GLIBC_TUNABLES", WITHOUT);
                }),
            ),
        ];
        for (how, other) in others {
            for (stage, (a, b)) in usual.iter().zip(&other).enumerate() {
                assert!(a == b, "{name}, stage {stage}: other bytes {how}");
            }
        }
        let threads = |n: &'static str| {
            stages(&input, move |command, tool| {
                if ["symdetect", "wedgecut", "tetwedge"].contains(&tool) {
                    command.args(["--threads", n]);
                }
            })
        };
        let [one, four] = ["1", "4"].map(threads);
        for (stage, (a, b)) in one.iter().zip(&four).enumerate() {
            let [a, b] = [a, b].map(|bytes| without_history(bytes));
            assert!(a == b, "{name}, stage {stage}: other bytes with 4 threads");
        }
    }
}

/// A document without its history, or other bytes as they are.
fn without_history(bytes: &[u8]) -> Vec<u8> {
    let Ok(mut document) = tmesh::read(bytes) else {
        return bytes.to_vec();
    };
    document.history.clear();
    let mut bytes = Vec::new();
    tmesh::write(&document, &mut bytes).expect("a vector takes all bytes");
    bytes
}
