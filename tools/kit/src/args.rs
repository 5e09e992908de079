//! Options that every tool has.

use crate::MessageFormat;
use clap::Args;
use interchange::Format;
use std::path::PathBuf;

/// Options that every tool has; flatten it into the tool's own.
#[derive(Args, Clone, Debug)]
pub struct CommonArgs {
    /// File to read; `-` or nothing reads standard input
    #[arg(value_name = "INPUT")]
    pub input: Option<PathBuf>,

    /// File to write, by way of a temporary file beside it [default: standard output]
    #[arg(short, long, value_name = "PATH")]
    pub output: Option<PathBuf>,

    /// Format of the input, instead of what its content shows
    #[arg(long, value_name = "FMT", value_parser = format)]
    pub from: Option<Format>,

    /// Format of the output, instead of what the output's extension says; `txt` is a readable
    /// listing of the document
    #[arg(long, value_name = "FMT", value_parser = format)]
    pub to: Option<Format>,

    /// No messages but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,

    /// Say what is done and how long it takes; twice for details
    #[arg(short, long, action = clap::ArgAction::Count)]
    pub verbose: u8,

    /// Form of the messages on standard error; `json` writes an object per line
    #[arg(
        long,
        value_name = "FORM",
        value_enum,
        default_value_t,
        hide_possible_values = true
    )]
    pub message_format: MessageFormat,
}

fn format(name: &str) -> Result<Format, String> {
    Format::from_name(name).ok_or_else(|| {
        let known: Vec<_> = Format::ALL.iter().map(|f| f.name()).collect();
        format!("known formats are {}", known.join(", "))
    })
}
