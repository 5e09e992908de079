//! What goes wrong, tool by tool: exit code, one message, empty standard output, the output file
//! untouched.

use bodies::{Body, Encoding, Face, Gear, Placement, Prism, Tessellation, cube};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use support::{EXACT_STL, Outcome, TOOLS, binary, bytes, encode, finish, pipe, read, run};

const PYRAMID: &[u8] = include_bytes!("../../formats/tmesh/tests/golden/pyramid.tmesh");

/// Offset of the first byte of the given chunk's payload, and its length.
fn payload(document: &[u8], id: &[u8; 4]) -> (usize, usize) {
    let mut offset = 16;
    loop {
        let length = u64::from_le_bytes(document[offset + 8..offset + 16].try_into().expect("8"));
        let length = length as usize;
        if document[offset..].starts_with(id) {
            return (offset + 24, length);
        }
        offset += 24 + length.next_multiple_of(8) + 8;
    }
}

#[test]
fn empty_input() {
    for tool in TOOLS {
        run(tool, &[], b"").fails(3, &["standard input", "did the previous stage fail?"]);
    }
}

#[test]
fn a_document_cut_off_anywhere() {
    for tool in TOOLS {
        // All tools read with the same code: one of them at every byte, the others here and there.
        let step = if tool == "meshqual" { 1 } else { 37 };
        for length in (1..PYRAMID.len()).step_by(step) {
            let outcome = run(tool, &[], &PYRAMID[..length]);
            // Up to the end of the magic number it could be any format.
            let parts: &[&str] = match length {
                0..8 => &["the format is not recognized"],
                _ => &["cut off at byte", "did the previous stage fail?"],
            };
            outcome.fails(3, parts);
        }
    }
}

#[test]
fn a_damaged_document() {
    let mut damaged = PYRAMID.to_vec();
    damaged[500] ^= 4;
    let mut longer = PYRAMID.to_vec();
    longer.extend(b"more");
    let mut newer = PYRAMID.to_vec();
    newer[8] = 9;
    for tool in TOOLS {
        run(tool, &[], &damaged).fails(3, &["is damaged: checksum"]);
        let place = format!(
            "bytes after the end of the document at byte {}",
            PYRAMID.len()
        );
        run(tool, &[], &longer).fails(3, &[&place]);
        run(tool, &[], &newer).fails(3, &["the file header at byte 0 is damaged"]);
    }
}

#[test]
fn input_of_no_known_format() {
    for tool in TOOLS {
        run(tool, &[], &[0xfe; 3000]).fails(3, &["the format is not recognized", "--from"]);
        run(tool, &["--from", "tmesh"], b"solid x\n").fails(3, &["not a tmesh document"]);
    }
}

/// A chunk header that claims more than any machine has, under a limit on memory.
#[test]
fn hostile_counts_take_no_memory() {
    let (vertices, _) = payload(PYRAMID, b"VERT");
    let mut hostile = PYRAMID[..vertices + 40].to_vec();
    for claim in [1_u64 << 33, 1 << 62] {
        let header = &mut hostile[vertices - 24..vertices];
        header[8..16].copy_from_slice(&(claim / 24 * 24).to_le_bytes());
        let crc = crc32fast::hash(&header[..16]);
        header[16..20].copy_from_slice(&crc.to_le_bytes());
        for tool in TOOLS {
            let mut command = Command::new("bash");
            command.args(["-c", "ulimit -v 400000; exec \"$0\""]);
            command.arg(binary(tool));
            finish(tool, command, &hostile).fails(3, &["inside chunk 'VERT'", "cut off at byte"]);
        }
    }
}

#[test]
fn coordinates_that_are_no_numbers() {
    let (start, length) = payload(PYRAMID, b"VERT");
    let mut document = PYRAMID.to_vec();
    document[start + 24..start + 32].copy_from_slice(&f64::NAN.to_le_bytes());
    let crc = crc32fast::hash(&document[start..start + length]);
    document[start + length..start + length + 4].copy_from_slice(&crc.to_le_bytes());
    for tool in TOOLS {
        run(tool, &[], &document).fails(3, &["vertex 1 of template 0 has the coordinates (NaN, 0"]);
    }
}

