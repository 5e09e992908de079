//! One run of a tool: its name, its options, and the way it talks to the user.

use crate::messages::{self, Level};
use crate::{CommonArgs, InputFile, MessageFormat};
use heal::{Joined, OddEdges, Repair, Undrawn};
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::ffi::OsString;
use std::io::IsTerminal;
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use tmesh::{ChunkInfo, HistoryEntry};

/// One run of a tool.
pub struct Session {
    name: String,
    arguments: Vec<String>,
    pub(crate) common: CommonArgs,
    pub(crate) inputs: Vec<InputFile>,
    begun: Instant,
    /// Chunks of the input, when it was a document.
    pub(crate) read: OnceLock<Vec<ChunkInfo>>,
    /// What was said of the input when it was read.
    pub(crate) notices: OnceLock<Vec<String>>,
    /// What was repaired of the input.
    pub(crate) repairs: OnceLock<Vec<Repair>>,
    /// What was done to make one body of the input's solids.
    pub(crate) joined: OnceLock<Joined>,
    pub(crate) undrawn: OnceLock<Undrawn>,
    pub(crate) is_apart: OnceLock<bool>,
    /// Why the input could not be read, when its surface is not closed.
    pub(crate) odd_edges: OnceLock<OddEdges>,
}

impl Session {
    pub(crate) fn new(
        name: &str,
        (common, inputs): (CommonArgs, Vec<InputFile>),
        arguments: &[OsString],
    ) -> Self {
        let arguments = arguments
            .iter()
            .skip(1)
            .map(|a| a.to_string_lossy().into_owned())
            .collect();
        Self {
            name: name.to_owned(),
            arguments,
            common,
            inputs,
            begun: Instant::now(),
            read: OnceLock::new(),
            notices: OnceLock::new(),
            repairs: OnceLock::new(),
            joined: OnceLock::new(),
            undrawn: OnceLock::new(),
            is_apart: OnceLock::new(),
            odd_edges: OnceLock::new(),
        }
    }

    /// The chunks that the input was made of; none when it was in a foreign format.
    pub fn chunks(&self) -> &[ChunkInfo] {
        self.read.get().map_or(&[], Vec::as_slice)
    }

    /// What the user was told about the input when it was read, a sentence each.
    pub fn notices(&self) -> &[String] {
        self.notices.get().map_or(&[], Vec::as_slice)
    }

    /// What was repaired of the input when it was read.
    pub fn repairs(&self) -> &[Repair] {
        self.repairs.get().map_or(&[], Vec::as_slice)
    }

    /// What was done to make one body of the input's solids, where they touch or overlap.
    pub fn joined(&self) -> Option<&Joined> {
        self.joined.get()
    }

    /// The input's solids, where curved faces of them touch whose facets could be drawn once instead.
    pub fn undrawn(&self) -> Option<&Undrawn> {
        self.undrawn.get()
    }

    /// Whether it is known of the input that no two of its triangles meet away from common corners and edges.
    pub fn is_apart(&self) -> bool {
        self.is_apart.get().copied().unwrap_or(false)
    }

    /// The edges that kept the input from being read, when its surface is not closed.
    pub fn odd_edges(&self) -> Option<&OddEdges> {
        self.odd_edges.get()
    }

    /// What is read, in this order; nothing for standard input.
    pub fn inputs(&self) -> &[InputFile] {
        &self.inputs
    }

    /// The tool's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The options every tool has.
    pub fn common(&self) -> &CommonArgs {
        &self.common
    }

    /// Says something the user should know; silent with `-q`.
    pub fn note(&self, text: &str) {
        if !self.common.quiet {
            self.say(Level::Note, text);
        }
    }

    /// Says what is being done, with the time since the start; only with `-v`.
    pub fn info(&self, text: &str) {
        if self.common.verbose > 0 {
            let seconds = self.begun.elapsed().as_secs_f64();
            self.say(Level::Info(seconds), text);
        }
    }

    /// Details; only with `-vv`.
    pub fn detail(&self, text: &str) {
        if self.common.verbose > 1 {
            self.say(Level::Detail, text);
        }
    }

    /// Whether `-v` was given.
    pub fn is_verbose(&self) -> bool {
        self.common.verbose > 0
    }

    pub(crate) fn error(&self, code: u8, text: &str) {
        self.say(Level::Error(code), text);
    }

    fn say(&self, level: Level, text: &str) {
        let line = self.common.message_format.line(&self.name, level, text);
        messages::say(&line);
    }

    /// Whether progress is shown: to people at a terminal, unless they want to hear of errors only.
    pub fn is_watched(&self) -> bool {
        let for_people = self.common.message_format == MessageFormat::Text;
        !self.common.quiet && for_people && std::io::stderr().is_terminal()
    }

    /// A progress bar for work of `length` steps, drawn when one is done; shown on a terminal only.
    pub fn progress(&self, length: u64, text: &str) -> Progress {
        if !self.is_watched() {
            return Progress(ProgressBar::hidden());
        }
        let bar = ProgressBar::new(length).with_message(format!("{}: {text}", self.name));
        bar.set_style(
            ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}% {eta}")
                .unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        Progress(bar)
    }

    /// A line that says how far the work is and is rewritten; shown on a terminal only, and not among the lines of `-v`,
    /// which say as much.
    pub fn status(&self) -> Status {
        if !self.is_watched() || self.is_verbose() {
            return Status(ProgressBar::hidden());
        }
        let line = ProgressBar::new_spinner().with_prefix(self.name.clone());
        line.set_style(
            ProgressStyle::with_template("{prefix}: {wide_msg}")
                .unwrap_or_else(|_| ProgressStyle::default_spinner()),
        );
        Status(line)
    }

    /// The entry this run adds to a document's history.
    pub fn history_entry(&self, notes: Vec<String>) -> HistoryEntry {
        HistoryEntry {
            tool: self.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            arguments: self.arguments.clone(),
            notes,
        }
    }
}

/// A duration in words, of whole units: `9 seconds`, `2 minutes`; a second at least.
pub fn duration(duration: Duration) -> String {
    HumanDuration(duration.max(Duration::from_secs(1))).to_string()
}

/// A progress bar that goes away when dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// Work done so far.
    pub fn set(&self, position: u64) {
        self.0.set_position(position);
    }
}

/// A line of progress that goes away when dropped.
pub struct Status(ProgressBar);

impl Status {
    /// Whether anybody sees it.
    pub fn is_shown(&self) -> bool {
        !self.0.is_hidden()
    }

    /// Does something that says lines of its own, between which it does not get.
    pub fn aside(&self, say: impl FnOnce()) {
        self.0.suspend(say);
    }

    /// Puts a text in place of the one before.
    pub fn show(&self, text: String) {
        self.0.set_message(text);
    }
}

impl Drop for Status {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
