//! Hostile sizes: inputs of the kinds that make programs slow or large, and limits on memory.

use crate::failures::gear;
use bodies::Encoding;
use bodies::adversarial as shapes;
use interchange::{Format, write_document};
use std::process::Command;
use std::time::{Duration, Instant};
use support::{Outcome, binary, encode, finish, run};

/// Memory that reading may take, as the README says: so many bytes per byte of the file, and so many
/// whatever its size.
const PER_BYTE: usize = 32;
const FIXED: usize = 64 << 20;

/// Runs a tool that may not have more than `bytes` of address space.
fn within(bytes: usize, tool: &str, arguments: &[&str], input: &[u8]) -> Outcome {
    let mut command = Command::new("sh");
    let script = format!("ulimit -v {} && exec \"$0\" \"$@\"", bytes / 1024);
    command
        .args(["-c", &script])
        .arg(binary(tool))
        .args(arguments);
    finish(tool, command, input)
}

#[test]
fn every_shape_goes_through_in_time() {
    // With debug assertions and beside other tests: twenty times what it takes alone.
    let limit = Duration::from_secs(120);
    for (name, _, make) in shapes::SHAPES {
        let size = if name == "spindle" { 1000 } else { 5000 };
        let off = shapes::off(&make(size));
        let begun = Instant::now();
        let report = run("meshqual", &["--check"], off.as_bytes());
        assert_eq!(report.code, 0, "{name}: {}", report.stderr);
        let found = run("symdetect", &["-q"], off.as_bytes()).success();
        let wedge = run("wedgecut", &["-q"], &found).success();
        run("tetwedge", &["-q", "--no-quality"], &wedge).success();
        assert!(begun.elapsed() < limit, "{name}: {:?}", begun.elapsed());
    }
}

/// Separate pieces whose sides are in line with each other, cut in half by the walls: rays that look for what is
/// opposite run along edges.
#[test]
fn shells_in_line() {
    let off = shapes::off(&shapes::shells(17 * 17 * 17));
    let found = run("symdetect", &["-q"], off.as_bytes()).success();
    let wedge = run("wedgecut", &["-q"], &found).success();
    run("tetwedge", &["-q", "--no-quality"], &wedge).success();
}

#[test]
fn reading_takes_memory_in_proportion_to_the_file() {
    let off = shapes::off(&shapes::coplanar(200_000)).into_bytes();
    let document = heal::read(&off, Format::Off).expect("it is sound").document;
    let mut files = vec![(Format::Off, off)];
    for format in [
        Format::Tmesh,
        Format::Stl,
        Format::Vtk,
        Format::Vtu,
        Format::Msh,
        Format::Msh2,
    ] {
        let mut bytes = Vec::new();
        write_document(&document, format, &mut bytes).expect("a vector takes all bytes");
        files.push((format, bytes));
    }
    for (format, bytes) in files {
        let allowed = PER_BYTE * bytes.len() + FIXED;
        let listing = within(allowed, "rotassemble", &["--to", "txt"], &bytes);
        assert_eq!(listing.code, 0, "{format:?}: {}", listing.stderr);
        // What a header claims takes no memory: half of the file within the same bounds.
        let half = within(
            allowed,
            "rotassemble",
            &["--to", "txt"],
            &bytes[..bytes.len() / 2],
        );
        assert_eq!(half.code, 3, "{format:?}: {}", half.stderr);
    }
}

#[test]
fn meshing_within_a_limit_on_memory() {
    let gear = gear();
    let found = run("symdetect", &["-q"], &encode(&gear, Encoding::StlBinary)).success();
    let wedge = run("wedgecut", &["-q"], &found).success();
    let fine = ["--max-volume", "1e-7"];
    let outcome = run(
        "tetwedge",
        &["--max-memory", "8M", fine[0], fine[1]],
        &wedge,
    );
    outcome.fails(
        1,
        &["needs more than 8 MiB of memory", "raise --max-memory"],
    );
    run("tetwedge", &["-q", "--max-memory", "2G"], &wedge).success();
}

/// Damage and a version from the future are told apart.
#[test]
fn damage_and_other_versions_have_messages_of_their_own() {
    let gear = gear();
    let document = run("symdetect", &["-q"], &encode(&gear, Encoding::StlBinary)).success();
    for tool in ["wedgecut", "tetwedge", "rotassemble", "meshqual"] {
        let mut newer = document.clone();
        newer[8] = 2;
        run(tool, &[], &newer).fails(3, &["damaged"]);
        let crc = crc32fast::hash(&newer[..12]);
        newer[12..16].copy_from_slice(&crc.to_le_bytes());
        run(tool, &[], &newer).fails(3, &["version 2", "update the tools"]);
        let mut altered = document.clone();
        let middle = altered.len() / 2;
        altered[middle] ^= 16;
        run(tool, &[], &altered).fails(3, &["damaged", "checksum"]);
        run(tool, &[], &document[..middle]).fails(3, &["cut off", "did the previous stage fail?"]);
        run(tool, &[], &[&document[..], b"\n"].concat()).fails(3, &["after the end"]);
    }
}
