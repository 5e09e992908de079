//! The command line of `tetwedge`.

use kit::{Command, CommonArgs, Failure, Session};

/// Passes a document on
#[derive(clap::Parser, Debug)]
#[command(name = "tetwedge", version)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        let mut document = session.read()?;
        document.history.push(session.history_entry(Vec::new()));
        session.write(&document)
    }
}
