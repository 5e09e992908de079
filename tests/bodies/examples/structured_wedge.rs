//! Writes a structured wedge with all its instances, to measure `rotassemble` with:
//! `structured_wedge ORDER mirror|rotation BORE RADIAL ANGULAR HEIGHT > wedge.tmesh`

use bodies::structured::Structured;
use std::io::{BufWriter, stdout};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [order, domain, bore, radial, angular, height] = &arguments[..] else {
        return Err(
            "usage: structured_wedge ORDER mirror|rotation BORE RADIAL ANGULAR HEIGHT".into(),
        );
    };
    let wedge = Structured {
        order: order.parse()?,
        mirror: domain == "mirror",
        flip: false,
        bore: bore.parse()?,
        radius: 2.0,
        cells: [radial.parse()?, angular.parse()?, height.parse()?],
    };
    let document = wedge.document();
    eprintln!(
        "{} instances of {} tetrahedra",
        wedge.copies(),
        document.templates[0].tets.len()
    );
    Ok(tmesh::write(
        &document,
        BufWriter::with_capacity(1 << 20, stdout().lock()),
    )?)
}
