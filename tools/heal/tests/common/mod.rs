//! Small bodies, and files of them.

#![allow(dead_code)]

pub mod samples;

use glam::DVec3;
use heal::{Imported, read};
use interchange::Format;
use tmesh::{Document, Marker, Region, Template, Tet, Triangle};

/// Two tetrahedra of different regions, on either side of the triangle 0 1 2, the second one with its apex at `tip`: the
/// triangles as vertices, marker, front and back, then the names of regions and markers.
pub fn two_tets(
    tip: DVec3,
    triangles: [([u32; 3], u32, u32, u32); 7],
    tets: [([u32; 4], u32); 2],
    [regions, markers]: [[(u32, &str); 2]; 2],
) -> Document {
    let mut document = Document::single(Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, tip],
        triangles: triangles
            .map(|(vertices, marker, front, back)| Triangle {
                vertices,
                marker,
                front,
                back,
            })
            .to_vec(),
        tets: tets
            .map(|(vertices, region)| Tet { vertices, region })
            .to_vec(),
        ..Template::default()
    });
    let region = |(id, name): (u32, &str)| Region {
        id,
        name: name.to_owned(),
        size: None,
        volume: None,
    };
    let marker = |(id, name): (u32, &str)| Marker {
        id,
        name: name.to_owned(),
        area: None,
    };
    document.regions = regions.map(region).to_vec();
    document.markers = markers.map(marker).to_vec();
    document
}

/// Reads a file that must be sound, and checks the document's invariants.
pub fn good(bytes: &[u8], format: Format) -> Imported {
    let imported = read(bytes, format).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(tmesh::validate(&imported.document), []);
    imported
}

/// The message of a file that must be refused.
pub fn refused(bytes: &[u8], format: Format) -> String {
    match read(bytes, format) {
        Ok(_) => panic!("was read"),
        Err(e) => e.to_string(),
    }
}

/// Ids, names and volumes of regions; volumes rounded to 1e-9.
pub fn regions(imported: &Imported) -> Vec<(u32, &str, f64)> {
    let regions = &imported.document.regions;
    regions
        .iter()
        .map(|r| (r.id, r.name.as_str(), round(r.volume.unwrap())))
        .collect()
}

/// Ids, names and areas of markers; areas rounded to 1e-9.
pub fn markers(imported: &Imported) -> Vec<(u32, &str, f64)> {
    let markers = &imported.document.markers;
    markers
        .iter()
        .map(|m| (m.id, m.name.as_str(), round(m.area.unwrap())))
        .collect()
}

pub fn round(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
