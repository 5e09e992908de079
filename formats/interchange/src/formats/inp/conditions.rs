//! What holds at the mirror planes of a sector, as equations between the displacements of a node.

use super::number::coordinate;
use crate::Parity;
use crate::sink::ByteSink;
use crate::stream::{Label, MeshStream};
use glam::DVec3;
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;
use std::io;
use tmesh::ROUNDING;

/// An equation: the direction it is solved for, and the three coefficients.
type Row = (usize, [f64; 3]);

/// Writes the conditions of all walls that have a parity, for each node but those in `dependent`, whose
/// displacements other equations give.
///
/// A condition on one displacement is a `*BOUNDARY`, one on several is an `*EQUATION`. The conditions of
/// a node on several planes are made independent, so that none is solved for what another one has.
pub fn write(
    mesh: &dyn MeshStream,
    parities: &[Option<Parity>],
    dependent: &FxHashSet<u32>,
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    let mut zero: BTreeMap<u32, Vec<DVec3>> = BTreeMap::new();
    for (i, patch) in mesh.patches().iter().enumerate() {
        let Label::Wall(wall) = patch.label else {
            continue;
        };
        let parity = parities.get(wall as usize).copied().flatten();
        let normal = mesh.wall_normals().get(wall as usize).copied().flatten();
        let (Some(parity), Some(normal)) = (parity, normal) else {
            continue;
        };
        let normal = without_rounding(normal);
        let directions = match parity {
            Parity::Symmetric => vec![normal],
            Parity::Antisymmetric => {
                let (a, b) = normal.any_orthonormal_pair();
                vec![a, b]
            }
        };
        let mut nodes = FxHashSet::default();
        mesh.patch(i, false, &mut |part| {
            nodes.extend(part.vertices.iter().chain(part.middles).flatten());
            Ok(())
        })?;
        for node in nodes.difference(dependent) {
            zero.entry(*node).or_default().extend(&directions);
        }
    }
    let (mut fixed, mut equations) = (Vec::new(), Vec::new());
    for (node, directions) in zero {
        for (pivot, row) in independent(&directions) {
            let terms: Vec<(usize, f64)> = std::iter::once(pivot)
                .chain((0..3).filter(|&k| k != pivot && row[k] != 0.0))
                .map(|k| (k + 1, row[k]))
                .collect();
            match &terms[..] {
                [(direction, _)] => fixed.push((node, *direction)),
                _ => equations.push((node, terms)),
            }
        }
    }
    if !fixed.is_empty() {
        sink.text("*BOUNDARY\n")?;
    }
    for (node, direction) in fixed {
        let node = u64::from(node) + 1;
        sink.write_fmt(format_args!("{node}, {direction}, {direction}\n"))?;
    }
    for (node, terms) in equations {
        let node = u64::from(node) + 1;
        let words: Vec<String> = terms
            .iter()
            .map(|(direction, factor)| format!("{node}, {direction}, {}", coordinate(*factor)))
            .collect();
        sink.write_fmt(format_args!(
            "*EQUATION\n{}\n{}\n",
            words.len(),
            words.join(", ")
        ))?;
    }
    Ok(())
}

fn without_rounding(v: DVec3) -> DVec3 {
    DVec3::from_array(v.to_array().map(exact)).normalize()
}

/// A component of a unit vector, or of what is left of one: zero where it is rounding.
fn exact(x: f64) -> f64 {
    if x.abs() < ROUNDING { 0.0 } else { x }
}

/// Reduced row echelon form with the largest coefficient as pivot: as many rows as directions are
/// independent, each solved for a coordinate that no other row has.
fn independent(directions: &[DVec3]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for direction in directions {
        let mut new = direction.to_array();
        for (pivot, row) in &rows {
            subtract(&mut new, row, *pivot);
        }
        let largest =
            |row: &[f64; 3]| (0..3).fold(0, |a, b| if row[b].abs() > row[a].abs() { b } else { a });
        let pivot = largest(&new);
        // Of a direction that depends on the others rounding is left, of another one at least the sine
        // of the least angle between two mirror planes, 180 degrees over the largest order: 1e-4. The
        // root of the epsilon lies between them.
        if new[pivot].abs() < f64::EPSILON.sqrt() {
            continue;
        }
        let scale = new[pivot];
        new = new.map(|x| exact(x) / scale);
        for (_, row) in &mut rows {
            subtract(row, &new, pivot);
        }
        rows.push((pivot, new));
    }
    rows
}

/// Takes as much of a row away as makes the coordinate of its pivot vanish.
fn subtract(from: &mut [f64; 3], row: &[f64; 3], pivot: usize) {
    let factor = from[pivot];
    for k in 0..3 {
        from[k] = exact(from[k] - factor * row[k]);
    }
    from[pivot] = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_of_several_planes_are_independent() {
        let tilted = DVec3::new(1.0, 2.0, -2.0) / 3.0;
        assert_eq!(independent(&[DVec3::Z]), [(2, [0.0, 0.0, 1.0])]);
        let one = independent(&[tilted, -tilted]);
        assert_eq!(one.len(), 1);
        assert_eq!(one[0].1[one[0].0], 1.0);
        // Two planes leave the direction of their line.
        let two = independent(&[tilted, DVec3::Y]);
        let line = tilted.cross(DVec3::Y);
        assert_eq!(two.len(), 2);
        for (i, (pivot, row)) in two.iter().enumerate() {
            assert_eq!(row[*pivot], 1.0);
            assert_eq!(two[1 - i].1[*pivot], 0.0);
            assert!(DVec3::from_array(*row).dot(line).abs() < 1e-15);
        }
        // Planes at the least angle that there is are two, and planes apart by rounding one.
        let turned = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
        let least = std::f64::consts::PI / 32_768.0;
        assert_eq!(independent(&[DVec3::X, turned(least)]).len(), 2);
        assert_eq!(independent(&[DVec3::X, turned(1e-15)]).len(), 1);
        // Three fix the point.
        let three = independent(&[tilted, DVec3::Y, DVec3::new(0.6, 0.0, 0.8), DVec3::X]);
        assert_eq!(three.len(), 3);
        for (pivot, row) in three {
            assert_eq!(row.iter().filter(|x| **x != 0.0).count(), 1);
            assert_eq!(row[pivot], 1.0);
        }
    }
}
