//! What has to hold of every document, sound or not.

use crate::check_round_trip;
use interchange::{Format, WriteOptions};
use meshqual::{Params, analyse};
use rotassemble::{Assembled, TableFormat, sector, write_expanded, write_pairs};
use std::io::sink;
use tmesh::{Document, Template, Violation};

/// Decoder and [`tmesh::validate`] agree on the document; if it is valid, it keeps what a valid one
/// promises, and everything that works on documents works on it. `turn` says which of the outputs is
/// tried.
pub fn check_document(document: &Document, turn: u8) {
    let violations = tmesh::validate(document);
    for violation in &violations {
        assert!(!violation.to_string().is_empty());
    }
    let mut bytes = Vec::new();
    let written = tmesh::write(document, &mut bytes);
    let read = tmesh::read(bytes.as_slice());
    // It may be measured all the same.
    measure(document);
    // Written, a number that is none is like one that is not there.
    let is_number = |v: &Violation| matches!(v, Violation::BadNumber { .. });
    if violations.iter().all(is_number) && !violations.is_empty() {
        return;
    }
    if !violations.is_empty() {
        assert!(read.is_err(), "read though it has {violations:?}");
        return;
    }
    if written.is_err() {
        return;
    }
    assert_eq!(&read.expect("it is valid and was written"), document);
    assert!(keeps_its_promises(document));
    if turn.is_multiple_of(4) {
        assemble(&sector(document.clone()), turn / 4);
    } else {
        assemble(document, turn);
    }
}

/// The invariants that readers of a document rely on, said once more without regard to speed.
fn keeps_its_promises(document: &Document) -> bool {
    let known = |region: u32| document.regions.iter().any(|r| r.id == region);
    let inside = |t: &Template, v: u32| (v as usize) < t.vertices.len();
    let on = |t: &Template, v: u32| (v as usize) < t.triangles.len();
    document.templates.iter().all(|t| {
        let glued = t.gluings.iter().all(|gluing| {
            let other = document.templates.get(gluing.other as usize);
            other.is_some_and(|o| {
                let image = |&[here, there]: &[u32; 2]| {
                    let exact = std::ptr::eq(t, o) && here != there;
                    inside(t, here)
                        && inside(o, there)
                        && (!exact
                            || gluing.step.apply(o.vertices[there as usize])
                                == t.vertices[here as usize])
                };
                gluing.vertex_pairs.iter().all(image)
                    && (gluing.triangle_pairs.iter()).all(|p| on(t, p[0]) && on(o, p[1]))
            })
        });
        glued
            && t.vertices.iter().all(|p| p.is_finite())
            && t.triangles
                .iter()
                .flat_map(|f| f.vertices)
                .all(|v| inside(t, v))
            && t.tets.iter().flat_map(|f| f.vertices).all(|v| inside(t, v))
            && t.tets.iter().all(|e| known(e.region))
            && t.axis
                .iter()
                .all(|&v| inside(t, v) && t.vertices[v as usize].truncate() == glam::DVec2::ZERO)
    }) && document.instances.iter().all(|i| {
        (i.template as usize) < document.templates.len()
            && i.region_map as usize <= document.region_maps.len()
    })
}

/// The mesh that a document stands for: refused, or written in every format.
fn assemble(document: &Document, turn: u8) {
    let Ok(mesh) = Assembled::new(document) else {
        return;
    };
    let mut bytes = Vec::new();
    write_expanded(&mesh, document, &mut bytes).expect("a vector takes all bytes");
    let whole = tmesh::read(bytes.as_slice()).expect("the assembled mesh is a document");
    check_round_trip(&whole);
    measure(&whole);
    // One format at a time, so that there is time for more documents.
    const FORMATS: [Format; 8] = [
        Format::Vtk,
        Format::Vtu,
        Format::Stl,
        Format::Msh,
        Format::Msh2,
        Format::Medit,
        Format::Inp,
        Format::Text,
    ];
    let turn = usize::from(turn);
    let options = WriteOptions {
        boundary: true,
        ascii: (turn / FORMATS.len()).is_multiple_of(2),
        ..WriteOptions::default()
    };
    match FORMATS[turn % FORMATS.len()] {
        Format::Text => {
            interchange::write_text(document, &[], &mut sink()).expect("a sink takes all bytes");
            for format in [TableFormat::Json, TableFormat::Csv] {
                write_pairs(&mesh, document, 1, format, &mut sink())
                    .expect("a sink takes all bytes");
            }
        }
        // Some cannot hold some meshes, which is an error and no panic.
        format => drop(interchange::write(&mesh, format, &options, &mut sink())),
    }
}

/// The report on a document, in all forms.
fn measure(document: &Document) {
    let params = Params {
        bins: 7,
        limits: Vec::new(),
        bounds: Vec::new(),
        worst: 2,
    };
    if let Ok(report) = analyse(document, None, &params) {
        meshqual::text(&report, true);
        meshqual::svg(&report, "fuzz");
    }
}
