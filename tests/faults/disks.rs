//! Disks that are full, at any point of an output.

use crate::bench::{Place, Stage, Tally, refused, shares, stages, times};
use std::process::{Command, Output, Stdio};
use support::binary;

/// Runs a stage under a limit on the size of files, in units of 1024 bytes.
fn limited(stage: &Stage, place: &Place, kibibytes: u64, ignored: bool) -> Output {
    let trap = if ignored { "trap '' XFSZ; " } else { "" };
    let script = format!("{trap}ulimit -f {kibibytes}; exec \"$0\" \"$@\"");
    Command::new("bash")
        .args(["-c", &script])
        .arg(binary(stage.tool))
        .args(place.arguments(stage))
        .stdin(Stdio::null())
        .output()
        .expect("bash is installed")
}

#[test]
fn files_may_not_grow() {
    let mut share = shares(81);
    for stage in stages() {
        for (kind, ignored) in [
            ("file size limit", false),
            ("file size limit, SIGXFSZ ignored", true),
        ] {
            let mut tally = Tally::new(kind, stage.tool);
            for _ in 0..times(3) {
                let place = Place::new(stage);
                let most = (stage.output.len() as u64).saturating_sub(1) / 1024;
                let limit = (share() * most as f64) as u64;
                let output = limited(stage, &place, limit, ignored);
                let text = String::from_utf8_lossy(&output.stderr);
                let name = place.output.to_str().expect("a plain path");
                // The mesher's result goes through a file in memory, which the limit holds for as well.
                let code = output.status.code();
                let mesher = matches!(stage.tool, "tetwedge" | "periodic-surf") && code == Some(1);
                let (wanted, part) = if mesher { (1, "TetGen") } else { (4, name) };
                let refused = refused(stage.tool, code, wanted, &text, part);
                tally.add(refused.and_then(|()| place.check(stage, false, false)));
            }
            tally.close();
        }
    }
}

/// A small file system in memory; only root can have one.
#[test]
fn the_file_system_is_full() {
    let mut share = shares(82);
    for stage in stages() {
        let mut tally = Tally::new("file system full", stage.tool);
        for _ in 0..times(1) {
            let place = Place::new(stage);
            let disk = place.path().join("disk");
            std::fs::create_dir(&disk).expect("a folder");
            let pages = 1 + (share() * (stage.output.len() as f64 - 1.0) / 4096.0) as u64;
            if stage.output.len() as u64 <= 4096 * pages {
                std::fs::remove_dir(&disk).expect("a folder");
                continue;
            }
            let script = "mount -t tmpfs -o size=$1 none \"$2\" 2>/dev/null || exit 99; shift 2; \"$@\"; \
                          code=$?; ls -A disk | tr '\\n' ' '; umount disk; exit $code";
            let output = Command::new("unshare")
                .args(["--mount", "bash", "-c", script, "bash"])
                .args([(4096 * pages).to_string(), "disk".to_owned()])
                .arg(binary(stage.tool))
                .args(stage.arguments)
                .args(["input", "-o", "disk/output.tmesh"])
                .current_dir(place.path())
                .output();
            let Ok(output) = output else { return };
            let text = String::from_utf8_lossy(&output.stderr);
            if output.status.code() == Some(99) || text.starts_with("unshare:") {
                println!("no file system can be mounted: not tried");
                return;
            }
            let left = String::from_utf8_lossy(&output.stdout);
            let refused = refused(
                stage.tool,
                output.status.code(),
                4,
                &text,
                "disk/output.tmesh",
            );
            tally.add(refused.and_then(|()| match left.trim() {
                "" => Ok(()),
                left => Err(format!("left behind: {left}")),
            }));
        }
        tally.close();
    }
}
