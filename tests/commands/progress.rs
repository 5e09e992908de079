//! What `tetwedge` and `periodic-surf` say of their work while it goes on, at a terminal and elsewhere.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use support::{Outcome, binary, finish, generator, read, run};
use tempfile::TempDir;

/// The wedge of a body of the generator, cut for elements of a size.
fn wedge(body: &str, wishes: &[&str]) -> Vec<u8> {
    let mut command = Command::new(generator());
    command.args(body.split(' ')).args(["--to", "tmesh"]);
    let body = finish("body", command, &[]).success();
    let body = run("symdetect", &[], &body).success();
    run("wedgecut", wishes, &body).success()
}

/// Runs a tool on a file at a terminal of 80 columns, which hears standard output and standard error.
fn at_terminal(tool: &str, arguments: &[&str], input: &Path) -> (i32, String) {
    let quoted = |text: &str| format!("'{text}'");
    let program = binary(tool);
    let words = [program.to_str().unwrap(), input.to_str().unwrap()];
    let words: Vec<String> = words
        .iter()
        .chain(arguments)
        .map(|word| quoted(word))
        .collect();
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &words.join(" ")])
        .arg("/dev/null")
        .env("TERM", "xterm")
        .stdin(Stdio::null())
        .output()
        .expect("util-linux has `script`");
    let text = String::from_utf8(output.stdout).unwrap();
    (output.status.code().unwrap(), text)
}

/// The number before some words in a line, whose digits are in groups of three.
fn number_before(line: &str, words: &str) -> Option<f64> {
    let before = line[..line.find(words)?].trim_end();
    let digits = before
        .rsplit(|c: char| c != ' ' && !c.is_ascii_digit())
        .next()?;
    digits.replace(' ', "").parse().ok()
}

/// Tetrahedra of all templates.
fn tetrahedra(document: &[u8]) -> f64 {
    let document = read(document);
    document.templates.iter().map(|t| t.tets.len() as f64).sum()
}

/// What is said but for the bound of the volume, which TetGen does not meet for some elements of a thousand.
fn but_for_volumes(text: &str) -> String {
    let kept = text.split_inclusive('\n').map(|line| {
        let said = match line.starts_with('{') {
            true => line.contains(" asked for: ").then_some(0),
            false => line.find("tetwedge: volume "),
        };
        &line[..said.unwrap_or(line.len())]
    });
    kept.collect()
}

#[test]
fn a_terminal_sees_how_far_the_mesh_is() {
    let folder = TempDir::new().unwrap();
    let input = folder.path().join("wedge.tmesh");
    let made = folder.path().join("mesh.tmesh");
    fs::write(&input, wedge("prism --order 4", &["--max-volume", "2e-6"])).unwrap();
    let arguments = ["--output", made.to_str().unwrap()];
    let (code, text) = at_terminal("tetwedge", &arguments, &input);
    assert_eq!(code, 0, "{text}");
    let text = but_for_volumes(&text);
    let lines: Vec<&str> = text.split(['\r', '\n']).collect();
    let forecast = lines.iter();
    let mut forecast = forecast.filter_map(|line| number_before(line, " tetrahedra, about"));
    let expected = forecast.next().unwrap();
    let watched = fs::read(&made).unwrap();
    let count = tetrahedra(&watched);
    assert!((0.5..2.0).contains(&(count / expected)), "{count}: {text}");
    // Elements become more until the mesh is improved. How often that is said depends on how busy the machine is.
    let refining = lines.iter().filter(|line| line.contains("refining mesh: "));
    let refining: Vec<f64> = refining
        .filter_map(|line| number_before(line, " of about"))
        .collect();
    assert!(!refining.is_empty() && refining.is_sorted(), "{text}");
    assert!(text.contains(" %, "), "{text}");
    assert!(text.contains(" points"), "{text}");
    assert!(text.contains("improving elements: "), "{text}");
    // The line is gone in the end, and it was one line all the time.
    assert!(
        lines[lines.len() - 1].trim_end().ends_with("\u{1b}[2K"),
        "{text:?}"
    );
    assert!(text.matches('\n').count() <= 3, "{text:?}");

    // Nobody else hears of it, and the mesh is the same.
    let (code, text) = at_terminal("tetwedge", &["-q", arguments[0], arguments[1]], &input);
    assert_eq!((code, text.as_str()), (0, ""));
    let (code, text) = at_terminal(
        "tetwedge",
        &["--message-format=json", arguments[0], arguments[1]],
        &input,
    );
    assert_eq!((code, but_for_volumes(&text).as_str()), (0, ""));
    let all = [&[input.to_str().unwrap()], &arguments[..]].concat();
    let Outcome { code, stderr, .. } = run("tetwedge", &all, &[]);
    assert_eq!((code, but_for_volumes(&stderr).as_str()), (0, ""));
    assert!(fs::read(&made).unwrap() == watched);
}

#[test]
fn a_surface_mesh_is_watched_too() {
    let folder = TempDir::new().unwrap();
    let input = folder.path().join("wedge.tmesh");
    let made = folder.path().join("mesh.tmesh");
    let wedge = wedge("ratchet --order 12", &["--edge-length", "0.1"]);
    fs::write(&input, wedge).unwrap();
    let arguments = ["--output", made.to_str().unwrap()];
    let (code, text) = at_terminal("tetwedge", &arguments, &input);
    assert_eq!(code, 0, "{text}");
    for step in ["surface mesh, refining mesh", ": recovering boundaries"] {
        assert!(text.contains(step), "{text}");
    }
    let (code, text) = at_terminal("periodic-surf", &arguments, &input);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("periodic-surf: refining mesh"), "{text}");
}

#[test]
fn elements_are_forecast_within_a_factor_of_two() {
    let size = ["--edge-length", "0.07"];
    for (body, wishes) in [
        ("prism --order 16", &size[..]),
        ("cube", &size),
        ("ring --order 16 --thickness 0.02", &size),
        ("tsv --order 16 --thickness 0.02", &size),
        ("tsv --order 32", &size),
        ("gear --order 12", &size),
        ("ratchet --order 12", &size),
        ("screw --order 5", &size),
        ("ring --order 64", &[]),
    ] {
        let wedge = wedge(body, wishes);
        let Outcome { stdout, stderr, .. } = run("tetwedge", &["-v"], &wedge);
        let lines = stderr.lines();
        let expected = lines
            .filter_map(|line| number_before(line, " tetrahedra, about"))
            .next();
        let share = tetrahedra(&stdout) / expected.unwrap();
        assert!((0.5..2.0).contains(&share), "{body}: {share}");
    }
}

#[test]
fn nothing_is_forecast_without_anything_to_tell_it_by() {
    let wedge = wedge("prism --order 4", &[]);
    let Outcome { code, stderr, .. } = run("tetwedge", &["-v", "--no-quality"], &wedge);
    assert_eq!(code, 0);
    assert!(!stderr.contains("tetrahedra, about"), "{stderr}");
}
