//! Inputs that cannot be read to their end, and outputs that are in use.

use crate::bench::{Place, Tally, refused, stages, times};
use std::fs;
use std::process::Command;
use support::binary;

#[test]
fn inputs_that_fail_to_be_read() {
    for stage in stages() {
        let mut tally = Tally::new("input unreadable", stage.tool);
        // A directory opens and does not read; the memory of a process has nothing at address 0; the
        // last is gone.
        for path in ["/", "/proc/self/mem", "/proc/self/fd/99", "input-that-was"] {
            let output = Command::new(binary(stage.tool))
                .args(stage.arguments)
                .arg(path)
                .output()
                .expect("the tool starts");
            let text = String::from_utf8_lossy(&output.stderr);
            tally.add(refused(stage.tool, output.status.code(), 3, &text, path));
        }
        tally.close();
    }
}

#[test]
fn an_input_that_vanishes() {
    for stage in stages() {
        let mut tally = Tally::new("input removed while read", stage.tool);
        for _ in 0..times(1) {
            let place = Place::new(stage);
            let mut child = place.start(stage);
            let _ = fs::remove_file(&place.input);
            // Gone before it was opened, or read to its end all the same.
            let status = child.wait().expect("a child can be waited for");
            tally.add(match status.code() {
                Some(0) => place.check(stage, true, false),
                Some(3) => place.check(stage, false, false),
                _ => Err(format!("ended with {status}")),
            });
        }
        tally.close();
    }
}

/// The output replaces the input once it is whole; when it fails, the input is what it was.
#[test]
fn the_output_is_the_input() {
    for stage in stages() {
        let mut tally = Tally::new("output is the input", stage.tool);
        let place = Place::new(stage);
        fs::rename(&place.input, &place.output).expect("a file");
        let path = place.output.to_str().expect("a plain path");
        let run = |more: &[&str]| {
            Command::new(binary(stage.tool))
                .args(stage.arguments)
                .args([path, "-o", path])
                .args(more)
                .output()
                .expect("the tool starts")
        };
        let failed = run(&["--from", "off"]);
        let kept = fs::read(&place.output).expect("a file") == stage.input;
        tally.add(match (failed.status.code(), kept) {
            (Some(3), true) => Ok(()),
            (code, kept) => Err(format!("exit {code:?}, input kept: {kept}")),
        });
        let done = run(&[]);
        tally.add(match done.status.code() {
            Some(0) => place.check(stage, true, false),
            code => Err(format!("exit {code:?}")),
        });
        tally.close();
    }
}

#[test]
fn several_runs_write_the_same_output() {
    for stage in stages() {
        let mut tally = Tally::new("one output of four runs", stage.tool);
        for _ in 0..times(1) {
            let place = Place::new(stage);
            let children: Vec<_> = (0..4).map(|_| place.start(stage)).collect();
            let mut result = Ok(());
            for mut child in children {
                let status = child.wait().expect("a child can be waited for");
                if !status.success() {
                    result = Err(format!("ended with {status}"));
                }
            }
            tally.add(result.and_then(|()| place.check(stage, true, false)));
        }
        tally.close();
    }
}
