//! What the files of the folder have in common.

use crate::sink::ByteSink;
use std::io;

/// Writes what every file begins with.
pub fn head(
    sink: &mut ByteSink<'_>,
    class: &str,
    note: Option<&str>,
    object: &str,
) -> io::Result<()> {
    let note = note.map_or(String::new(), |n| format!("    note        \"{n}\";\n"));
    sink.text(&format!(
        "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {class};\n\
         {note}    location    \"constant/polyMesh\";\n    object      {object};\n}}\n\n"
    ))
}

/// Writes labels as a list.
pub fn write_labels(
    sink: &mut ByteSink<'_>,
    labels: impl ExactSizeIterator<Item = u32>,
) -> io::Result<()> {
    sink.text(&format!("{}\n(\n", labels.len()))?;
    for label in labels {
        sink.write_fmt(format_args!("{label}\n"))?;
    }
    sink.text(")")
}
