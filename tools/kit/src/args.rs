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
    #[arg(long, value_name = "FMT", value_parser = input)]
    pub from: Option<Format>,

    /// Format of the output, instead of what the output's extension says; `txt` is a readable
    /// listing of the document
    #[arg(long, value_name = "FMT", value_parser = output)]
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

fn input(name: &str) -> Result<Format, String> {
    let found = Format::from_name(name).filter(|format| format.is_input());
    found.ok_or_else(|| format!("known formats are {}", inputs()))
}

fn output(name: &str) -> Result<Format, String> {
    let found = Format::from_name(name).filter(|format| format.is_output());
    found.ok_or_else(|| format!("known formats are {}", outputs()))
}

/// The formats that are read, as a list in a message.
pub fn inputs() -> String {
    list(Format::is_input)
}

/// The formats that are written, as a list in a message.
pub fn outputs() -> String {
    list(Format::is_output)
}

fn list(which: fn(Format) -> bool) -> String {
    let found = Format::ALL.into_iter().filter(|f| which(*f));
    let names: Vec<_> = found.map(Format::name).collect();
    names.join(", ")
}
