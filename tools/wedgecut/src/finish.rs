//! From the clipped surface and its caps to the wedge template.

use crate::error::CutError;
use crate::opening::{Class, Side};
use crate::plan::Plan;
use crate::seam::Matched;
use crate::surface::Surface;
use geom::edges::Edges;
use glam::DVec3;
use std::ops::Range;
use tmesh::{Frame, Gluing, Isometry, Template, Triangle};

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

/// A body that is its own wedge.
pub fn whole(surface: &Surface, frame: &Frame) -> Result<Template, CutError> {
    Ok(compact(surface, surface.faces.clone(), frame)?.template)
}

/// What closes a part of the surface, facing out.
pub struct Caps {
    /// At the sides, in order; of a rotation wedge at the low one only.
    pub sides: Vec<Vec<Triangle>>,
    /// At the plane z = 0, if that is a wall.
    pub level: Option<Vec<Triangle>>,
}

/// What the wedge is cut by.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The copies.
    pub plan: &'a Plan,
    /// Where the input is.
    pub frame: &'a Frame,
}

/// Name of the wall in the plane z = 0.
pub const LEVEL_WALL: &str = "wall-level";

/// A wedge between mirror walls; `faces` of the surface belong to it, `caps` close it at the sides,
/// `hub` towards the hub.
pub fn mirror_wedge(
    surface: &Surface,
    mut faces: Vec<Triangle>,
    caps: &Caps,
    hub: &[Triangle],
    context: &Context<'_>,
) -> Result<Wedge, CutError> {
    let Context { plan, frame } = *context;
    let sides = caps.sides.iter();
    let ranges: Vec<Range<u32>> = sides.map(|cap| append(&mut faces, cap)).collect();
    let level = caps.level.as_ref().map(|cap| append(&mut faces, cap));
    let hub = append(&mut faces, hub);
    let mut wedge = Wedge {
        hub,
        ..compact(surface, faces, frame)?
    };
    for (side, range) in [Side::A, Side::B].into_iter().zip(ranges) {
        let reflection = match side {
            Side::A => Isometry::reflection(0, 1),
            _ => Isometry::reflection(1, plan.order),
        };
        mirror_wall(&mut wedge, side, reflection, range);
    }
    if let Some(range) = level {
        mirror_wall(&mut wedge, Side::Level, LEVEL, range);
    }
    Ok(wedge)
}

/// Reflection in the plane z = 0.
pub const LEVEL: Isometry = Isometry::FLIP;

fn mirror_wall(wedge: &mut Wedge, side: Side, reflection: Isometry, triangles: Range<u32>) {
    let name = match side {
        Side::A => "wall-a",
        Side::B => "wall-b",
        Side::Level | Side::Hub => LEVEL_WALL,
    };
    let on = |v: &u32| wedge.classes[*v as usize].of(side) == 0;
    let vertices = (0..wedge.classes.len() as u32).filter(on);
    let gluing = Gluing::mirror(name, 0, reflection, vertices, triangles);
    wedge.template.gluings.push(gluing);
}

fn append(faces: &mut Vec<Triangle>, cap: &[Triangle]) -> Range<u32> {
    let start = faces.len() as u32;
    faces.extend(cap);
    start..faces.len() as u32
}

/// A wedge with a seam; `faces` of the surface belong to it, `caps` close the low side, whose image
/// closes the high side, `hub` closes it towards the hub.
pub fn rotation_wedge(
    surface: &Surface,
    mut faces: Vec<Triangle>,
    caps: &Caps,
    hub: &[Triangle],
    matched: &Matched,
    context: &Context<'_>,
) -> Result<Wedge, CutError> {
    let Context { plan, frame } = *context;
    let cap = &caps.sides[0];
    let partner = |v: u32| {
        let i = matched.pairs.binary_search_by_key(&v, |p| p[0]);
        i.map_or(v, |i| matched.pairs[i][1])
    };
    let image: Vec<Triangle> = cap
        .iter()
        .map(|t| {
            let [a, b, c] = t.vertices.map(partner);
            Triangle {
                vertices: [a, c, b],
                ..*t
            }
        })
        .collect();
    let low = append(&mut faces, cap);
    let high = append(&mut faces, &image);
    let level = caps.level.as_ref().map(|cap| append(&mut faces, cap));
    let hub = append(&mut faces, hub);
    let mut wedge = Wedge {
        hub,
        ..compact(surface, faces, frame)?
    };
    let new = |v: u32| wedge.renumbered[v as usize];
    let vertex_pairs = matched
        .pairs
        .iter()
        .map(|&[v, w]| [new(v), new(w)])
        .filter(|pair| !pair.contains(&u32::MAX));
    let seam = Gluing::seam(
        "seam",
        0,
        Isometry::rotation(1, plan.order),
        vertex_pairs,
        low.zip(high).map(|(a, b)| [a, b]),
    );
    wedge.template.gluings.push(seam);
    if let Some(range) = level {
        mirror_wall(&mut wedge, Side::Level, LEVEL, range);
    }
    Ok(wedge)
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

/// Around every edge each region must be left as often as it is entered.
///
/// # Errors
/// [`CutError::NotClosed`].
pub fn check_closed(points: &[DVec3], faces: &[Triangle], frame: &Frame) -> Result<(), CutError> {
    let corners: Vec<[u32; 3]> = faces.iter().map(|f| f.vertices).collect();
    let edges = Edges::new(&corners);
    let mut open = 0;
    let mut first = DVec3::ZERO;
    let mut balance: Vec<(u32, i32)> = Vec::new();
    for e in 0..edges.len() {
        balance.clear();
        for u in edges.around(e) {
            let face = &faces[u.triangle as usize];
            let step = if u.forward { 1 } else { -1 };
            for (region, change) in [(face.back, step), (face.front, -step)] {
                match balance.iter_mut().find(|b| b.0 == region) {
                    Some(b) => b.1 += change,
                    None => balance.push((region, change)),
                }
            }
        }
        if balance.iter().any(|b| b.1 != 0) {
            if open == 0 {
                let [a, b] = edges.ends[e].map(|v| points[v as usize]);
                first = frame.to_world(0.5 * (a + b));
            }
            open += 1;
        }
    }
    if open > 0 {
        Err(CutError::NotClosed {
            count: open,
            near: first,
        })
    } else {
        Ok(())
    }
}
