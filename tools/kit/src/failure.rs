//! How a tool fails: an exit code and one sentence.

use std::io;
use thiserror::Error;

/// Why a tool stops, with the exit code of the command-line contract.
#[derive(Debug, Error)]
pub enum Failure {
    /// Exit 1: the input is sound, but this cannot be done.
    #[error("{0}")]
    Impossible(String),
    /// Exit 2: wrong usage.
    #[error("{0}")]
    Usage(String),
    /// Exit 3: the input is malformed, truncated, empty or not a closed surface.
    #[error("{0}")]
    Input(String),
    /// Exit 4: the output could not be written.
    #[error("{0}")]
    Output(String),
    /// Exit 4, silent: whoever read our output has gone.
    #[error("the reader of the output has gone")]
    ClosedPipe,
}

impl Failure {
    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Self::Impossible(_) => 1,
            Self::Usage(_) => 2,
            Self::Input(_) => 3,
            Self::Output(_) | Self::ClosedPipe => 4,
        }
    }

    /// A failure to write to `target`.
    pub fn writing(target: &str, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ClosedPipe,
            io::ErrorKind::Unsupported => Self::Usage(error.to_string()),
            _ => Self::Output(format!("cannot write {target}: {error}")),
        }
    }
}
