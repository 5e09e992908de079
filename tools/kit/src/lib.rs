//! What the mains of the tools share: arguments, reading and writing, messages, exit codes.
//!
//! A tool is a clap structure that implements [`Command`]; its `main` is `kit::main::<Cli>()`.

mod args;
mod failure;
mod input;
mod input_file;
mod inputs;
mod messages;
mod output;
mod run;
mod session;
mod threads;
mod tolerance;
mod unfinished;
mod wishes;

pub use args::CommonArgs;
pub use failure::Failure;
pub use geom::number::{about, grouped, number, point};
pub use input_file::InputFile;
pub use messages::MessageFormat;
pub use output::{Closed, Output};
pub use run::{Command, main};
pub use session::{Progress, Session, Status, duration};
pub use threads::{ThreadArgs, available_threads, both, in_parallel};
pub use tolerance::tolerance;
pub use unfinished::remove_on_signals;
pub use wishes::{Sharp, StrictArgs, WishArgs, sharp_edges, shortfalls};
