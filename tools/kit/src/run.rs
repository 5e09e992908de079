//! The frame around a tool's run.

use crate::messages::{Level, say, usage_sentence};
use crate::{CommonArgs, Failure, InputFile, MessageFormat, Session, unfinished};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

/// A tool, as its command line.
pub trait Command: clap::Parser {
    /// The options every tool has.
    fn common(&self) -> &CommonArgs;

    /// What is read, in this order; nothing for standard input. With several, or with a name for a region, they are one
    /// body.
    fn inputs(&self) -> Vec<InputFile> {
        let input = self.common().input.iter().cloned();
        input.map(InputFile::unnamed).collect()
    }

    /// Does the work.
    fn run(self, session: &Session) -> Result<(), Failure>;
}

/// Parses the command line, runs the tool, reports a failure as `tool: error: sentence` (or the
/// object asked for with `--message-format json`), and returns the exit code of the contract.
pub fn main<C: Command>() -> ExitCode {
    let arguments: Vec<_> = std::env::args_os().collect();
    let cli = match C::try_parse_from(&arguments) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version go to standard output with exit 0, mistakes to standard error with 2.
            let code = if error.use_stderr() { 2 } else { 0 };
            let form = MessageFormat::sought(&arguments);
            if code == 2 && form == MessageFormat::Json {
                let name = C::command().get_name().to_owned();
                let text = usage_sentence(&error);
                say(&form.line(&name, Level::Error(code), &text));
                return ExitCode::from(code);
            }
            return match error.print() {
                Ok(()) => ExitCode::from(code),
                Err(_) => ExitCode::from(4),
            };
        }
    };
    let name = C::command().get_name().to_owned();
    let session = Session::new(&name, (cli.common().clone(), cli.inputs()), &arguments);
    let form = cli.common().message_format;
    std::panic::set_hook(Box::new({
        let name = name.clone();
        move |panic| {
            let place = panic
                .location()
                .map(|l| format!(" at {}:{}", l.file(), l.line()));
            let text = panic.payload_as_str().unwrap_or("unknown");
            let place = place.unwrap_or_default();
            let text = format!("internal error{place}: {text}; this is a bug, please report it");
            say(&form.line(&name, Level::Error(1), &text));
        }
    }));
    unfinished::remove_on_signals();
    match catch_unwind(AssertUnwindSafe(|| cli.run(&session))) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(failure)) => {
            if !matches!(failure, Failure::ClosedPipe) {
                session.error(failure.code(), &failure.to_string());
            }
            ExitCode::from(failure.code())
        }
        Err(_) => ExitCode::from(1),
    }
}