#[test]
fn wrong_usage() {
    for tool in TOOLS {
        run(tool, &["--no-such-option"], b"").fails(2, &["--no-such-option"]);
        run(tool, &["--from", "dwg"], b"").fails(2, &["known formats are tmesh, stl"]);
        run(tool, &["--quiet", "--verbose"], b"").fails(2, &["cannot be used with"]);
        match tool {
            "symdetect" => run(tool, &["a", "b"], b"").fails(3, &["cannot read a"]),
            _ => run(tool, &["a", "b"], b"").fails(2, &["unexpected argument 'b'"]),
        }
    }
    for tool in ["symdetect", "wedgecut", "tetwedge"] {
        for count in ["0", "-1", "257", "all"] {
            run(tool, &["--threads", count], b"").fails(2, &[count]);
        }
    }
    for tool in ["wedgecut", "periodic-surf", "tetwedge"] {
        for ratio in ["0.5", "-1", "nan", "wide"] {
            run(tool, &["--radius-edge", ratio], b"").fails(2, &["--radius-edge", ratio]);
        }
    }
}

#[test]
fn input_that_cannot_be_opened() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let name = folder.path().to_str().expect("a plain path");
    let missing = format!("{name}/missing.stl");
    for tool in TOOLS {
        run(tool, &[name], b"").fails(3, &[name, "it is a directory"]);
        run(tool, &[&missing], b"").fails(3, &[&missing, "cannot read"]);
    }
}

/// Names in a folder, sorted.
fn listing(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> = entries
        .map(|e| {
            e.expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

#[test]
fn a_failure_leaves_the_output_file_as_it_was() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = folder.path().join("kept.tmesh");
    fs::write(&output, "precious").expect("a file");
    let path = output.to_str().expect("a plain path");
    for tool in TOOLS {
        run(tool, &["-o", path], b"").fails(3, &[]);
        run(tool, &["-o", path], &PYRAMID[..900]).fails(3, &[]);
        assert_eq!(fs::read(&output).expect("still there"), b"precious");
        assert_eq!(listing(folder.path()), ["kept.tmesh"]);
    }
}

/// What each tool can work on: a small prism, as far as the stages before it take it.
fn sound(tool: &str) -> &'static [u8] {
    static STAGES: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    let stages = STAGES.get_or_init(|| {
        let mut inputs = vec![encode(&square_prism(), EXACT_STL)];
        for tool in &TOOLS[..4] {
            let input = inputs.last().expect("at least one");
            inputs.push(run(tool, &[], input).success());
        }
        inputs
    });
    let place = TOOLS.iter().position(|t| *t == tool).expect("a tool");
    &stages[place.min(4)]
}

fn square_prism() -> Body {
    Prism {
        order: 4,
        height: 0.5,
        ..Prism::default()
    }
    .build()
}

#[test]
fn output_that_cannot_be_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let name = folder.path().to_str().expect("a plain path");
    let nowhere = format!("{name}/missing/out.tmesh");
    for tool in TOOLS {
        let input = sound(tool);
        // The report of meshqual is text whatever the extension.
        let to: &[&str] = if tool == "meshqual" {
            &[]
        } else {
            &["--to", "tmesh"]
        };
        let with = |path: &str| run(tool, &[&["-o", path], to].concat(), input);
        with(&nowhere).fails(4, &["cannot write", &nowhere]);
        with(name).fails(4, &["it is a directory"]);
        with("/dev/full").fails(4, &["/dev/full"]);
        if tool != "meshqual" {
            let unknown = format!("{name}/out.dwg");
            run(tool, &["-o", &unknown], input).fails(2, &["names no known format", "--to"]);
            // Before the work: an input that is nothing does not come to be read.
            run(tool, &["-o", &unknown], b"").fails(2, &["names no known format"]);
            run(tool, &["-o", &nowhere], b"").fails(4, &["cannot write", &nowhere]);
            run(tool, &["-o", name], b"").fails(4, &["it is a directory"]);
        }
    }
    assert_eq!(listing(folder.path()), [""; 0]);
}

#[test]
fn a_full_disk_behind_standard_output() {
    for tool in TOOLS {
        let full = fs::OpenOptions::new().write(true).open("/dev/full");
        let mut command = Command::new(binary(tool));
        command.stdin(Stdio::piped()).stderr(Stdio::piped());
        command.stdout(full.expect("/dev/full"));
        let outcome = feed(tool, command, sound(tool));
        outcome.fails(4, &["cannot write standard output"]);
    }
}

