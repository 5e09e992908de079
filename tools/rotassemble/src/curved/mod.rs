//! Elements of second order that follow the shape behind the facets of their body.
//!
//! Corners of facets are on the shape. What the mesher put on facets is moved there, and so are the points on edges between
//! such vertices ([`Nodes`]); the volume follows ([`carry`]), and edges stay straight where an element would be turned over
//! ([`settle`]). The shape is that of the whole body, but only the wedge moves: what is one point in the copies moves as one, and
//! what a mirror or a rotation leaves in place stays there. So the mesh is as symmetric as before, to the bit.

mod body;
mod carry;
mod fixed;
mod jacobian;
mod nodes;
mod settle;
mod whole;

use crate::numbering::{NumberingError, Roots};
use body::Body;
use fixed::fixed;
use glam::DVec3;
use interchange::Middles;
use kit::tolerance;
use nodes::Nodes;
use remesh::Reading;
pub use settle::Bends;
use tmesh::{Document, Template};
use whole::whole;

/// Moves the vertices and the points on edges of a document that has these (see [`interchange::second_order`]) onto the shape
/// behind its facets. Bodies without curved faces stay as they are, to the bit. n log n in the facets of the body, linear
/// in the elements of the wedge.
///
/// # Errors
/// Instances that do not close up.
pub fn follow_shape(document: &mut Document, middles: &Middles) -> Result<Bends, NumberingError> {
    let tolerance = tolerance(document);
    let reading = Reading {
        flat: tolerance.flat(),
        feature: libm::cos(document.wishes.feature_angle().to_radians()),
    };
    let whole = whole(document);
    let Some(body) = Body::new(document, &whole, reading)? else {
        return Ok(Bends::default());
    };
    let roots = Roots::new(&whole)?;
    let mut nodes = Nodes::new(document, (middles, &roots), &body, tolerance.rounding());
    nodes.carry(document);
    let bends = nodes.settle(document, middles, tolerance.rounding());
    let moves = nodes.moves;
    apply(document, &roots, &moves);
    Ok(bends)
}

/// Moves the nodes, and puts those on walls exactly where their copies are.
fn apply(document: &mut Document, roots: &Roots, moves: &[Vec<DVec3>]) {
    for (template, moves) in document.templates.iter_mut().zip(moves) {
        for (p, by) in template.vertices.iter_mut().zip(moves) {
            // Adding nothing could turn a negative zero.
            if *by != DVec3::ZERO {
                *p += *by;
            }
        }
    }
    for shared in &roots.shared {
        let (t, v) = shared.own;
        if moves[t][v as usize] == DVec3::ZERO {
            continue;
        }
        if shared.own == shared.root {
            let generators = roots.generators(shared.root);
            let p = &mut document.templates[t].vertices[v as usize];
            *p = fixed(generators, *p);
        }
    }
    for shared in roots.shared.iter().filter(|s| s.own != s.root) {
        let ((t, v), (r, w)) = (shared.own, shared.root);
        if moves[t][v as usize] != DVec3::ZERO {
            let p = document.templates[r].vertices[w as usize];
            document.templates[t].vertices[v as usize] = shared.offset.apply(p);
        }
    }
    for (t, (template, moves)) in document.templates.iter_mut().zip(moves).enumerate() {
        let Template {
            vertices, gluings, ..
        } = template;
        for gluing in gluings.iter().filter(|g| g.is_seam(t)) {
            let step = gluing.step.placed();
            for &[here, there] in gluing.vertex_pairs.iter().filter(|p| p[0] != p[1]) {
                if moves[there as usize] != DVec3::ZERO {
                    vertices[here as usize] = step.apply(vertices[there as usize]);
                }
            }
        }
    }
}
