//! Exact symmetry of a plain mesh: the generators of its group map it onto itself.

use super::elements::{Elements, Mapped};
use super::generators::{frame, generators};
use super::images::Matcher;
use super::part::Part;
use crate::check::findings::{Findings, Kind};
use glam::DVec3;
use tmesh::{Document, Promise};

/// What the check found out.
pub struct Symmetry {
    /// Largest distance between an image and the vertex nearest to it, relative to the size; at least
    /// the reach of the search if a vertex has no image.
    pub residual: f64,
    /// Whether vertices, tetrahedra, regions and triangles are mapped onto such.
    pub connectivity: bool,
}

/// Findings that say that connectivity is not symmetric.
const CONNECTIVITY: [Kind; 5] = [
    Kind::NoImage,
    Kind::NoPermutation,
    Kind::TetImage,
    Kind::RegionImage,
    Kind::TriangleImage,
];

/// Checks a plain mesh against the symmetry it promises.
///
/// Per generator of the group: each vertex's image is matched with the vertex nearest to it, then
/// tetrahedra and triangles are mapped by vertex ids alone. A map of a finite set into itself that maps
/// no two elements onto one is onto, so all images are covered too, and permutations that generators
/// make are made by all their products: the other elements of the group need no check. What is
/// promised outside of a radius is checked in the same way on the elements that reach beyond it. Linear.
pub fn check(
    document: &Document,
    promise: &Promise,
    size: f64,
    findings: &mut Findings,
) -> Symmetry {
    let mut found = Symmetry {
        residual: 0.0,
        connectivity: true,
    };
    let Some(frame) = frame(promise) else {
        findings.add(Kind::BadPromise, || {
            format!(
                "{}, a frame that is not a rotation and a finite shift, or a group outside of a radius \
                 that does not fit",
                promise.group
            )
        });
        found.connectivity = false;
        return found;
    };
    let template = &document.templates[0];
    let same = document.frame == frame;
    let points: Vec<DVec3> = template
        .vertices
        .iter()
        .map(|&p| match same {
            true => p,
            false => frame.to_canonical(document.frame.to_world(p)),
        })
        .collect();
    let mut matcher = Matcher::new(document, &points, size, frame.origin);
    let elements = Elements::new(document);
    let mut outer = None;
    for generator in &generators(promise) {
        let part = match generator.beyond {
            None => &Part::default(),
            Some(radius) => outer.get_or_insert_with(|| {
                Part::beyond(radius + matcher.limit, &template.tets, &points)
            }),
        };
        let (residual, images) = matcher.images(generator, part, findings);
        found.residual = found.residual.max(residual);
        let mapped = Mapped {
            generator,
            part,
            images: &images,
        };
        elements.check(&mapped, findings);
    }
    found.connectivity = !findings.has(&CONNECTIVITY);
    found
}
