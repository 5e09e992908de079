//! Surfaces that may move: what is asked of them, and how far they are from the body's.

use super::subject::Subject;
use bodies::Dice;
use geom::tolerance::{Extent, Tolerance};
use geom::tree::Tree;
use glam::DVec3;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;
use tmesh::{Document, Frame};

/// What is asked of a surface.
pub struct Asked {
    /// How far it may be from the body's, relative to the radius about the axis.
    pub deviation: f64,
    /// The options that say so, with sizes.
    pub options: Vec<String>,
}

impl Asked {
    /// What a seed asks for a body: deviations from what rounding explains to the largest that the tools take, sizes from a
    /// third of the radius to a tenth, where volumes are not asked for (`is_sized`), which exclude lengths.
    pub fn of(subject: &Subject, seed: u64, is_sized: bool) -> Self {
        // Apart from the choices that made the solid and those of the other options.
        let mut dice = Dice::new(seed ^ 0x7375_7266_6163_6573);
        let deviation = format!("{:.2e}", dice.log_between(1e-7, 0.1));
        let mut options = vec!["--deviation".to_owned(), deviation.clone()];
        let mut option = |chance: f64, name: &str, low: f64, high: f64| {
            if dice.chance(chance) {
                let value = format!("{:.3e}", dice.log_between(low, high));
                options.extend([name.to_owned(), value]);
            }
        };
        let radius = subject.radius;
        if !is_sized {
            option(0.5, "--edge-length", radius / 10.0, radius / 3.0);
        }
        option(0.4, "--segments-per-turn", 3.0, 60.0);
        option(0.4, "--gradation", 1.0, 3.0);
        option(0.3, "--feature-angle", 5.0, 90.0);
        Self {
            deviation: deviation.parse().unwrap_or(0.0),
            options,
        }
    }
}

/// How far surfaces are from each other, model units.
pub struct Measured {
    /// The largest distance, measured at corners and middles of triangles.
    pub distance: f64,
    /// The largest distance of a point of the body from the mesh's axis.
    pub radius: f64,
    /// Within this, coordinates of the file that was read count as equal.
    pub equal: f64,
}

/// Compares the surfaces of a body and of an assembled mesh: only from the mesh to the body if that is a union, inside of which
/// parts of its surface are gone.
///
/// # Errors
/// Fails when the mesh cannot be read.
pub fn distance(subject: &Subject, mesh: &Path, is_union: bool) -> io::Result<Measured> {
    let file = BufReader::new(File::open(mesh)?);
    let document = tmesh::read(file).map_err(io::Error::other)?;
    let body = &subject.body;
    let known: Vec<[DVec3; 3]> = (body.faces.iter())
        .map(|f| f.vertices.map(|v| body.vertices[v as usize]))
        .collect();
    let found = faces(&document);
    let symmetry = document.symmetry.as_ref();
    let frame = symmetry.and_then(tmesh::Symmetry::frame);
    let Frame { rotation, origin } = frame.unwrap_or(document.frame);
    let extent = Extent::about(&body.vertices, origin, rotation.z_axis);
    let precision = document.source.as_ref().map_or(0.0, |s| s.precision);
    Ok(Measured {
        distance: match is_union {
            true => one_way(&found, &known),
            false => one_way(&known, &found).max(one_way(&found, &known)),
        },
        radius: extent.radius,
        equal: Tolerance::new(extent, precision, 0.0).equal(),
    })
}

/// How far the mesh in a folder says that faces which are nearly flat were moved, relative to the radius about the axis.
///
/// # Errors
/// Fails when the mesh cannot be read.
pub fn moved(folder: &Path) -> io::Result<f64> {
    let file = BufReader::new(File::open(folder.join("mesh.tmesh"))?);
    let document = tmesh::read(file).map_err(io::Error::other)?;
    Ok(document.wishes.moved.unwrap_or(0.0))
}

/// Triangles of an assembled mesh, where they are in the world.
fn faces(document: &Document) -> Vec<[DVec3; 3]> {
    let faces = document.templates.iter().flat_map(|template| {
        let at = |v: u32| document.frame.to_world(template.vertices[v as usize]);
        let triangles = template.triangles.iter();
        triangles.map(move |t| t.vertices.map(at))
    });
    faces.collect()
}

/// The largest distance of corners and middles of triangles from others.
fn one_way(from: &[[DVec3; 3]], to: &[[DVec3; 3]]) -> f64 {
    let tree = Tree::new(to.iter().copied());
    let points = from
        .iter()
        .flat_map(|&[a, b, c]| [a, b, c, (a + b + c) / 3.0]);
    let distance = |p| tree.nearest(p, f64::INFINITY).map(|n| n.distance);
    let distances = points.map(|p| distance(p).unwrap_or(f64::INFINITY));
    distances.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::Kind;
    use tmesh::{Template, Triangle};

    #[test]
    fn a_surface_that_was_moved_is_as_far_as_it_was_moved() {
        let subject = Subject::of(Kind::Solids, 3);
        let body = &subject.body;
        let moved = DVec3::new(0.0, 0.0, 0.25 * subject.radius);
        let triangle = |f: &bodies::Face| Triangle {
            vertices: f.vertices,
            marker: 0,
            front: 0,
            back: 0,
        };
        let document = |moved: DVec3| {
            Document::single(Template {
                vertices: body.vertices.iter().map(|&p| p + moved).collect(),
                triangles: body.faces.iter().map(triangle).collect(),
                ..Template::default()
            })
        };
        let known = faces(&document(DVec3::ZERO));
        assert_eq!(known.len(), body.faces.len());
        let rounding = 1e-12 * subject.radius;
        assert!(one_way(&known, &known) <= rounding);
        let found = faces(&document(moved));
        let off = one_way(&known, &found).max(one_way(&found, &known));
        assert!(off > 0.0 && off <= moved.length() + rounding, "{off}");
    }
}
