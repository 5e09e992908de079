//! Writes the corpus that the targets start from into the folder given, a subfolder per target: small
//! bodies in every format, made by this project's own writers where there are such.

use heal::read;
use interchange::{Format, Surface, WriteOptions, second_order};
use rotassemble::{Assembled, write_expanded};
use std::collections::BTreeMap;
use std::path::Path;
use tmesh::Document;

const GOLDEN: [&[u8]; 3] = [
    include_bytes!("../../formats/tmesh/tests/golden/column.tmesh"),
    include_bytes!("../../formats/tmesh/tests/golden/pyramid.tmesh"),
    include_bytes!("../../formats/tmesh/tests/golden/sized.tmesh"),
];

/// Files by target.
type Seeds = BTreeMap<String, Vec<Vec<u8>>>;

fn main() {
    let folder = std::env::args_os().nth(1).expect("usage: seeds FOLDER");
    let mut seeds = Seeds::new();
    let mut documents: Vec<Document> = Vec::new();
    for (name, bytes) in bodies::files::samples() {
        let format = Format::from_name(name).expect("it is known");
        // One of them is not sound: that too is a start.
        documents.extend(read(&bytes, format).map(|imported| imported.document));
        add(&mut seeds, format, bytes);
    }
    documents.extend(GOLDEN.map(|bytes| tmesh::read(bytes).expect("it is sound")));
    for document in &documents {
        let mut bytes = Vec::new();
        tmesh::write(document, &mut bytes).expect("a vector takes all bytes");
        add(&mut seeds, Format::Tmesh, bytes);
        assembled(document, &mut seeds);
    }
    // What a document is altered by: nothing, and one alteration of each kind.
    let plans = (0..128).map(|i| vec![i % 8, i, 0, 1, i, i / 4, 0, 3, i % 7, 1]);
    seeds.insert("document".to_owned(), plans.collect());
    for (target, files) in seeds {
        let folder = Path::new(&folder).join(target);
        std::fs::create_dir_all(&folder).expect("a folder to write to");
        for (i, bytes) in files.iter().enumerate() {
            std::fs::write(folder.join(format!("seed-{i:03}")), bytes).expect("room on the disk");
        }
    }
}

fn add(seeds: &mut Seeds, format: Format, bytes: Vec<u8>) {
    let target = match format {
        Format::Msh2 => Format::Msh.name(),
        other => other.name(),
    };
    seeds
        .entry("sniff".to_owned())
        .or_default()
        .push(bytes.clone());
    seeds.entry(target.to_owned()).or_default().push(bytes);
}

/// The mesh that a document stands for, in all forms of all formats that can be written and read.
fn assembled(document: &Document, seeds: &mut Seeds) {
    let mesh = Assembled::new(document).expect("it is sound");
    let mut bytes = Vec::new();
    write_expanded(&mesh, document, &mut bytes).expect("a vector takes all bytes");
    add(seeds, Format::Tmesh, bytes);
    for format in [
        Format::Stl,
        Format::Vtk,
        Format::Vtu,
        Format::Msh,
        Format::Msh2,
    ] {
        for bits in 0..8 {
            let options = WriteOptions {
                boundary: bits & 1 != 0,
                ascii: bits & 2 != 0,
                compress: bits & 4 != 0,
                surface: Surface::default(),
                ..WriteOptions::default()
            };
            let mut bytes = Vec::new();
            // Without a surface there is nothing to write as STL.
            if interchange::write(&mesh, format, &options, &mut bytes).is_err() {
                continue;
            }
            let known = seeds.get(format.name());
            if !known.is_some_and(|files| files.contains(&bytes)) {
                add(seeds, format, bytes);
            }
        }
    }
    let (second, middles) = second_order(document.clone()).expect("few points");
    let mesh = Assembled::of_order(&second, Some(&middles)).expect("it is sound");
    for format in [Format::Vtk, Format::Vtu, Format::Msh, Format::Msh2] {
        let mut bytes = Vec::new();
        interchange::write(&mesh, format, &WriteOptions::default(), &mut bytes)
            .expect("a vector takes all");
        add(seeds, format, bytes);
    }
}
