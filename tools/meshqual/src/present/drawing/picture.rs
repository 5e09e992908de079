//! Pictures of a mesh as PNG files: what is drawn, and in which colours.

use super::canvas::Canvas;
use super::colours::{quality_colour, region_colour};
use super::view::View;
use crate::instances::wall_triangles;
use geom::tet::{FACES, TetMeasures};
use glam::DVec3;
use png::EncodingError;
use tmesh::{Document, OUTSIDE, Template};

/// The outside of the mesh, coloured by region, as a PNG file.
pub fn outside(document: &Document) -> Result<Vec<u8>, EncodingError> {
    let view = View::of(document);
    let mut canvas = Canvas::new();
    let walls = wall_triangles(document);
    // A piece on its own shows its cut faces.
    let alone = document.instances.len() <= document.templates.len();
    for instance in &document.instances {
        let t = instance.template as usize;
        let template = &document.templates[t];
        let placed = instance.isometry.placed();
        for (triangle, &on_wall) in template.triangles.iter().zip(&walls[t]) {
            let outer = (triangle.front == OUTSIDE) != (triangle.back == OUTSIDE);
            if !outer || (on_wall && !alone) {
                continue;
            }
            let inner = triangle.front.min(triangle.back);
            let region = document.placed_region(instance, inner);
            let corners = triangle
                .vertices
                .map(|v| view.see(placed.apply(template.vertices[v as usize])));
            canvas.triangle(corners, region_colour(position(document, region)));
        }
    }
    canvas.png()
}

/// What the colour of an element says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// Its region.
    Region,
    /// Its smallest dihedral angle.
    Quality,
}

/// The half of the mesh behind a plane through the axis, as a PNG file; `None` without tetrahedra.
pub fn inside(document: &Document, by: Colour) -> Result<Option<Vec<u8>>, EncodingError> {
    if document.templates.iter().all(|t| t.tets.is_empty()) {
        return Ok(None);
    }
    let view = View::behind(document);
    let mut canvas = Canvas::new();
    let quality: Vec<Vec<[u8; 3]>> = match by {
        Colour::Region => Vec::new(),
        Colour::Quality => document.templates.iter().map(qualities).collect(),
    };
    for instance in &document.instances {
        let t = instance.template as usize;
        let template = &document.templates[t];
        let placed = instance.isometry.placed();
        let seen: Vec<DVec3> = template
            .vertices
            .iter()
            .map(|&p| view.see(placed.apply(p)))
            .collect();
        let behind: Vec<bool> = template
            .vertices
            .iter()
            .map(|&p| view.is_behind(placed.apply(p)))
            .collect();
        // Seen from outside, with y downwards, unless the instance is a mirror image.
        let facing = if instance.isometry.reverses_orientation() {
            1.0
        } else {
            -1.0
        };
        for (i, tet) in template.tets.iter().enumerate() {
            if !tet.vertices.iter().all(|&v| behind[v as usize]) {
                continue;
            }
            let colour = match by {
                Colour::Quality => quality[t][i].map(f64::from),
                Colour::Region => region_colour(position(
                    document,
                    document.placed_region(instance, tet.region),
                )),
            };
            for face in FACES {
                let [a, b, c] = face.map(|c| seen[tet.vertices[c] as usize]);
                let turn = (b - a).truncate().perp_dot((c - a).truncate());
                if turn * facing > 0.0 {
                    canvas.triangle([a, b, c], colour);
                }
            }
        }
    }
    canvas.png().map(Some)
}

/// Colours of a template's elements by their smallest dihedral angle.
fn qualities(template: &Template) -> Vec<[u8; 3]> {
    let corners = template.tets.iter().map(|t| t.vertices);
    corners
        .map(|v| {
            let m = TetMeasures::of(v.map(|v| template.vertices[v as usize]));
            quality_colour(m.min_dihedral().to_degrees()).map(|c| c as u8)
        })
        .collect()
}

fn position(document: &Document, region: u32) -> usize {
    let found = document.regions.binary_search_by_key(&region, |r| r.id);
    found.unwrap_or(region as usize)
}
