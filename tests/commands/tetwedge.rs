//! `tetwedge` as a process: what becomes of its mesher's process, its exit codes, its output.

use glam::DVec3;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tmesh::{Document, Gluing, OUTSIDE, Region, Template, Triangle};

const TOOL: &str = env!("CARGO_BIN_EXE_tetwedge");

/// Asks for hours of work and little memory per second of it.
const ENDLESS: &str = "2e-9";

/// A quarter of a square prism of height 1, cut at a mirror plane through its middle.
fn wedge() -> Document {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)];
    let vertices = [0.0, 1.0]
        .iter()
        .flat_map(|&z| corners.map(|(x, y)| DVec3::new(x, y, z)))
        .collect();
    let faces = [
        [0, 2, 1],
        [3, 4, 5],
        [0, 1, 4],
        [0, 4, 3],
        [1, 2, 5],
        [1, 5, 4],
        [2, 0, 3],
        [2, 3, 5],
    ];
    let triangles = faces
        .map(|vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 3,
        })
        .to_vec();
    let wall = |name: &str, k, vertices: [u32; 4], triangles: [u32; 2]| {
        Gluing::mirror(
            name,
            0,
            tmesh::Isometry::reflection(k, 4),
            vertices,
            triangles,
        )
    };
    let mut document = Document::single(Template {
        vertices,
        triangles,
        tets: Vec::new(),
        gluings: vec![
            wall("wall-a", 0, [0, 1, 3, 4], [2, 3]),
            wall("wall-b", 1, [0, 2, 3, 5], [6, 7]),
        ],
        axis: vec![0, 3],
    });
    document.regions.push(Region {
        id: 3,
        name: "copper".to_owned(),
        size: None,
        volume: None,
    });
    assert_eq!(tmesh::validate(&document), []);
    document
}

fn save(folder: &TempDir, document: &Document) -> PathBuf {
    let path = folder.path().join("wedge.tmesh");
    let mut bytes = Vec::new();
    tmesh::write(document, &mut bytes).unwrap();
    fs::write(&path, bytes).unwrap();
    path
}

fn run(input: &Path, arguments: &[&str]) -> (Output, String) {
    let output = Command::new(TOOL)
        .args(arguments)
        .arg(input)
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    (output, text)
}

/// Starts an endless run and waits until the mesher talks; returns it with its child's process id.
fn endless(input: &Path) -> (Child, BufReader<std::process::ChildStderr>, u32) {
    let mut tool = Command::new(TOOL)
        .args(["-v", "--max-volume", ENDLESS, "--timeout", "60"])
        .arg(input)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut messages = BufReader::new(tool.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains("TetGen:") {
        line.clear();
        assert!(messages.read_line(&mut line).unwrap() > 0);
    }
    // The kernel may leave children out of its list while others come and go.
    let begun = Instant::now();
    let child = loop {
        if let Some(child) = child_of(&tool) {
            break child;
        }
        assert!(begun.elapsed() < Duration::from_secs(10), "no mesher");
        std::thread::sleep(Duration::from_millis(5));
    };
    (tool, messages, child)
}

/// Process id of the mesher that the tool runs now, if the kernel tells.
fn child_of(tool: &Child) -> Option<u32> {
    let tasks = fs::read_dir(format!("/proc/{}/task", tool.id())).ok()?;
    tasks
        .filter_map(|task| fs::read_to_string(task.ok()?.path().join("children")).ok())
        .find_map(|children| children.split_whitespace().next()?.parse().ok())
}

/// Sends a signal; the process may be gone.
fn signal(process: u32, name: &str) {
    let command = format!("kill -{name} {process} 2>/dev/null || true");
    let status = Command::new("sh").args(["-c", &command]).status().unwrap();
    assert!(status.success());
}

fn wait_until_gone(process: u32) {
    let begun = Instant::now();
    while Path::new(&format!("/proc/{process}")).exists() {
        assert!(begun.elapsed() < Duration::from_secs(10), "still there");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn meshes_from_a_pipe_and_keeps_its_output_clean() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    for arguments in [vec!["-q"], vec![], vec!["-v"]] {
        let output = Command::new(TOOL)
            .args(&arguments)
            .args(["--max-volume", "0.01", "--region", "copper:max-volume=1e-3"])
            .stdin(fs::File::open(&path).unwrap())
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{text}");
        assert_eq!(text.contains("TetGen:"), arguments == ["-v"], "{text}");
        assert_eq!(text.is_empty(), arguments != ["-v"], "{text}");
        let document = tmesh::read(output.stdout.as_slice()).unwrap();
        assert_eq!(tmesh::validate(&document), []);
        assert!(document.templates[0].tets.len() > 500);
        let entry = document.history.last().unwrap();
        assert_eq!(entry.tool, "tetwedge");
        assert!(entry.notes.iter().any(|n| n.contains("tetrahedra")));
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    let (first, _) = run(&path, &["--max-volume", "0.001"]);
    let (second, _) = run(&path, &["--max-volume", "0.001"]);
    assert!(first.status.success());
    assert_eq!(first.stdout, second.stdout);
}

#[test]
fn a_crash_of_the_mesher_is_one_sentence() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    for (name, phrase) in [("SEGV", "crashed"), ("KILL", "memory ran out")] {
        let (mut tool, mut messages, child) = endless(&path);
        signal(child, name);
        // After a crash equivalent descriptions are tried: let them all crash.
        let status = loop {
            if let Some(status) = tool.try_wait().unwrap() {
                break status;
            }
            std::thread::sleep(Duration::from_millis(50));
            if let Some(child) = child_of(&tool) {
                signal(child, name);
            }
        };
        let mut rest = String::new();
        messages.read_to_string(&mut rest).unwrap();
        assert_eq!(status.code(), Some(1), "{rest}");
        let mut stdout = Vec::new();
        tool.stdout
            .take()
            .unwrap()
            .read_to_end(&mut stdout)
            .unwrap();
        assert!(stdout.is_empty());
        let errors: Vec<_> = rest
            .lines()
            .filter(|l| l.starts_with("tetwedge: error:"))
            .collect();
        assert_eq!(errors.len(), 1, "{rest}");
        assert!(errors[0].contains(phrase), "{rest}");
    }
}

#[test]
fn the_mesher_ends_with_the_tool() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    for name in ["TERM", "KILL"] {
        let (mut tool, _messages, child) = endless(&path);
        signal(tool.id(), name);
        tool.wait().unwrap();
        wait_until_gone(child);
    }
}

#[test]
fn a_time_limit_ends_in_exit_1_and_leaves_files_alone() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    let target = folder.path().join("out.tmesh");
    fs::write(&target, "precious").unwrap();
    let begun = Instant::now();
    let arguments = ["--max-volume", ENDLESS, "--timeout", "0.2", "-o"];
    let (output, text) = run(
        &path,
        &[&arguments[..], &[target.to_str().unwrap()]].concat(),
    );
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(
        text.contains("0.2 s") && text.contains("--timeout"),
        "{text}"
    );
    assert!(begun.elapsed() < Duration::from_secs(20));
    assert_eq!(fs::read_to_string(&target).unwrap(), "precious");
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(left.len(), 2);
}

