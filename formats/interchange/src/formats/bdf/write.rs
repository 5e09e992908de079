//! Writer: grid points in large fields, elements in small ones.
//!
//! Regions are solid properties and pieces of surface are shell properties; both count in one row of
//! numbers. Comments before the bulk data give their names. Properties refer to a material of their own
//! number, and shells to none: materials and loads are the deck's that includes the file.

use super::number::real;
use crate::sink::ByteSink;
use crate::stream::{MeshStream, Tags, runs};
use crate::text::one_line;
use crate::{WriteError, WriteOptions};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// Numbers of points, elements and properties have eight digits at most: small fields are that wide.
const LIMIT: u64 = 99_999_999;
/// Data fields of a line of small fields.
const FIELDS: usize = 8;

/// Writes the file.
///
/// # Errors
/// Fails when writing fails, and for more points or elements than the fields can number.
pub fn write(
    mesh: &dyn MeshStream,
    _: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let elements = mesh.tet_count() + mesh.triangle_count();
    for (what, count) in [("points", mesh.point_count()), ("elements", elements)] {
        if count > LIMIT {
            return Err(WriteError::TooLarge {
                format: "bdf",
                what,
                count,
                limit: LIMIT,
            });
        }
    }
    let properties = Properties::of(mesh)?;
    let mut sink = ByteSink::new(out);
    sink.text(&format!("$ {}\n", one_line(&mesh.title())))?;
    properties.write_names(mesh, &mut sink)?;
    sink.text("BEGIN BULK\n")?;
    properties.write_cards(&mut sink)?;
    write_points(mesh, &mut sink)?;
    write_elements(mesh, &properties, &mut sink)?;
    sink.text("ENDDATA\n")?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
    let (tet, triangle) = if mesh.is_second_order() {
        (110, 74)
    } else {
        (57, 49)
    };
    99 * mesh.point_count() + tet * mesh.tet_count() + triangle * mesh.triangle_count()
}

/// Numbers of properties.
struct Properties {
    /// Region ids that occur, increasing, with their numbers.
    solids: Vec<(u32, u32)>,
    /// Number of each patch.
    shells: Vec<u32>,
}

impl Properties {
    /// Regions and patches keep the numbers that they have in other formats, but for those that are too
    /// large and patches that have the number of a region: these get the next ones.
    fn of(mesh: &dyn MeshStream) -> io::Result<Self> {
        let tags = Tags::new(mesh, &runs(mesh)?);
        let patches = (0..mesh.patches().len()).map(|i| tags.patch(i));
        let all = tags.regions().iter().map(|r| r.1).chain(patches.clone());
        let is_small = |number: &u32| u64::from(*number) <= LIMIT / 2;
        let mut last = all.filter(is_small).max().unwrap_or(0);
        let mut taken = BTreeSet::new();
        let mut number = |tag: u32| {
            if is_small(&tag) && taken.insert(tag) {
                return tag;
            }
            last += 1;
            last
        };
        let regions = tags.regions().iter();
        Ok(Self {
            solids: regions.map(|&(id, tag)| (id, number(tag))).collect(),
            shells: patches.map(number).collect(),
        })
    }

    /// The number of a region that occurs.
    fn solid(&self, region: u32) -> u32 {
        let found = self.solids.binary_search_by_key(&region, |s| s.0);
        found.map_or(1, |i| self.solids[i].1)
    }

    fn write_names(&self, mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
        for &(id, number) in &self.solids {
            let name = one_line(&mesh.region_name(id));
            sink.text(&format!("$ PSOLID {number} {name}\n"))?;
        }
        for (patch, number) in mesh.patches().iter().zip(&self.shells) {
            if let Some(name) = mesh.patch_name(patch.label) {
                sink.text(&format!("$ PSHELL {number} {}\n", one_line(&name)))?;
            }
        }
        Ok(())
    }

    fn write_cards(&self, sink: &mut ByteSink<'_>) -> io::Result<()> {
        for &(_, number) in &self.solids {
            sink.text(&format!("PSOLID  {number:>8}{number:>8}\n"))?;
        }
        for number in &self.shells {
            sink.text(&format!("PSHELL  {number:>8}\n"))?;
        }
        Ok(())
    }
}

fn write_points(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    let mut next = 1_u64;
    mesh.points(&mut |points| {
        for p in points {
            let [x, y, z] = p.to_array().map(real);
            sink.write_fmt(format_args!(
                "GRID*   {next:>16}{:>16}{x:>16}{y:>16}\n*       {z:>16}\n",
                ""
            ))?;
            next += 1;
        }
        Ok(())
    })
}

fn write_elements(
    mesh: &dyn MeshStream,
    properties: &Properties,
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    let mut next = 1_u64;
    mesh.tets(&mut |part| {
        for (k, tet) in part.vertices.iter().enumerate() {
            let property = properties.solid(part.regions[k]);
            let middles = part.middles.get(k).map_or(&[][..], |m| &m[..]);
            let points = tet.iter().chain(middles);
            element(sink, "CTETRA", [next, property.into()], points)?;
            next += 1;
        }
        Ok(())
    })?;
    let name = if mesh.is_second_order() {
        "CTRIA6"
    } else {
        "CTRIA3"
    };
    for (i, property) in properties.shells.iter().enumerate() {
        mesh.patch(i, false, &mut |part| {
            for (k, triangle) in part.vertices.iter().enumerate() {
                let middles = part.middles.get(k).map_or(&[][..], |m| &m[..]);
                let points = triangle.iter().chain(middles);
                element(sink, name, [next, u64::from(*property)], points)?;
                next += 1;
            }
            Ok(())
        })?;
    }
    Ok(())
}

/// A card with the numbers of an element and its property, and those of its points.
fn element<'a>(
    sink: &mut ByteSink<'_>,
    name: &str,
    head: [u64; 2],
    points: impl Iterator<Item = &'a u32>,
) -> io::Result<()> {
    sink.write_fmt(format_args!("{name:<8}"))?;
    let points = points.map(|v| u64::from(*v) + 1);
    for (i, number) in head.into_iter().chain(points).enumerate() {
        if i > 0 && i % FIELDS == 0 {
            sink.text("\n+       ")?;
        }
        sink.write_fmt(format_args!("{number:>8}"))?;
    }
    sink.text("\n")
}
