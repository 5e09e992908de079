//! Messages as objects, of every tool: `--message-format json`.

use serde_json::Value;
use support::{TOOLS, run};

const PYRAMID: &[u8] = include_bytes!("../../formats/tmesh/tests/golden/pyramid.tmesh");

/// Runs a tool; its exit code and the objects on standard error.
#[track_caller]
fn objects(tool: &str, arguments: &[&str], input: &[u8]) -> (i32, Vec<Value>) {
    let output = run(tool, arguments, input);
    let objects = output.stderr.lines();
    let objects = objects.map(|line| match serde_json::from_str(line) {
        Ok(object) => object,
        Err(error) => panic!("{error}: {line}"),
    });
    (output.code, objects.collect())
}

/// The run fails with one object that says why.
#[track_caller]
fn fails(tool: &str, arguments: &[&str], input: &[u8], code: i32, part: &str) {
    let (found, objects) = objects(tool, arguments, input);
    assert_eq!(found, code, "{objects:?}");
    let errors: Vec<_> = objects.iter().filter(|o| o["level"] == "error").collect();
    assert_eq!(errors.len(), 1, "{objects:?}");
    assert_eq!(objects.last(), Some(errors[0]));
    assert_eq!(errors[0]["tool"], tool);
    assert_eq!(errors[0]["code"], code);
    let message = errors[0]["message"].as_str().expect("text");
    assert!(message.contains(part), "{message}");
}

#[test]
fn errors_are_objects() {
    for tool in TOOLS {
        let json = ["--message-format", "json"];
        fails(tool, &json, b"", 3, "did the previous stage fail?");
        fails(tool, &json, &PYRAMID[..500], 3, "cut off at byte 500");
        let nowhere = [json[0], json[1], "/nowhere/mesh.stl"];
        fails(tool, &nowhere, b"", 3, "/nowhere/mesh.stl");
        // The command line itself is wrong, before and after the option.
        let wrong = ["--odd", "--message-format=json"];
        fails(tool, &wrong, b"", 2, "unexpected argument '--odd' found");
        let wrong = ["--message-format=json", "--from", "odd"];
        fails(tool, &wrong, b"", 2, "'odd'");
        let exclusive = ["--message-format=json", "-q", "-v"];
        fails(tool, &exclusive, b"", 2, "cannot be used with");
    }
    let unmet = ["--message-format=json", "--fail-below", "volume=1e9"];
    fails("meshqual", &unmet, PYRAMID, 1, "volume");
    let nowhere = ["--message-format=json", "-o", "/nowhere/report"];
    fails("meshqual", &nowhere, PYRAMID, 4, "/nowhere/report");
}

#[test]
fn other_messages_are_objects_too() {
    let arguments = ["--message-format=json", "--allow-asymmetric", "-vv"];
    let off = b"OFF 4 4 0\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let (code, objects) = objects("symdetect", &arguments, off);
    assert_eq!(code, 0, "{objects:?}");
    let has = |level: &str| objects.iter().any(|o| o["level"] == level);
    assert!(has("note") && has("info") && !has("error"), "{objects:?}");
    for object in &objects {
        assert!(object["message"].is_string() && object["tool"] == "symdetect");
        assert_eq!(object["seconds"].is_number(), object["level"] == "info");
    }
}
