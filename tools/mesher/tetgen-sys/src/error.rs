//! What can happen to TetGen.

use std::io;
use std::time::Duration;
use thiserror::Error;

/// What TetGen reports by the integer it throws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Failure {
    /// 1: memory ran out.
    OutOfMemory,
    /// 2: a defect of TetGen.
    Internal,
    /// 3: facets of the input intersect.
    SelfIntersection,
    /// 4: a feature of the input is smaller than the tolerance of the coplanarity test.
    SmallFeature,
    /// 5: two facets almost overlap.
    CloseFacets,
    /// 10: the input is wrong.
    BadInput,
    /// Anything else.
    Other(i64),
}

impl Failure {
    pub(crate) fn from_code(code: i64) -> Self {
        match code {
            1 => Self::OutOfMemory,
            2 => Self::Internal,
            3 => Self::SelfIntersection,
            4 => Self::SmallFeature,
            5 => Self::CloseFacets,
            10 => Self::BadInput,
            other => Self::Other(other),
        }
    }

    fn sentence(self) -> String {
        match self {
            Self::OutOfMemory => "ran out of memory".to_owned(),
            Self::Internal => "met a defect of its own".to_owned(),
            Self::SelfIntersection => "found facets that intersect".to_owned(),
            Self::SmallFeature => {
                "found a feature smaller than its coplanarity tolerance".to_owned()
            }
            Self::CloseFacets => "found two facets that almost overlap".to_owned(),
            Self::BadInput => "rejected its input".to_owned(),
            Self::Other(code) => format!("failed with its code {code}"),
        }
    }
}

/// Why there is no mesh.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The input does not fit TetGen's interface.
    #[error("TetGen cannot be given this: {0}")]
    Unfit(String),
    /// TetGen does not understand the switches.
    #[error("TetGen does not understand the switches '{0}'")]
    BadSwitches(String),
    /// The switches ask for elements with more than four vertices.
    #[error(
        "the switches '{0}' ask for quadratic tetrahedra, and only linear ones can be passed on"
    )]
    NotLinear(String),
    /// TetGen gave up by itself.
    #[error("TetGen {}", .0.sentence())]
    Failed(Failure),
    /// TetGen crashed.
    #[error("TetGen crashed ({})", signal_name(*.signal))]
    Crashed {
        /// Number of the signal.
        signal: i32,
    },
    /// TetGen's process was killed from outside; usually the system, for want of memory.
    #[error("TetGen was killed, most likely because memory ran out")]
    Killed,
    /// TetGen's process was asked to end from outside, as by an interrupt from the terminal.
    #[error("TetGen was stopped from outside ({})", signal_name(*.signal))]
    Stopped {
        /// Number of the signal.
        signal: i32,
    },
    /// The memory limit, in bytes, was not enough.
    #[error("TetGen needs more than {} MiB of memory, the limit", .0 >> 20)]
    MemoryLimit(u64),
    /// TetGen ended the process instead of returning.
    #[error("TetGen ended without a result (exit status {status})")]
    Exited {
        /// The exit status.
        status: i32,
    },
    /// The time limit passed.
    #[error("TetGen was stopped after {} s, the time limit", .0.as_secs_f64())]
    TimedOut(Duration),
    /// A step came to no end.
    #[error("TetGen was stopped after {} s of work without a sign that it goes on", .0.as_secs_f64())]
    Silent(Duration),
    /// The operating system refused what running the mesher needs.
    #[error("cannot run TetGen: {what}: {error}")]
    System {
        /// What was refused.
        what: &'static str,
        /// Why.
        error: io::Error,
    },
}

impl Error {
    pub(crate) fn system(what: &'static str) -> Self {
        Self::System {
            what,
            error: io::Error::last_os_error(),
        }
    }
}

fn signal_name(signal: i32) -> String {
    match signal {
        libc::SIGSEGV => "segmentation fault".to_owned(),
        libc::SIGABRT => "it aborted".to_owned(),
        libc::SIGBUS => "bus error".to_owned(),
        libc::SIGFPE => "arithmetic exception".to_owned(),
        libc::SIGILL => "illegal instruction".to_owned(),
        libc::SIGINT => "interrupt".to_owned(),
        libc::SIGTERM => "termination".to_owned(),
        libc::SIGHUP => "hangup".to_owned(),
        other => format!("signal {other}"),
    }
}
