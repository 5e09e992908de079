//! Sends random bodies and assemblies through the whole pipe and compares what comes out with what is
//! known of them.
//!
//! ```text
//! cargo run --release -p soak -- run --count 1000
//! cargo run --release -p soak -- spoil --count 1000 part.stl other.stl
//! cargo run --release -p soak -- versus --kind folded --count 1000
//! cargo run --release -p soak -- body --seed 17 -o body.stl
//! ```

mod campaign;
mod versus;
mod workers;

use clap::{Parser, Subcommand};
use soak::{Kind, Subject};
use std::io::{BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Send random bodies and assemblies through the whole pipe.
#[derive(Parser)]
struct Cli {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Run trials of drawn bodies; what fails is kept with its input, command lines and messages
    Run(campaign::Bodies),
    /// Run trials of files of triangles that are spoilt at random, each of which must be meshed well or refused with a reason
    Spoil(campaign::Files),
    /// Compare the meshes of the pipe, with its defaults, with those of `tetgen` on the whole bodies
    Versus(versus::Options),
    /// Write the body of a seed, in the format the seed chooses
    Body {
        /// Seed
        #[arg(long)]
        seed: u64,

        /// Which bodies
        #[arg(long, value_enum, default_value_t = Kind::Solids)]
        kind: Kind,

        /// File to write
        #[arg(short, long)]
        output: PathBuf,
    },
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().what {
        What::Run(options) => campaign::of_bodies(&options),
        What::Spoil(options) => campaign::of_files(&options),
        What::Versus(options) => versus::run(&options),
        What::Body { seed, kind, output } => write_body(seed, kind, &output).map(|()| true),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("soak: error: {error}");
            ExitCode::from(4)
        }
    }
}

fn write_body(seed: u64, kind: Kind, output: &PathBuf) -> std::io::Result<()> {
    let subject = Subject::of(kind, seed);
    let mut out = BufWriter::new(std::fs::File::create(output)?);
    bodies::write(&subject.body, subject.encoding, &mut out)?;
    eprintln!("{}", subject.description);
    out.flush()
}
