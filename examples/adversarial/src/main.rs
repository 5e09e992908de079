//! Writes bodies that are sound, and of the kinds that make meshing programs slow:
//!
//! ```text
//! cargo run --release -p adversarial -- coplanar 1000000 > coplanar.off
//! ```
//!
//! `measure.py` beside this file runs the tools on them at growing sizes.

use bodies::adversarial as shapes;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let found = match arguments.as_slice() {
        [name, n] => shapes::SHAPES
            .iter()
            .find(|s| s.0 == name)
            .zip(n.parse().ok()),
        _ => None,
    };
    let Some((&(_, _, make), n)) = found else {
        eprintln!("usage: adversarial SHAPE N; shapes:");
        for (name, what, _) in shapes::SHAPES {
            eprintln!("  {name:<10} {what}");
        }
        return ExitCode::from(2);
    };
    match std::io::stdout().write_all(shapes::off(&make(n)).as_bytes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("adversarial: {error}");
            ExitCode::from(4)
        }
    }
}
