//! What can happen to a mesher.

use std::fmt;

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// What can be done about it.
    pub kind: FailureKind,
    /// What happened, without a full stop.
    pub what: String,
    /// The mesher's step in which it happened; may be empty.
    pub step: String,
}

/// What can be done about a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FailureKind {
    /// A crash or a defect: another description of the same surface may go through.
    Chance,
    /// Nothing that another attempt would change.
    Final,
    /// The time limit passed.
    TimedOut,
    /// The memory limit was not enough.
    MemoryLimit,
    /// The machine's memory was not enough.
    NoMemory,
    /// The process was killed, most likely for want of memory.
    Killed,
    /// The mesher's own switches are wrong.
    Switches,
    /// The system or another process is to blame.
    Outside,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)?;
        if self.step.is_empty() {
            return Ok(());
        }
        write!(f, " in its step '{}'", self.step)
    }
}
