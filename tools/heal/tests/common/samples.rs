//! A small file or two of every foreign format that can be read.

use heal::read;
use interchange::Format;

/// The files, each with its format.
pub fn samples() -> Vec<(Format, Vec<u8>)> {
    let mut samples: Vec<_> = bodies::files::samples()
        .into_iter()
        .map(|(name, bytes)| (Format::from_name(name).expect("it is known"), bytes))
        .collect();
    let obj = samples.iter().find(|(format, _)| *format == Format::Obj);
    let document = read(&obj.expect("a file").1, Format::Obj).unwrap().document;
    for format in [Format::Vtk, Format::Vtu] {
        let mut bytes = Vec::new();
        interchange::write_document(&document, format, &mut bytes).unwrap();
        samples.push((format, bytes));
    }
    samples
}
