//! Running the tools as their users do: real processes, real pipes.

mod fields;

pub use fields::Field;

use bodies::{Body, Encoding};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use tmesh::Document;

/// The six tools in the order of the pipe.
pub const TOOLS: [&str; 6] = [
    "symdetect",
    "wedgecut",
    "periodic-surf",
    "tetwedge",
    "rotassemble",
    "meshqual",
];

/// Folder of the tools: cargo builds the binaries of a package before its tests, and puts the tests into the
/// folder `deps` beside them.
pub fn binaries() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows where it is");
    let profile = test.parent().and_then(Path::parent);
    profile.expect("target/profile/deps").to_owned()
}

/// Path of a tool's binary.
pub fn binary(tool: &str) -> PathBuf {
    assert!(TOOLS.contains(&tool), "no tool is called {tool}");
    binaries().join(tool)
}

/// The generator of bodies, a program of its own.
pub fn generator() -> PathBuf {
    let path = binaries().join("body");
    assert!(
        path.is_file(),
        "{} is missing: `cargo build --workspace --bins --tests` makes it",
        path.display()
    );
    path
}

/// A command that runs make on a flow of `examples/flows` in a folder, as typed by hand, whoever runs the
/// tests.
pub fn make(folder: &Path, flow: &str) -> Command {
    let flows = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/flows");
    let mut command = Command::new("make");
    command
        .current_dir(folder)
        .arg("-f")
        .arg(flows.join(flow))
        .arg(format!("BIN={}/", binaries().display()))
        .arg(format!("BODY={}", generator().display()))
        .env_remove("MAKEFLAGS")
        .env_remove("MAKELEVEL");
    command
}

/// How a process ended.
#[derive(Debug)]
pub struct Outcome {
    /// The tool.
    pub tool: String,
    /// Exit code; -1 when a signal ended it.
    pub code: i32,
    /// What it wrote to standard output.
    pub stdout: Vec<u8>,
    /// What it wrote to standard error.
    pub stderr: String,
}

impl Outcome {
    /// The output of a run that must have succeeded.
    #[track_caller]
    pub fn success(self) -> Vec<u8> {
        assert_eq!(self.code, 0, "{}: {}", self.tool, self.stderr);
        self.stdout
    }

    /// Checks a failure against the command-line contract: the code, one message with the tool's
    /// name that contains all of `parts`, and nothing on standard output.
    #[track_caller]
    pub fn fails(&self, code: i32, parts: &[&str]) {
        let Self {
            tool,
            stdout,
            stderr,
            ..
        } = self;
        assert_eq!(self.code, code, "{tool}: {stderr}");
        assert!(
            stdout.is_empty(),
            "{tool}: {} bytes on stdout",
            stdout.len()
        );
        let message = format!("{tool}: error: ");
        let last = stderr.lines().last().unwrap_or_default();
        // clap's own messages of wrong usage have several lines.
        let begins = last.starts_with(&message) || (code == 2 && stderr.starts_with("error: "));
        assert!(begins, "{tool}: {stderr}");
        assert!(!stderr.contains("internal error"), "{tool}: {stderr}");
        for part in parts {
            assert!(stderr.contains(part), "{tool}: no {part:?} in: {stderr}");
        }
    }
}

/// Runs one tool on the given standard input.
pub fn run(tool: &str, arguments: &[&str], input: &[u8]) -> Outcome {
    let mut command = Command::new(binary(tool));
    command.args(arguments);
    finish(tool, command, input)
}

/// Runs a prepared command that stands for a tool.
pub fn finish(tool: &str, mut command: Command, input: &[u8]) -> Outcome {
    let child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap_or_else(|e| panic!("{tool}: {e}"));
    collect(tool, child, Some(input))
}

fn collect(tool: &str, mut child: Child, input: Option<&[u8]>) -> Outcome {
    let stdin = child.stdin.take();
    let stdout = child.stdout.take();
    let mut stderr = child.stderr.take().expect("standard error is piped");
    thread::scope(|scope| {
        if let (Some(mut stdin), Some(input)) = (stdin, input) {
            // A tool that fails may leave its input unread.
            scope.spawn(move || drop(stdin.write_all(input)));
        }
        let errors = scope.spawn(move || {
            let mut text = String::new();
            stderr.read_to_string(&mut text).expect("messages are text");
            text
        });
        let mut bytes = Vec::new();
        if let Some(mut stdout) = stdout {
            stdout.read_to_end(&mut bytes).expect("a pipe can be read");
        }
        let status = child.wait().expect("a child can be waited for");
        Outcome {
            tool: tool.to_owned(),
            code: status.code().unwrap_or(-1),
            stdout: bytes,
            stderr: errors.join().expect("the reader does not panic"),
        }
    })
}

/// Runs tools connected by pipes, all at once, as a shell does. Returns how each ended; only the last
/// one has its standard output collected.
pub fn pipe(stages: &[&[&str]], input: &[u8]) -> Vec<Outcome> {
    let mut upstream: Option<std::process::ChildStdout> = None;
    let mut children = Vec::new();
    for (i, stage) in stages.iter().enumerate() {
        let mut command = Command::new(binary(stage[0]));
        command.args(&stage[1..]).stderr(Stdio::piped());
        command.stdout(Stdio::piped());
        match upstream.take() {
            Some(out) => command.stdin(out),
            None => command.stdin(Stdio::piped()),
        };
        let mut child = command.spawn().unwrap_or_else(|e| panic!("{stage:?}: {e}"));
        if i + 1 < stages.len() {
            upstream = child.stdout.take();
        }
        children.push((stage[0], child));
    }
    thread::scope(|scope| {
        let collectors: Vec<_> = children
            .into_iter()
            .enumerate()
            .map(|(i, (tool, child))| {
                let input = (i == 0).then_some(input);
                scope.spawn(move || collect(tool, child, input))
            })
            .collect();
        let joined = collectors.into_iter().map(|c| c.join());
        joined.map(|c| c.expect("no panic")).collect()
    })
}

/// A body in a file format.
pub fn encode(body: &Body, encoding: Encoding) -> Vec<u8> {
    let mut bytes = Vec::new();
    bodies::write(body, encoding, &mut bytes).expect("the encoding can hold the body");
    bytes
}

/// A document as a file.
pub fn bytes(document: &Document) -> Vec<u8> {
    let mut bytes = Vec::new();
    tmesh::write(document, &mut bytes).expect("a vector takes all bytes");
    bytes
}

/// The document of a file, which has to be sound.
#[track_caller]
pub fn read(bytes: &[u8]) -> Document {
    let document = tmesh::read(bytes).expect("the output can be read");
    assert_eq!(tmesh::validate(&document), []);
    document
}

/// ASCII STL with all digits.
pub const EXACT_STL: Encoding = Encoding::StlAscii { digits: None };

/// Sends a signal, such as `-TERM`, to a process, or to a group of which the id is given with a minus; whether there
/// was one. The shell has this command in itself, a small system not beside it.
pub fn send(signal: &str, target: &str) -> bool {
    let mut command = Command::new("bash");
    command.args(["-c", "kill \"$0\" -- \"$1\"", signal, target]);
    let status = command.stderr(Stdio::null()).status();
    status.expect("bash runs").success()
}
