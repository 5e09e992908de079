//! Stages that are ended by signals at random moments.

use crate::bench::{Place, Tally, shares, stages, times};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::thread;
use support::binary;

fn ended_by(name: &'static str, number: i32) {
    let mut share = shares(number as u64);
    for stage in stages() {
        let mut tally = Tally::new(name, stage.tool);
        for _ in 0..times(3) {
            let place = Place::new(stage);
            let mut child = place.start(stage);
            thread::sleep(stage.time.mul_f64(1.1 * share()));
            let _ = support::send(&format!("-{number}"), &child.id().to_string());
            let status = child.wait().expect("a child can be waited for");
            tally.add(match (status.code(), status.signal()) {
                (Some(0), _) => place.check(stage, true, false),
                (None, Some(s)) if s == number => place.check(stage, true, number == 9),
                _ => Err(format!("ended with {status}")),
            });
        }
        tally.close();
    }
}

#[test]
fn term() {
    ended_by("SIGTERM", 15);
}

#[test]
fn int() {
    ended_by("SIGINT", 2);
}

#[test]
fn hup() {
    ended_by("SIGHUP", 1);
}

#[test]
fn kill() {
    ended_by("SIGKILL", 9);
}

/// What `nohup` starts, and a shell's background jobs, do not end by what they were told to ignore; nor does
/// the mesher that they run, which gets what their process group gets.
#[test]
fn signals_that_are_ignored() {
    for stage in stages() {
        let mut tally = Tally::new("ignored SIGINT, SIGHUP", stage.tool);
        let place = Place::new(stage);
        let script = "trap '' INT HUP; set -m; \"$0\" \"$@\" & child=$!; \
                      for i in {1..30}; do kill -INT -- -$child; kill -HUP -- -$child; sleep 0.002; done 2>/dev/null; \
                      wait $child";
        let status = Command::new("bash")
            .args(["-c", script])
            .arg(binary(stage.tool))
            .args(place.arguments(stage))
            .stderr(Stdio::null())
            .status()
            .expect("bash is installed");
        tally.add(match status.code() {
            Some(0) => place.check(stage, true, false),
            _ => Err(format!("ended with {status}")),
        });
        tally.close();
    }
}
