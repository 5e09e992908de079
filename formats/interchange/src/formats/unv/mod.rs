//! I-DEAS universal file: points (data set 2411), elements (2412), permanent groups (2467).
//!
//! Format: "Universal File Datasets", SDRC. Every region and every piece of surface is a group of elements of its
//! name, as far as letters, digits, `_` and `-` go; its number is also the property and the material of its elements. There is no data set of units:
//! coordinates are in those of the input.

use crate::sink::ByteSink;
use crate::stream::{MeshStream, Tags, runs};
use crate::text::fitting;
use crate::{WriteError, WriteOptions};
use std::io::{self, Write};

/// Descriptors of elements: a linear tetrahedron, a thin shell of three points.
const TETRA: u32 = 111;
const TRIANGLE: u32 = 91;
/// The colour of everything.
const COLOUR: u32 = 7;
/// Characters of a name that is kept: a group's has 40, of which a number that makes it unique takes some.
const MAX_NAME: usize = 32;
/// What a group is made of: finite elements.
const ELEMENTS: u32 = 8;
/// Lines that begin and end a data set.
const MARK: &str = "    -1\n";

/// Writes the file.
///
/// # Errors
/// Fails when writing fails.
pub fn write(
    mesh: &dyn MeshStream,
    _: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let tags = Tags::new(mesh, &runs(mesh)?);
    let mut sink = ByteSink::new(out);
    write_points(mesh, &mut sink)?;
    write_elements(mesh, &tags, &mut sink)?;
    write_groups(mesh, &tags, &mut sink)?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
    // Points in two lines, elements in two and once more in a group.
    117 * mesh.point_count() + 142 * mesh.tet_count() + 132 * mesh.triangle_count()
}

fn write_points(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    sink.text(&format!("{MARK}  2411\n"))?;
    let mut next = 1_u64;
    mesh.points(&mut |points| {
        for p in points {
            let [x, y, z] = p.to_array().map(double);
            sink.write_fmt(format_args!(
                "{next:>10}{:>10}{:>10}{COLOUR:>10}\n{x:>25}{y:>25}{z:>25}\n",
                1, 1
            ))?;
            next += 1;
        }
        Ok(())
    })?;
    sink.text(MARK)
}

/// A number with 17 significant digits and the exponent of double precision, as Fortran writes it.
fn double(x: f64) -> String {
    let text = format!("{x:.16e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, digits) = match exponent.strip_prefix('-') {
        Some(digits) => ('-', digits),
        None => ('+', exponent),
    };
    format!("{mantissa}D{sign}{digits:0>2}")
}

fn write_elements(mesh: &dyn MeshStream, tags: &Tags, sink: &mut ByteSink<'_>) -> io::Result<()> {
    sink.text(&format!("{MARK}  2412\n"))?;
    let mut next = 1_u64;
    mesh.tets(&mut |part| {
        for (tet, &region) in part.vertices.iter().zip(part.regions) {
            element(sink, next, (TETRA, tags.region(region)), tet)?;
            next += 1;
        }
        Ok(())
    })?;
    for i in 0..mesh.patches().len() {
        mesh.patch(i, false, &mut |part| {
            for triangle in part.vertices {
                element(sink, next, (TRIANGLE, tags.patch(i)), triangle)?;
                next += 1;
            }
            Ok(())
        })?;
    }
    sink.text(MARK)
}

fn element(
    sink: &mut ByteSink<'_>,
    number: u64,
    (descriptor, property): (u32, u32),
    points: &[u32],
) -> io::Result<()> {
    let count = points.len();
    sink.write_fmt(format_args!(
        "{number:>10}{descriptor:>10}{property:>10}{property:>10}{COLOUR:>10}{count:>10}\n"
    ))?;
    for point in points {
        sink.write_fmt(format_args!("{:>10}", u64::from(*point) + 1))?;
    }
    sink.text("\n")
}

/// Groups of elements: regions, then pieces of surface.
fn write_groups(mesh: &dyn MeshStream, tags: &Tags, sink: &mut ByteSink<'_>) -> io::Result<()> {
    sink.text(&format!("{MARK}  2467\n"))?;
    let regions = tags.regions().iter();
    let regions = regions.map(|&(id, _)| Some(mesh.region_name(id)));
    let patches = mesh.patches().iter();
    let patches = patches.map(|patch| mesh.patch_name(patch.label));
    let short = |name: Option<String>| {
        name.map(|mut name| {
            name.truncate(name.floor_char_boundary(MAX_NAME));
            name
        })
    };
    let names = fitting(regions.chain(patches).map(short), &[]);
    let mut names = (1..).zip(&names);
    for &(id, _) in tags.regions() {
        let (mut next, mut numbers) = (1_u64, Vec::new());
        mesh.tet_regions(&mut |part| {
            for &region in part.regions {
                if region == id {
                    numbers.push(next);
                }
                next += 1;
            }
            Ok(())
        })?;
        write_group(sink, names.next(), &numbers)?;
    }
    let mut first = mesh.tet_count() + 1;
    for patch in mesh.patches() {
        let numbers: Vec<u64> = (first..first + patch.triangles).collect();
        first += patch.triangles;
        write_group(sink, names.next(), &numbers)?;
    }
    sink.text(MARK)
}

fn write_group(
    sink: &mut ByteSink<'_>,
    group: Option<(u32, &String)>,
    elements: &[u64],
) -> io::Result<()> {
    let Some((group, name)) = group else {
        return Ok(());
    };
    let zero = 0;
    sink.write_fmt(format_args!("{group:>10}"))?;
    // Sets of constraints, restraints, loads, freedoms, temperatures and contacts.
    (0..6).try_for_each(|_| sink.write_fmt(format_args!("{zero:>10}")))?;
    sink.write_fmt(format_args!("{:>10}\n{name}\n", elements.len()))?;
    for pair in elements.chunks(2) {
        for number in pair {
            sink.write_fmt(format_args!(
                "{ELEMENTS:>10}{number:>10}{zero:>10}{zero:>10}"
            ))?;
        }
        sink.text("\n")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::{Plain, test_document};

    #[test]
    fn numbers_are_those_of_fortran() {
        assert_eq!(double(1.0), "1.0000000000000000D+00");
        assert_eq!(double(-0.1), "-1.0000000000000001D-01");
        assert_eq!(double(1e100), "1.0000000000000000D+100");
    }

    #[test]
    fn a_tetrahedron() {
        let document = test_document();
        let mut bytes = Vec::new();
        let mesh = Plain::new(&document).unwrap();
        write(&mesh, &WriteOptions::default(), &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        for part in [
            "    -1\n  2411\n         1         1         1         7\n   1.0000000000000000D+00   ",
            "  2412\n         1       111         7         7         7         4\n         1         2         3         4\n",
            "  2467\n         1         0         0         0         0         0         0         1\ncopper\n",
            "         8         1         0         0\n",
        ] {
            assert!(text.contains(part), "{text}");
        }
        assert_eq!(text.matches(MARK).count(), 6);
    }
}
