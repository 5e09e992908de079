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
use std::fs::File;
use std::io::{self, BufWriter, Write};
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

fn run(cli: &Cli) -> Result<(), (u8, String)> {
    let usage = |text| (2, text);
    let mut body = make::body(cli).map_err(usage)?;
    let placement = Placement {
        rotate: cli.rotate,
        scale: cli.scale,
        jitter: cli.jitter,
    };
    placement.apply(&mut body);
    let encoding = cli.encoding(&body).map_err(usage)?;
    let written = |e: io::Error| match e.kind() {
        io::ErrorKind::Unsupported => (2, e.to_string()),
        _ => (4, format!("cannot write: {e}")),
    };
    let mut out: Box<dyn Write> = match &cli.output {
        Some(path) => Box::new(File::create(path).map_err(written)?),
        None => Box::new(io::stdout()),
    };
    let mut buffer = BufWriter::new(&mut out);
    bodies::write(&body, encoding, &mut buffer).map_err(written)?;
    buffer.flush().map_err(written)?;
    if let Some(path) = &cli.volumes {
        let text = format!("{:#}\n", volumes_json(&body));
        std::fs::write(path, text).map_err(written)?;
    }
    if cli.verbose {
        for (index, material) in body.materials.iter().enumerate() {
            eprintln!("{:e} {}", body.volume(index), material.name);
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err((code, text)) => {
            eprintln!("body: error: {text}");
            ExitCode::from(code)
        }
    }
}