#[test]
fn failures_have_their_exit_codes() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    let cases: [(&[&str], i32, &str); 8] = [
        (&["--max-volume", "nan"], 2, "finite"),
        (&["--max-volume", "-1"], 2, "above 0"),
        (&["--radius-edge", "0.3"], 2, "0.612"),
        (&["--min-dihedral", "80"], 2, "70.53"),
        (&["--region", "tin:max-volume=1"], 2, "'copper' (3)"),
        (&["--switches", "o2"], 2, "quadratic"),
        (&["--switches", "h"], 1, "without a result"),
        (&["--max-volume", "1e-40"], 1, "at least"),
    ];
    for (arguments, code, phrase) in cases {
        let (output, text) = run(&path, arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
        assert!(text.contains(phrase), "{arguments:?}: {text}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }

    let mut open = wedge();
    open.templates[0].triangles.swap_remove(1);
    open.templates[0].gluings.clear();
    let (output, text) = run(&save(&folder, &open), &[]);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("3 open edge(s)"), "{text}");
    assert!(output.stdout.is_empty());
}

#[test]
fn little_memory_is_said_to_be_little() {
    let folder = TempDir::new().unwrap();
    let path = save(&folder, &wedge());
    let command = format!(
        "ulimit -v 300000; '{TOOL}' --max-volume {ENDLESS} --timeout 100 '{}'",
        path.display()
    );
    let output = Command::new("sh").args(["-c", &command]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("memory"), "{text}");
    assert!(output.stdout.is_empty());
}

#[test]
fn bounds_that_are_not_met_are_said() {
    let folder = TempDir::new().unwrap();
    let input = save(&folder, &wedge());
    // More than the angles of a regular tetrahedron's neighbours in a wedge of 45 degrees.
    let asked = ["--min-dihedral", "60"];
    let (output, text) = run(&input, &asked);
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(text.contains("of 60 asked for: "), "{text}");
    assert!(text.contains("element(s) below, most "), "{text}");
    let (output, text) = run(&input, &[&asked[..], &["--quiet"]].concat());
    assert!(output.status.success() && text.is_empty(), "{text}");
    let (output, text) = run(&input, &[&asked[..], &["--strict"]].concat());
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(
        output.stdout.is_empty() && text.contains("of 60 asked for: "),
        "{text}"
    );
    let (output, text) = run(&input, &["--min-dihedral", "5", "--strict"]);
    assert!(output.status.success(), "{text}");
    assert!(!text.contains("asked for"), "{text}");
}
