//! Where faults are injected: an input and the right answer of each stage, folders, and the count of
//! what went wrong.

use bodies::{Gear, Random};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use support::{EXACT_STL, TOOLS, binary, encode, run};
use tempfile::TempDir;

/// A stage of the pipe, what it works on, and what it makes of it.
pub struct Stage {
    pub tool: &'static str,
    pub arguments: &'static [&'static str],
    pub input: Vec<u8>,
    pub output: Vec<u8>,
    /// Time it takes, process and all.
    pub time: Duration,
}

/// All six, on a gear that keeps each busy for some milliseconds.
pub fn stages() -> &'static [Stage] {
    static STAGES: OnceLock<Vec<Stage>> = OnceLock::new();
    STAGES.get_or_init(|| {
        let gear = Gear {
            order: 12,
            bore: 0.3,
            ..Gear::default()
        };
        let mut input = encode(&gear.build(), EXACT_STL);
        let mut stages = Vec::new();
        for tool in TOOLS {
            let arguments: &[&str] = match tool {
                "wedgecut" => &["--domain", "rotation"],
                "rotassemble" => &["--to", "tmesh"],
                _ => &[],
            };
            let begun = Instant::now();
            let output = run(tool, arguments, &input).success();
            let time = begun.elapsed();
            let given = match tool {
                "meshqual" => input.clone(),
                _ => std::mem::replace(&mut input, output.clone()),
            };
            stages.push(Stage {
                tool,
                arguments,
                input: given,
                output,
                time,
            });
        }
        stages
    })
}

/// A folder for one run: the input of a stage in it, and the name of its output.
pub struct Place {
    folder: TempDir,
    pub input: PathBuf,
    pub output: PathBuf,
}

impl Place {
    pub fn new(stage: &Stage) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let input = folder.path().join("input");
        fs::write(&input, &stage.input).expect("a file");
        let output = folder.path().join("output.tmesh");
        Self {
            folder,
            input,
            output,
        }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The stage's arguments, with input and output as files.
    pub fn arguments(&self, stage: &Stage) -> Vec<String> {
        let text = |p: &Path| p.to_str().expect("a plain path").to_owned();
        let mut all: Vec<String> = stage.arguments.iter().map(|a| (*a).to_owned()).collect();
        all.extend([text(&self.input), "-o".to_owned(), text(&self.output)]);
        all
    }

    /// Starts a stage on the input, silently.
    pub fn start(&self, stage: &Stage) -> Child {
        Command::new(binary(stage.tool))
            .args(self.arguments(stage))
            .stderr(Stdio::null())
            .spawn()
            .expect("the tool starts")
    }

    /// Checks that the output is not there, or (with `whole`) may be there if nothing of it is
    /// missing, and that nothing else was left behind.
    pub fn check(&self, stage: &Stage, whole: bool, leftovers: bool) -> Result<(), String> {
        let mut names: Vec<String> = fs::read_dir(self.path())
            .map_err(|e| e.to_string())?
            .filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned()))
            .filter(|name| name != "input" && !(leftovers && name.ends_with(".part")))
            .collect();
        names.sort();
        match &names[..] {
            [] => Ok(()),
            [name] if whole && name == "output.tmesh" => {
                let found = fs::read(&self.output).map_err(|e| e.to_string())?;
                match same(stage, &found) {
                    true => Ok(()),
                    false => Err(format!("an output of {} bytes that is not it", found.len())),
                }
            }
            _ => Err(format!("left behind: {names:?}")),
        }
    }
}

/// Whether an output is what the stage makes; documents and reports say where they come from, so
/// it is the length that counts where paths are named.
fn same(stage: &Stage, found: &[u8]) -> bool {
    match stage.tool {
        "meshqual" => found.ends_with(&stage.output[stage.output.len() / 2..]),
        _ => {
            let (a, b) = (tmesh::read(found), tmesh::read(stage.output.as_slice()));
            let (Ok(a), Ok(b)) = (a, b) else { return false };
            a.templates == b.templates && a.instances == b.instances
        }
    }
}

/// Counts runs and violations of one kind of fault in one stage.
pub struct Tally {
    kind: &'static str,
    stage: &'static str,
    runs: u32,
    violations: Vec<String>,
}

impl Tally {
    pub fn new(kind: &'static str, stage: &'static str) -> Self {
        Self {
            kind,
            stage,
            runs: 0,
            violations: Vec::new(),
        }
    }

    pub fn add(&mut self, result: Result<(), String>) {
        self.runs += 1;
        self.violations.extend(result.err());
    }

    /// Prints the line of the table, and fails if anything was violated.
    pub fn close(self) {
        let violated = self.violations.len();
        println!(
            "fault | {} | {} | {} | {violated}",
            self.kind, self.stage, self.runs
        );
        assert!(
            self.violations.is_empty(),
            "{} in {}: {:#?}",
            self.kind,
            self.stage,
            self.violations
        );
    }
}

/// How often a fault is injected that is injected `few` times in a quick run.
pub fn times(few: u32) -> u32 {
    let factor = std::env::var("FAULTS").ok().and_then(|f| f.parse().ok());
    few * factor.unwrap_or(1)
}

/// Random shares of a whole, in [0, 1).
pub fn shares(seed: u64) -> impl FnMut() -> f64 {
    let mut random = Random::new(seed);
    move || 0.5 * (random.signed() + 1.0)
}

/// Checks a process's end: the code, one sentence of the tool's with the given part.
pub fn refused(
    tool: &str,
    code: Option<i32>,
    wanted: i32,
    stderr: &str,
    part: &str,
) -> Result<(), String> {
    let sentences: Vec<&str> = stderr
        .lines()
        .filter(|l| l.starts_with(&format!("{tool}: error: ")))
        .collect();
    match (code, &sentences[..]) {
        (Some(c), [one])
            if c == wanted && one.contains(part) && !stderr.contains("internal error") =>
        {
            Ok(())
        }
        _ => Err(format!("exit {code:?}, not {wanted}: {stderr:?}")),
    }
}
