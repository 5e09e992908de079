//! A flow that is interrupted: what stands there is whole, and make goes on where it was.

use crate::bench::{Tally, shares, times};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Instant, SystemTime};

/// Starts make on two gears, side by side, in a process group of its own as a shell does.
fn start(folder: &Path) -> Child {
    support::make(folder, "gear.mk")
        .args(["-j2", "TEETH=8 10"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .process_group(0)
        .spawn()
        .expect("make is installed")
}

/// All files of a folder: content and time.
fn files(folder: &Path) -> BTreeMap<String, (Vec<u8>, SystemTime)> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries
        .map(|entry| {
            let entry = entry.expect("an entry");
            let time = entry.metadata().and_then(|m| m.modified());
            let content = fs::read(entry.path()).expect("a file");
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, (content, time.expect("a time")))
        })
        .collect()
}

/// Interrupts make, looks at what is there, and lets it go on.
fn interrupt(
    signal: &str,
    whole_group: bool,
    after: std::time::Duration,
    wanted: &BTreeMap<String, (Vec<u8>, SystemTime)>,
) -> Result<(), String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut make = start(folder.path());
    thread::sleep(after);
    let target = match whole_group {
        true => format!("-{}", make.id()),
        false => make.id().to_string(),
    };
    let _ = support::send(&format!("-{signal}"), &target);
    make.wait().expect("a child can be waited for");
    let stands = files(folder.path());
    let wrong = stands.iter().filter_map(|(name, (content, _))| {
        let Some((whole, _)) = wanted.get(name) else {
            return Some(format!("left behind: {name}"));
        };
        let (is, should) = (content.len(), whole.len());
        (whole != content)
            .then(|| format!("{name} has {is} bytes, others than the {should} wanted"))
    });
    let wrong: Vec<String> = wrong.collect();
    if !wrong.is_empty() {
        let after = after.as_secs_f64();
        return Err(format!("{} after {after:.3} s", wrong.join(", ")));
    }
    let again = start(folder.path())
        .wait()
        .expect("a child can be waited for");
    if !again.success() {
        return Err(format!("make does not go on: {again}"));
    }
    let after = files(folder.path());
    let same = |(name, (content, _)): (&String, &(Vec<u8>, SystemTime))| {
        after.get(name).is_some_and(|a| &a.0 == content)
    };
    if after.len() != wanted.len() || !wanted.iter().all(same) {
        return Err("what make goes on with is not what it makes undisturbed".to_owned());
    }
    match stands
        .iter()
        .find(|(name, (_, time))| after[*name].1 != *time)
    {
        Some((name, _)) => Err(format!("{name} was made once more")),
        None => Ok(()),
    }
}

#[test]
fn make_is_interrupted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let begun = Instant::now();
    assert!(start(folder.path()).wait().is_ok_and(|s| s.success()));
    let time = begun.elapsed();
    let wanted = files(folder.path());
    assert!(wanted.len() >= 14, "{:?}", wanted.keys());
    let mut share = shares(5);
    for (kind, signal, whole_group) in [
        ("make and its stages get SIGINT", "INT", true),
        ("make gets SIGTERM", "TERM", false),
        ("make and its stages get SIGHUP", "HUP", true),
    ] {
        let mut tally = Tally::new(kind, "make");
        for _ in 0..times(4) {
            let after = time.mul_f64(1.1 * share());
            tally.add(interrupt(signal, whole_group, after, &wanted));
        }
        tally.close();
    }
}

/// The generator's files are there when they are whole, all of them or none.
#[test]
fn bodies_that_cannot_be_written_leave_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = folder.path().join("gear.stl");
    let nowhere = folder.path().join("none/volumes.json");
    let made = Command::new(support::generator())
        .args(["gear", "--order", "8", "--output"])
        .arg(&output)
        .arg("--volumes")
        .arg(&nowhere)
        .output()
        .expect("the generator was built");
    assert_eq!(made.status.code(), Some(4));
    assert!(made.stdout.is_empty());
    let said = String::from_utf8_lossy(&made.stderr);
    let wanted = format!("body: error: cannot write {}", nowhere.display());
    assert!(
        said.starts_with(&wanted) && said.lines().count() == 1,
        "{said}"
    );
    assert!(files(folder.path()).is_empty());
}
