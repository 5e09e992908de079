//! From a piece of the surface and its caps to a template.

use super::closed::check_closed;
use crate::cell::{Cell, Class, Join};
use crate::error::CutError;
use crate::seam::Matched;
use crate::surface::Surface;
use glam::DVec3;
use std::ops::Range;
use tmesh::{Frame, Gluing, Template, Triangle};

/// A wedge, and what the hub has to know about it.
pub struct Wedge {
    /// The template.
    pub template: Template,
    /// Class of each vertex.
    classes: Vec<Class>,
    /// Vertex of each point of the surface, or `u32::MAX`.
    pub renumbered: Vec<u32>,
    /// Triangles on the hub.
    pub hub: Range<u32>,
}

/// What closes a piece of the surface, facing out: for each join of the cell the cap of the part there.
pub type Caps = Vec<Vec<Triangle>>;

/// A wedge of the surface's `faces`: closed by `caps` and their images, and towards the hub by `hub`. `matched` has
/// the pairs of points of each join that is no mirror wall.
///
/// # Errors
/// [`CutError::NotClosed`].
pub fn assemble(
    surface: &Surface,
    cell: &Cell,
    parts: Parts<'_>,
    frame: &Frame,
) -> Result<Wedge, CutError> {
    let mut faces = parts.faces;
    let mut ranges = Vec::new();
    for ((join, cap), matched) in cell.joins.iter().zip(parts.caps).zip(parts.matched) {
        let there = append(&mut faces, cap);
        let here = match matched {
            Some(matched) => append(&mut faces, &image(cap, join, matched)),
            None => there.clone(),
        };
        ranges.push((here, there));
    }
    let hub = append(&mut faces, parts.hub);
    let mut wedge = Wedge {
        hub,
        ..compact(surface, faces, frame)?
    };
    for ((join, (here, there)), matched) in cell.joins.iter().zip(ranges).zip(parts.matched) {
        let gluing = match matched {
            Some(matched) => {
                let new = |v: u32| wedge.renumbered[v as usize];
                let pairs = matched.pairs.iter().map(|&[v, w]| [new(v), new(w)]);
                let pairs = pairs.filter(|pair| !pair.contains(&u32::MAX));
                let triangles = there.zip(here).map(|(a, b)| [a, b]);
                Gluing::seam(join.name, 0, join.step, pairs, triangles)
            }
            None => {
                let on = |v: &u32| wedge.classes[*v as usize].of(join.here.face) == 0;
                let vertices = (0..wedge.classes.len() as u32).filter(on);
                Gluing::mirror(join.name, 0, join.step, vertices, here)
            }
        };
        wedge.template.gluings.push(gluing);
    }
    Ok(wedge)
}

/// What a wedge is put together of.
pub struct Parts<'a> {
    /// Faces of the surface.
    pub faces: Vec<Triangle>,
    /// Caps, in the order of the cell's joins.
    pub caps: &'a Caps,
    /// Pairs of points of each join; none for mirror walls.
    pub matched: &'a [Option<Matched>],
    /// The cap towards the hub.
    pub hub: &'a [Triangle],
}

/// The image of the cap there, which closes the part here.
pub fn image(cap: &[Triangle], join: &Join, matched: &Matched) -> Vec<Triangle> {
    let partner = |v: u32| matched.partner(v).unwrap_or(v);
    // Both face out of the wedge, on different sides of the part's image.
    let turns_over = join.step.reverses_orientation();
    let image = |t: &Triangle| {
        let [a, b, c] = t.vertices.map(partner);
        Triangle {
            vertices: if turns_over { [a, b, c] } else { [a, c, b] },
            back: matched.regions.get(t.back),
            ..*t
        }
    };
    cap.iter().map(image).collect()
}

/// A body that is its own wedge.
///
/// # Errors
/// [`CutError::NotClosed`].
pub fn whole(surface: &Surface, frame: &Frame) -> Result<Template, CutError> {
    Ok(compact(surface, surface.faces.clone(), frame)?.template)
}

fn append(faces: &mut Vec<Triangle>, cap: &[Triangle]) -> Range<u32> {
    let start = faces.len() as u32;
    faces.extend(cap);
    start..faces.len() as u32
}

/// Drops unused points, lists the axis, and makes sure the surface closes.
fn compact(surface: &Surface, faces: Vec<Triangle>, frame: &Frame) -> Result<Wedge, CutError> {
    check_closed(&surface.points, &faces, frame)?;
    let mut used = vec![false; surface.points.len()];
    for v in faces.iter().flat_map(|f| f.vertices) {
        used[v as usize] = true;
    }
    let mut renumbered = vec![u32::MAX; surface.points.len()];
    let mut template = Template::default();
    let mut classes = Vec::new();
    for (v, &used) in used.iter().enumerate() {
        if used {
            renumbered[v] = template.vertices.len() as u32;
            if surface.classes[v].is_axis() {
                template.axis.push(renumbered[v]);
            }
            // Adding zero folds negative zeros, which would make equal points differ in their bits.
            template.vertices.push(surface.points[v] + DVec3::ZERO);
            classes.push(surface.classes[v]);
        }
    }
    template.triangles = faces;
    for t in &mut template.triangles {
        t.vertices = t.vertices.map(|v| renumbered[v as usize]);
    }
    Ok(Wedge {
        template,
        classes,
        renumbered,
        hub: 0..0,
    })
}
