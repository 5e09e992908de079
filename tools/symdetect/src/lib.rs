//! Passes a document on.

mod cli;

pub use cli::Cli;
