//! Pipes whose ends break or trickle.

use crate::bench::{Stage, Tally, refused, shares, stages, times};
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};
use std::thread;
use support::{binary, run};

/// Starts a stage with pipes at all ends.
fn piped(stage: &Stage) -> Child {
    Command::new(binary(stage.tool))
        .args(stage.arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the tool starts")
}

/// Runs a stage with the first `length` bytes of its input, written in pieces.
fn feed(stage: &Stage, length: usize, piece: usize) -> (Option<i32>, Vec<u8>, String) {
    let mut child = piped(stage);
    let mut stdin = child.stdin.take().expect("piped");
    let output = thread::scope(|scope| {
        scope.spawn(move || {
            for part in stage.input[..length].chunks(piece) {
                if stdin.write_all(part).is_err() {
                    return;
                }
            }
        });
        child.wait_with_output().expect("a child can be waited for")
    });
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), output.stdout, text)
}

#[test]
fn upstream_dies() {
    let mut share = shares(71);
    for stage in stages() {
        let mut tally = Tally::new("upstream dies", stage.tool);
        for _ in 0..times(5) {
            let length = (share() * stage.input.len() as f64) as usize;
            let (code, stdout, text) = feed(stage, length, 4096);
            let part = if stage.tool == "symdetect" {
                ""
            } else {
                "standard input: "
            };
            tally.add(refused(stage.tool, code, 3, &text, part).and_then(
                |()| match stdout.len() {
                    0 => Ok(()),
                    n => Err(format!("{n} bytes on standard output")),
                },
            ));
        }
        tally.close();
    }
}

#[test]
fn input_trickles() {
    for stage in stages() {
        let mut tally = Tally::new("input byte by byte", stage.tool);
        // The shape of the reads is not to matter; of long inputs only the first bytes come one by one.
        let few = stage.input.len().min(20_000);
        for piece in [1, 7] {
            if stage.input.len() > few && piece == 1 {
                continue;
            }
            let (code, stdout, text) = feed(stage, stage.input.len(), piece);
            tally.add(match code {
                Some(0) if stdout == stage.output => Ok(()),
                _ => Err(format!("exit {code:?}, {} bytes: {text}", stdout.len())),
            });
        }
        tally.close();
    }
}

#[test]
fn output_is_read_slowly() {
    for stage in stages() {
        let mut tally = Tally::new("output byte by byte", stage.tool);
        let mut child = piped(stage);
        let mut stdin = child.stdin.take().expect("piped");
        let mut stdout = child.stdout.take().expect("piped");
        let mut found = Vec::new();
        thread::scope(|scope| {
            scope.spawn(move || stdin.write_all(&stage.input));
            let mut byte = [0];
            // The first bytes one by one, then by the hundred.
            while found.len() < 5000 && stdout.read(&mut byte).unwrap_or(0) == 1 {
                found.push(byte[0]);
            }
            let mut some = [0; 100];
            while let Ok(n @ 1..) = stdout.read(&mut some) {
                found.extend(&some[..n]);
            }
        });
        let status = child.wait().expect("a child can be waited for");
        tally.add(match status.code() {
            Some(0) if found == stage.output => Ok(()),
            _ => Err(format!("{status}, {} bytes", found.len())),
        });
        tally.close();
    }
}

#[test]
fn downstream_closes() {
    let mut share = shares(72);
    for stage in stages() {
        let mut tally = Tally::new("downstream closes", stage.tool);
        for _ in 0..times(5) {
            let length = (share() * share() * stage.output.len() as f64) as usize;
            let mut child = piped(stage);
            let mut stdin = child.stdin.take().expect("piped");
            let mut stdout = child.stdout.take().expect("piped");
            let output = thread::scope(|scope| {
                scope.spawn(move || stdin.write_all(&stage.input));
                let mut some = vec![0; length];
                let _ = stdout.read_exact(&mut some);
                drop(stdout);
                child.wait_with_output().expect("a child can be waited for")
            });
            let text = String::from_utf8_lossy(&output.stderr);
            tally.add(match output.status.code() {
                // What fits into the pipe is written before anybody closes it.
                Some(0 | 4) if !text.contains("error") => Ok(()),
                code => Err(format!("exit {code:?}: {text}")),
            });
        }
        tally.close();
    }
}

#[test]
fn nobody_hears_the_messages() {
    for stage in stages() {
        let mut tally = Tally::new("standard error is closed", stage.tool);
        for (redirect, input, wanted) in [
            ("2>&-", &stage.input[..], 0),
            ("2>/dev/full", &stage.input, 0),
            ("2>/dev/full", b"", 3),
        ] {
            let script = format!("exec \"$0\" \"$@\" -vv {redirect}");
            let mut command = Command::new("bash");
            command.args(["-c", &script]).arg(binary(stage.tool));
            command.args(stage.arguments);
            let outcome = support::finish(stage.tool, command, input);
            tally.add(match outcome.code == wanted {
                true => Ok(()),
                false => Err(format!("{redirect}: exit {}", outcome.code)),
            });
        }
        tally.close();
    }
}

/// One stage of a whole pipe is killed: those after it say so, and nothing comes out.
#[test]
fn a_stage_of_a_pipe_is_killed() {
    let first = &stages()[0];
    for killed in 0..5 {
        let mut tally = Tally::new("killed within a pipe", stages()[killed].tool);
        for _ in 0..times(2) {
            // Its input stays open, so it cannot be done before it is killed.
            let mut upstream = Some(Stdio::piped());
            let mut children = Vec::new();
            for stage in &stages()[killed..5] {
                let mut child = Command::new(binary(stage.tool))
                    .args(stage.arguments)
                    .stdin(upstream.take().expect("a pipe"))
                    .stdout(Stdio::piped())
                    .stderr(Stdio::piped())
                    .spawn()
                    .expect("the tool starts");
                if stage.tool != "rotassemble" {
                    upstream = child.stdout.take().map(Stdio::from);
                }
                children.push((stage.tool, child));
            }
            let mut stdin = children[0].1.stdin.take().expect("piped");
            let _ = stdin.write_all(&stages()[killed].input[..100]);
            children[0].1.kill().expect("it runs");
            for (tool, child) in children.into_iter().skip(1) {
                let output = child.wait_with_output().expect("a child can be waited for");
                let text = String::from_utf8_lossy(&output.stderr);
                let part = "did the previous stage fail?";
                tally.add(refused(tool, output.status.code(), 3, &text, part));
                let quiet = output.stdout.is_empty();
                tally.add(if quiet { Ok(()) } else { Err("output".into()) });
            }
            drop(stdin);
        }
        tally.close();
    }
    // The same input unharmed.
    run(first.tool, first.arguments, &first.input).success();
}
