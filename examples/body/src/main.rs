//! Writes test bodies whose symmetry, regions and volumes are known exactly.
//!
//! ```text
//! cargo run -p body -- tsv --order 16 --thickness 5e-3 --rotate 1 -o tsv.stl
//! ```

mod cli;
mod make;

use bodies::{Body, Placement};
use clap::Parser;
use cli::Cli;
use kit::{Closed, Failure, Output};
use std::io::Write;
use std::process::ExitCode;

fn volumes_json(body: &Body) -> serde_json::Value {
    let regions: Vec<_> = body
        .materials
        .iter()
        .enumerate()
        .map(|(i, m)| serde_json::json!({"name": m.name, "volume": body.volume(i)}))
        .collect();
    serde_json::json!({
        "order": body.order,
        "mirror": body.group.has_vertical_mirrors(),
        "group": body.group.symbol(),
        "volume": body.total_volume(),
        "regions": regions,
    })
}

fn run(cli: &Cli) -> Result<(), Failure> {
    let mut body = make::body(cli).map_err(Failure::Usage)?;
    let placement = Placement {
        rotate: cli.rotate,
        scale: cli.scale,
        jitter: cli.jitter,
    };
    placement.apply(&mut body);
    let encoding = cli.encoding(&body).map_err(Failure::Usage)?;
    let mut out = Output::create(cli.output.as_deref(), false)?;
    bodies::write(&body, encoding, &mut out).map_err(|e| out.failure(&e))?;
    let mut done = vec![out.close()?];
    if let Some(path) = &cli.volumes {
        let mut out = Output::create(Some(path), false)?;
        writeln!(out, "{:#}", volumes_json(&body)).map_err(|e| out.failure(&e))?;
        done.push(out.close()?);
    }
    done.into_iter().try_for_each(Closed::publish)?;
    if cli.verbose {
        for (index, material) in body.materials.iter().enumerate() {
            eprintln!("{:e} {}", body.volume(index), material.name);
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    kit::remove_on_signals();
    match run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if !matches!(failure, Failure::ClosedPipe) {
                eprintln!("body: error: {failure}");
            }
            ExitCode::from(failure.code())
        }
    }
}
