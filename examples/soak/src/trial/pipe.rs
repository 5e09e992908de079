//! Running a pipe of tools, each with a time limit.

use super::commands::Stage;
use std::fs::File;
use std::io;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How a stage ended.
#[derive(Clone, Debug)]
pub struct Ended {
    /// Tool.
    pub tool: String,
    /// Exit code; `None` when a signal ended it, ours after the time limit among them.
    pub code: Option<i32>,
    /// Whether the time limit was reached.
    pub hung: bool,
    /// What it said.
    pub messages: String,
}

/// Runs stages connected by pipes, all at once. Input, output and messages are files in `folder`:
/// `input`, `output`, and `N-tool.log`.
///
/// # Errors
/// Fails when a process cannot be started or a file not be made.
pub fn run(
    binaries: &Path,
    folder: &Path,
    stages: &[Stage],
    input: &str,
    output: &str,
    limit: Duration,
) -> io::Result<Vec<Ended>> {
    let mut upstream = Stdio::from(File::open(folder.join(input))?);
    let mut children: Vec<Child> = Vec::new();
    let log = |i: usize, stage: &Stage| folder.join(format!("{}-{}.log", i + 1, stage[0]));
    for (i, stage) in stages.iter().enumerate() {
        let last = i + 1 == stages.len();
        let mut child = Command::new(binaries.join(&stage[0]))
            .args(&stage[1..])
            .stdin(upstream)
            .stdout(match last {
                true => Stdio::from(File::create(folder.join(output))?),
                false => Stdio::piped(),
            })
            .stderr(File::create(log(i, stage))?)
            .spawn()?;
        upstream = child.stdout.take().map_or_else(Stdio::null, Stdio::from);
        children.push(child);
    }
    drop(upstream);
    let deadline = Instant::now() + limit;
    let mut pause = Duration::from_micros(500);
    let mut ended: Vec<Option<Option<i32>>> = vec![None; children.len()];
    let mut hung = vec![false; children.len()];
    while ended.iter().any(Option::is_none) {
        let late = Instant::now() >= deadline;
        for (i, child) in children.iter_mut().enumerate() {
            if ended[i].is_some() {
                continue;
            }
            if let Some(status) = child.try_wait()? {
                ended[i] = Some(status.code());
            } else if late {
                hung[i] = true;
                child.kill()?;
                ended[i] = Some(child.wait()?.code());
            }
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(5));
    }
    let results = stages.iter().enumerate().map(|(i, stage)| {
        let text = std::fs::read(log(i, stage))?;
        Ok(Ended {
            tool: stage[0].clone(),
            code: ended[i].flatten(),
            hung: hung[i],
            messages: String::from_utf8_lossy(&text).into_owned(),
        })
    });
    results.collect()
}
