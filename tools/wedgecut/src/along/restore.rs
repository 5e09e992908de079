//! Bending a wedge back.

use crate::error::CutError;
use crate::graph::Graph;
use geom::cells::Cells;
use geom::contacts::contacts;
use geom::edges::Edges;
use glam::DVec3;
use tmesh::{Frame, Template};

/// Bends straightened templates back; faces that are images of others are made so anew, to the bit.
///
/// # Errors
/// [`CutError::SeamCrosses`]: the faces made by the cut cross the surface of the body, or each other;
/// [`CutError::BeyondSeam`]: a piece of it is on their other side.
pub fn restore(templates: &mut [Template], graph: &Graph, frame: &Frame) -> Result<(), CutError> {
    for (index, template) in templates.iter_mut().enumerate() {
        for p in &mut template.vertices {
            // Adding zero folds negative zeros.
            *p = graph.bend(*p) + DVec3::ZERO;
        }
        for gluing in &template.gluings {
            if !gluing.is_seam(index) {
                continue;
            }
            for &[here, there] in &gluing.vertex_pairs {
                if here != there {
                    let image = gluing.step.apply(template.vertices[there as usize]);
                    template.vertices[here as usize] = image;
                }
            }
        }
    }
    (0..templates.len()).try_for_each(|index| check(templates, index, frame))
}

/// Whether the glued faces of a template meet anything but where they end.
fn check(templates: &[Template], index: usize, frame: &Frame) -> Result<(), CutError> {
    // The surface of the body is one group: whether it crosses itself is not for the cut to say.
    let template = &templates[index];
    let mut group = vec![0; template.triangles.len()];
    for (i, other) in templates.iter().enumerate() {
        for gluing in &other.gluings {
            for &[here, there] in &gluing.triangle_pairs {
                if i == index {
                    group[here as usize] = here + 1;
                }
                if gluing.other as usize == index {
                    group[there as usize] = there + 1;
                }
            }
        }
    }
    let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    let mut first = None;
    contacts(
        &template.vertices,
        &triangles,
        |t| group[t as usize],
        |contact| {
            first = Some(contact.point);
            false
        },
    );
    if let Some(point) = first {
        return Err(CutError::SeamCrosses {
            near: frame.to_world(point),
        });
    }
    match misplaced(template, &triangles) {
        Some(point) => Err(CutError::BeyondSeam {
            near: frame.to_world(point),
        }),
        None => Ok(()),
    }
}

/// A point of a piece of the surface that lies in a cell of another region than it says, which is where it was before the
/// seam was bent: one that is wholly between the seam and its chords crosses neither. n log n.
fn misplaced(template: &Template, triangles: &[[u32; 3]]) -> Option<DVec3> {
    let cells = Cells::new(&template.vertices, triangles, &Edges::new(triangles));
    let mut regions: Vec<Option<u32>> = vec![None; cells.count()];
    let mut is_of_cell =
        |cell: u32, region: u32| *regions[cell as usize].get_or_insert(region) == region;
    let wrong = (template.triangles.iter().enumerate()).find(|(i, t)| {
        !(is_of_cell(cells.front(*i), t.front) && is_of_cell(cells.back(*i), t.back))
    });
    wrong.map(|(_, t)| {
        let corners = t.vertices.map(|v| template.vertices[v as usize]);
        corners.into_iter().sum::<DVec3>() / 3.0
    })
}
