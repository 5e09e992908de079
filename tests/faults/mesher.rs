//! A mesher that aborts, crashes, hangs or runs out of memory: TetGen's process is found and hit.

use crate::bench::{Place, Stage, Tally, refused, stages, times};
use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use support::binary;

/// More elements than anybody waits for.
const LONG: [&str; 2] = ["--max-volume", "1e-9"];

fn meshers() -> impl Iterator<Item = &'static Stage> {
    let all = stages().iter();
    all.filter(|s| matches!(s.tool, "periodic-surf" | "tetwedge"))
}

fn start(stage: &Stage, place: &Place, more: &[&str]) -> Child {
    Command::new(binary(stage.tool))
        .args(place.arguments(stage))
        .args(more)
        .stdin(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the tool starts")
}

/// Processes that a process has started and that are still there.
fn children_of(id: u32) -> Vec<u32> {
    let Ok(threads) = fs::read_dir(format!("/proc/{id}/task")) else {
        return Vec::new();
    };
    let lists = threads
        .flatten()
        .map(|t| fs::read_to_string(t.path().join("children")).unwrap_or_default());
    let text: Vec<String> = lists.collect();
    let words = text.iter().flat_map(|t| t.split_whitespace());
    words.filter_map(|w| w.parse().ok()).collect()
}

/// The process of TetGen, once it is there.
fn child_of(process: &Child) -> Option<u32> {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(20) {
        if let Some(&id) = children_of(process.id()).first() {
            return Some(id);
        }
        thread::sleep(Duration::from_millis(1));
    }
    None
}

fn end(stage: &Stage, place: &Place, child: Child, part: &str) -> Result<(), String> {
    let output = child.wait_with_output().map_err(|e| e.to_string())?;
    let text = String::from_utf8_lossy(&output.stderr);
    refused(stage.tool, output.status.code(), 1, &text, part)?;
    place.check(stage, false, false)
}

fn signalled(id: u32, signal: &str) -> bool {
    support::send(signal, &id.to_string())
}

/// Hits every process of TetGen that the tool starts: it tries again some times.
fn hit(kind: &'static str, signal: &'static str, part: &str) {
    for stage in meshers() {
        let mut tally = Tally::new(kind, stage.tool);
        for _ in 0..times(1) {
            let place = Place::new(stage);
            let mut child = start(stage, &place, &LONG);
            let begun = Instant::now();
            while child
                .try_wait()
                .expect("a child can be waited for")
                .is_none()
            {
                // More than once: what comes before the process has begun may pass it by.
                for id in children_of(child.id()) {
                    signalled(id, signal);
                }
                if begun.elapsed() > Duration::from_secs(60) {
                    child.kill().expect("it runs");
                }
                thread::sleep(Duration::from_millis(5));
            }
            tally.add(end(stage, &place, child, part));
        }
        tally.close();
    }
}

#[test]
fn aborts() {
    hit("TetGen aborts", "-ABRT", "TetGen crashed (it aborted)");
}

#[test]
fn crashes() {
    hit(
        "TetGen crashes",
        "-SEGV",
        "TetGen crashed (segmentation fault)",
    );
}

#[test]
fn is_killed() {
    hit("TetGen is killed", "-KILL", "TetGen was killed");
}

#[test]
fn is_stopped_from_outside() {
    // An interrupt may be ignored.
    hit(
        "TetGen is stopped",
        "-USR1",
        "TetGen was stopped from outside (signal 10)",
    );
}

#[test]
fn hangs() {
    for stage in meshers() {
        let mut tally = Tally::new("TetGen hangs", stage.tool);
        for _ in 0..times(1) {
            let place = Place::new(stage);
            let child = start(stage, &place, &[LONG[0], LONG[1], "--timeout", "0.5"]);
            let stopped = child_of(&child).is_some_and(|id| signalled(id, "-STOP"));
            let result = end(stage, &place, child, "0.5 s, the time limit");
            tally.add(if stopped {
                result
            } else {
                Err("TetGen did not start".to_owned())
            });
        }
        tally.close();
    }
}

#[test]
fn runs_out_of_memory() {
    for stage in meshers() {
        let mut tally = Tally::new("TetGen runs out of memory", stage.tool);
        for limit in [420_000, 700_000].into_iter().take(times(1) as usize) {
            let place = Place::new(stage);
            let child = Command::new("bash")
                .args(["-c", &format!("ulimit -v {limit}; exec \"$0\" \"$@\"")])
                .arg(binary(stage.tool))
                .args(place.arguments(stage))
                .args(LONG)
                .stdin(Stdio::null())
                .stderr(Stdio::piped())
                .spawn()
                .expect("bash is installed");
            tally.add(end(stage, &place, child, "memory"));
        }
        tally.close();
    }
}

/// TetGen does not outlive the tool that started it.
#[test]
fn the_tool_is_killed() {
    for stage in meshers() {
        for (kind, signal) in [
            ("killed with TetGen", "-KILL"),
            ("ended with TetGen", "-TERM"),
        ] {
            let mut tally = Tally::new(kind, stage.tool);
            let place = Place::new(stage);
            let mut child = start(stage, &place, &LONG);
            let mesher = child_of(&child);
            signalled(child.id(), signal);
            child.wait().expect("a child can be waited for");
            let begun = Instant::now();
            let alive = |id: u32| {
                let stat = fs::read_to_string(format!("/proc/{id}/stat"));
                stat.is_ok_and(|s| !s.contains(") Z "))
            };
            let mut gone = mesher.is_some_and(|id| !alive(id));
            while !gone && begun.elapsed() < Duration::from_secs(5) {
                thread::sleep(Duration::from_millis(5));
                gone = mesher.is_some_and(|id| !alive(id));
            }
            tally.add(match gone {
                true => place.check(stage, false, signal == "-KILL"),
                false => Err(format!("TetGen {mesher:?} goes on")),
            });
            tally.close();
        }
    }
}
