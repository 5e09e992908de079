//! The table of a sector's coupled nodes and faces.

use glam::DVec3;
use interchange::{Coupling, MeshStream};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::{self, Write};
use tmesh::Document;

/// How the table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// One object.
    Json,
    /// A line per pair.
    Csv,
}

/// Writes pairs of nodes and faces of all couplings of a sector, with maps, mirror planes and the axis.
///
/// Ids are those of the mesh file, which counts from `first_id`. The residual of a pair is the
/// distance of the low node's image from the high node, model units.
///
/// # Errors
/// Fails when writing fails.
pub fn write_pairs(
    mesh: &dyn MeshStream,
    document: &Document,
    first_id: u64,
    format: TableFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut points: Vec<DVec3> = Vec::new();
    mesh.points(&mut |block| {
        points.extend(block);
        Ok(())
    })?;
    let table = Table {
        mesh,
        points,
        first_id,
    };
    match format {
        TableFormat::Csv => table.write_csv(out)?,
        TableFormat::Json => {
            serde_json::to_writer(&mut *out, &table.json(document))?;
            writeln!(out)?;
        }
    }
    out.flush()
}

/// What a table is made of.
struct Table<'a> {
    mesh: &'a dyn MeshStream,
    points: Vec<DVec3>,
    first_id: u64,
}

impl Table<'_> {
    fn node(&self, v: u32) -> u64 {
        u64::from(v) + self.first_id
    }

    /// Distance of the low node's image from the high node.
    fn residual(&self, coupling: &Coupling, pair: [u32; 2]) -> f64 {
        let [low, high] = pair.map(|v| self.points[v as usize]);
        (coupling.apply(low) - high).length()
    }

    fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "coupling,kind,low,high,residual")?;
        for coupling in self.mesh.couplings() {
            let name = csv(&coupling.name);
            for &pair in &coupling.points {
                let kind = if pair[0] == pair[1] { "axis" } else { "node" };
                let [low, high] = pair.map(|v| self.node(v));
                let residual = self.residual(coupling, pair);
                writeln!(out, "{name},{kind},{low},{high},{residual:?}")?;
            }
            for pair in &coupling.triangles {
                let [low, high] = pair.map(|t| t + self.first_id);
                writeln!(out, "{name},face,{low},{high},")?;
            }
        }
        Ok(())
    }

    fn json(&self, document: &Document) -> Value {
        let couplings = self.mesh.couplings().iter();
        let axis: BTreeSet<u32> = self.mesh.axis_edges().iter().flatten().copied().collect();
        json!({
            "first_id": self.first_id,
            "couplings": couplings.map(|c| self.coupling(c)).collect::<Vec<_>>(),
            "mirrors": mirrors(document),
            "axis": axis.into_iter().map(|v| self.node(v)).collect::<Vec<_>>(),
        })
    }

    fn coupling(&self, coupling: &Coupling) -> Value {
        let wall = |at: u32| self.mesh.wall_names().get(at as usize);
        let rows = coupling.matrix.transpose().to_cols_array_2d();
        let [a, b] = coupling.axis.map(|p| p.to_array());
        let nodes = coupling.points.iter();
        let residuals = nodes.clone().map(|&pair| self.residual(coupling, pair));
        let faces = coupling.triangles.iter();
        json!({
            "name": coupling.name,
            "low": wall(coupling.low),
            "high": wall(coupling.high),
            "sectors": coupling.sectors,
            "rotation": {
                "matrix": rows,
                "translation": coupling.translation.to_array(),
                "axis": [a, b],
                "angle_deg": coupling.sectors.map(|n| 360.0 / f64::from(n)),
            },
            "nodes": nodes.map(|p| p.map(|v| self.node(v))).collect::<Vec<_>>(),
            "residuals": residuals.clone().collect::<Vec<_>>(),
            "max_residual": residuals.fold(0.0, f64::max),
            "faces": faces.map(|p| p.map(|t| t + self.first_id)).collect::<Vec<_>>(),
        })
    }
}

/// The mirror planes of a sector, in the world.
fn mirrors(document: &Document) -> Vec<Value> {
    let frame = document.frame;
    let templates = document.templates.iter().enumerate();
    let gluings = templates.flat_map(|(t, template)| template.gluings.iter().map(move |g| (t, g)));
    let mirrors = gluings.filter_map(|(t, gluing)| {
        let normal = frame.rotation * gluing.mirror_plane(t)?.normal;
        Some(json!({
            "name": gluing.name,
            "point": frame.origin.to_array(),
            "normal": normal.to_array(),
        }))
    });
    mirrors.collect()
}

/// A field of a line.
fn csv(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}
