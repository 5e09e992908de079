//! Bodies as files.

use crate::Body;
use std::io::{self, Write};
use tmesh::{Document, OUTSIDE, Region, Source, Template, Triangle};

/// How a body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Binary STL, single precision; one material only.
    StlBinary,
    /// ASCII STL, one solid per material; the interface of two materials is in both solids.
    StlAscii {
        /// Digits after the point of `d.ddde±x`; all that a double has when `None`.
        digits: Option<usize>,
    },
    /// Wavefront OBJ, one group per material on shared vertices.
    Obj,
    /// TetGen's piecewise linear complex, with a seed per material.
    Poly,
    /// The document of the pipe.
    Tmesh,
}

/// Writes a body.
///
/// # Errors
/// Fails when writing fails, or with `Unsupported` when the encoding cannot hold the body.
pub fn write(body: &Body, encoding: Encoding, out: &mut dyn Write) -> io::Result<()> {
    match encoding {
        Encoding::StlBinary => stl_binary(body, out),
        Encoding::StlAscii { digits } => stl_ascii(body, digits, out),
        Encoding::Obj => obj(body, out),
        Encoding::Poly => poly(body, out),
        Encoding::Tmesh => tmesh::write(&document(body), out),
    }
}

fn stl_binary(body: &Body, out: &mut dyn Write) -> io::Result<()> {
    if body.materials.len() != 1 {
        return Err(io::Error::new(
            io::ErrorKind::Unsupported,
            format!("binary STL holds one solid, not {}", body.materials.len()),
        ));
    }
    let mut header = [b' '; 80];
    header[..4].copy_from_slice(b"body");
    out.write_all(&header)?;
    out.write_all(&(body.faces.len() as u32).to_le_bytes())?;
    for triangle in body.solid(0) {
        let [a, b, c] = triangle.map(|v| body.vertices[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for p in [normal, a, b, c] {
            for x in p.to_array() {
                out.write_all(&(x as f32).to_le_bytes())?;
            }
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

fn stl_ascii(body: &Body, digits: Option<usize>, out: &mut dyn Write) -> io::Result<()> {
    let number = |x: f64| match digits {
        Some(d) => format!("{x:.d$e}"),
        None => format!("{x:e}"),
    };
    for (index, material) in body.materials.iter().enumerate() {
        writeln!(out, "solid {}", material.name)?;
        for triangle in body.solid(index) {
            let [a, b, c] = triangle.map(|v| body.vertices[v as usize]);
            let n = (b - a).cross(c - a).normalize_or_zero();
            writeln!(out, "  facet normal {:.6} {:.6} {:.6}", n.x, n.y, n.z)?;
            writeln!(out, "    outer loop")?;
            for p in [a, b, c] {
                let [x, y, z] = p.to_array().map(number);
                writeln!(out, "      vertex {x} {y} {z}")?;
            }
            writeln!(out, "    endloop\n  endfacet")?;
        }
        writeln!(out, "endsolid {}", material.name)?;
    }
    Ok(())
}

fn obj(body: &Body, out: &mut dyn Write) -> io::Result<()> {
    for p in &body.vertices {
        writeln!(out, "v {:e} {:e} {:e}", p.x, p.y, p.z)?;
    }
    for (index, material) in body.materials.iter().enumerate() {
        writeln!(out, "g {}", material.name)?;
        for triangle in body.solid(index) {
            let [a, b, c] = triangle.map(|v| v + 1);
            writeln!(out, "f {a} {b} {c}")?;
        }
    }
    Ok(())
}

fn poly(body: &Body, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{} 3 0 0", body.vertices.len())?;
    for (i, p) in body.vertices.iter().enumerate() {
        writeln!(out, "{} {:e} {:e} {:e}", i + 1, p.x, p.y, p.z)?;
    }
    writeln!(out, "{} 0", body.faces.len())?;
    for face in &body.faces {
        let [a, b, c] = face.vertices.map(|v| v + 1);
        writeln!(out, "1\n3 {a} {b} {c}")?;
    }
    writeln!(out, "0\n{}", body.materials.len())?;
    for index in 0..body.materials.len() {
        let p = body.seed(index).ok_or_else(|| {
            io::Error::new(io::ErrorKind::InvalidData, "a material encloses no volume")
        })?;
        writeln!(
            out,
            "{} {:e} {:e} {:e} {}",
            index + 1,
            p.x,
            p.y,
            p.z,
            index + 1
        )?;
    }
    Ok(())
}

/// The body as a document of the pipe; region ids are material indices plus one.
fn document(body: &Body) -> Document {
    let region = |material: Option<usize>| material.map_or(OUTSIDE, |m| m as u32 + 1);
    let triangles = body
        .faces
        .iter()
        .map(|face| Triangle {
            vertices: face.vertices,
            marker: 0,
            front: region(face.front),
            back: region(face.back),
        })
        .collect();
    let mut document = Document::single(Template {
        vertices: body.vertices.clone(),
        triangles,
        ..Template::default()
    });
    document.regions = body
        .materials
        .iter()
        .enumerate()
        .map(|(index, material)| Region {
            id: index as u32 + 1,
            name: material.name.clone(),
            size: None,
            volume: Some(body.volume(index)),
        })
        .collect();
    document.source = Some(Source {
        sector_of: None,
        format: "body".to_owned(),
        triangles: body.faces.len() as u64,
        volume: body.total_volume(),
        boundary_area: body.boundary_area(),
        precision: f64::EPSILON
            * body
                .vertices
                .iter()
                .fold(0.0, |m, p| p.abs().max_element().max(m)),
    });
    document
}