#[test]
fn a_closed_pipe_ends_quietly() {
    for tool in TOOLS {
        let mut command = Command::new(binary(tool));
        command.arg("-q");
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        command.stdin(Stdio::piped()).stderr(Stdio::piped());
        command.stdout(writer);
        let outcome = feed(tool, command, sound(tool));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (4, ""), "{tool}");
    }
}

/// Runs a command whose standard output is spoken for.
fn feed(tool: &str, mut command: Command, input: &[u8]) -> Outcome {
    use std::io::Write;
    let mut child = command.spawn().expect("the tool runs");
    let mut stdin = child.stdin.take().expect("piped");
    // Small documents fit into the pipe.
    stdin.write_all(input).expect("room in the pipe");
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    Outcome {
        tool: tool.to_owned(),
        code: output.status.code().unwrap_or(-1),
        stdout: output.stdout,
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// Runs `symdetect` on a body as STL with all digits.
fn detect(body: &Body, arguments: &[&str]) -> Outcome {
    run("symdetect", arguments, &encode(body, EXACT_STL))
}

pub fn gear() -> Body {
    Gear {
        order: 12,
        bore: 0.3,
        ..Gear::default()
    }
    .build()
}

#[test]
fn a_surface_that_is_not_closed() {
    let mut body = cube(1.0, Tessellation::Asymmetric);
    // Four of the six edges of two triangles that share none, or all three of one.
    let hole = body.faces.remove(0).vertices;
    let outcome = detect(&body, &[]);
    outcome.fails(3, &["3 open edges"]);
    let corner = body.vertices[hole[0] as usize];
    let near = format!("{}", corner.x);
    outcome.fails(3, &[&near]);
    run("symdetect", &[], &encode(&body, Encoding::StlBinary)).fails(3, &["3 open edges"]);
}

/// When the first stage fails, the others say so instead of making something of nothing.
#[test]
fn a_failure_upstream() {
    let stages: [&[&str]; 4] = [
        &["symdetect"],
        &["wedgecut"],
        &["tetwedge"],
        &["rotassemble"],
    ];
    let [first, rest @ ..] = &pipe(&stages, b"solid nothing\nendsolid nothing\n")[..] else {
        panic!("four stages");
    };
    first.fails(3, &[]);
    for outcome in rest {
        outcome.fails(3, &["did the previous stage fail?"]);
    }
}

#[test]
fn solids_that_overlap_where_nothing_may_be_changed() {
    // Two cubes, one pushed a third into the other.
    let mut body = cube(1.0, Tessellation::Asymmetric);
    let mut other = cube(1.0, Tessellation::Asymmetric);
    Placement {
        rotate: Some(8),
        ..Placement::default()
    }
    .apply(&mut other);
    let middle = |b: &Body| b.vertices.iter().sum::<glam::DVec3>() / b.vertices.len() as f64;
    let shift = middle(&body) - middle(&other) + glam::DVec3::splat(0.3);
    let first = body.vertices.len() as u32;
    body.vertices
        .extend(other.vertices.iter().map(|p| *p + shift));
    body.faces.extend(other.faces.iter().map(|f| Face {
        vertices: f.vertices.map(|v| v + first),
        front: None,
        back: Some(1),
    }));
    body.materials.push(body.materials[0].clone());
    body.materials[1].name = "intruder".to_owned();
    detect(&body, &["--repair", "off"]).fails(3, &["cube", "intruder"]);
}

#[test]
fn a_body_without_symmetry() {
    let mut body = gear();
    for (i, p) in body.vertices.iter_mut().enumerate() {
        // A dent in one place.
        if i < 3 {
            p.z -= 0.05 * (i + 1) as f64;
        }
    }
    detect(&body, &[]).fails(1, &["symmetr"]);
    let passed = detect(&body, &["--allow-asymmetric"]).success();
    let document = tmesh::read(passed.as_slice()).expect("valid");
    assert_eq!(document.symmetry.expect("stated").group.order, 1);
}

#[test]
fn an_order_that_does_not_hold() {
    detect(&gear(), &["--order", "5"]).fails(1, &["5"]);
    detect(&gear(), &["--order", "24"]).fails(1, &["24"]);
    let found = detect(&gear(), &["--order", "6"]).success();
    let document = tmesh::read(found.as_slice()).expect("valid");
    assert_eq!(document.symmetry.expect("stated").group.order, 6);
    // The cut takes divisors only.
    let found = detect(&gear(), &[]).success();
    run("wedgecut", &["--order", "5"], &found).fails(1, &["5", "12"]);
    run("wedgecut", &["--order", "0"], &found).fails(2, &[]);
}

/// A body of revolution drawn with facets is known by the order of its facets; an order that does not
/// divide it has to be verified first.
#[test]
fn an_order_of_a_body_of_revolution() {
    let drum = Prism {
        order: 80,
        height: 0.5,
        bore: 0.2,
        ..Prism::default()
    };
    let found = detect(&drum.build(), &[]).success();
    let told = ["80", "symdetect --order 7 verifies"];
    run("wedgecut", &["--order", "7"], &found).fails(1, &told);
}

/// A cut that leaves strips a thousandth of an element wide beside the body's edges.
#[test]
fn a_start_angle_close_by_edges() {
    let found = detect(&square_prism(), &["--order", "2"]).success();
    let arguments = ["--domain", "rotation", "--start-angle", "0.0005"];
    let told = [
        "--start-angle 0.0005 passes close by edges",
        "elements in each copy; at",
    ];
    run("wedgecut", &arguments, &found).fails(1, &told);
}

/// A wall named on one side only: sectors are alike in shape, not in names.
#[test]
fn names_that_differ_between_sectors_are_told() {
    let box_of_two_names = "v 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\nv 1 1 3\nv -1 1 3\nv -1 -1 3\nv 1 -1 3\n\
        g inlet\nf 3 4 8 7\ng skin\nf 1 2 6 5\nf 2 3 7 6\nf 4 1 5 8\nf 4 3 2 1\nf 5 6 7 8\n";
    let found = run("symdetect", &[], box_of_two_names.as_bytes()).success();
    let told = run("wedgecut", &[], &found);
    assert_eq!(told.code, 0, "{told:?}");
    assert!(told.stderr.contains("\"inlet\" has 0 %"), "{told:?}");
}

#[test]
fn stages_in_the_wrong_order() {
    let stl = encode(&gear(), EXACT_STL);
    run("wedgecut", &[], &stl).fails(3, &["symdetect"]);
}

/// Documents whose bytes are in order and whose content is not: every word of every payload
/// replaced. Each ends in a result or a failure of the contract, never in a panic.
#[test]
fn altered_documents() {
    let mut tried = 0;
    for id in [b"VERT", b"TRIS", b"TETS", b"AXIS", b"GLUE", b"INST"] {
        let (start, length) = payload(PYRAMID, id);
        let trailer = (start + length).next_multiple_of(8);
        for place in (start..start + length).step_by(4) {
            for word in [0, 1, 2, u32::MAX] {
                let mut altered = PYRAMID.to_vec();
                altered[place..place + 4].copy_from_slice(&u32::to_le_bytes(word));
                let crc = crc32fast::hash(&altered[start..start + length]);
                altered[trailer..trailer + 4].copy_from_slice(&crc.to_le_bytes());
                // What the reader refuses has its own tests.
                if altered == PYRAMID || tmesh::read(altered.as_slice()).is_err() {
                    continue;
                }
                tried += 1;
                for tool in TOOLS {
                    let outcome = run(tool, &["-q"], &altered);
                    if outcome.code != 0 {
                        let code = outcome.code;
                        assert!(code == 1 || code == 3, "{place}: {word}: {outcome:?}");
                        outcome.fails(code, &[]);
                    }
                }
            }
        }
    }
    assert!(tried > 50);
}

#[test]
fn sectors_that_differ_by_more_than_is_stated() {
    let mut gear = Gear::default().build();
    Placement {
        jitter: 1e-5,
        ..Placement::default()
    }
    .apply(&mut gear);
    let mut found = read(&run("symdetect", &["-q"], &encode(&gear, EXACT_STL)).success());
    let symmetry = found.symmetry.as_mut().expect("a symmetry");
    symmetry.residual = 1e-15;
    let cut = run("wedgecut", &["--domain", "rotation"], &bytes(&found));
    cut.fails(
        1,
        &[
            "sections at the two sides of the wedge",
            "near (",
            "--order 1",
        ],
    );
    run("wedgecut", &["-q", "--order", "1"], &bytes(&found)).success();
}
