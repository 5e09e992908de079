//! From the clipped surface and its caps to the wedge template.

use crate::error::CutError;
use crate::opening::{Class, Opening, Side};
use crate::plan::Plan;
use crate::seam::Matched;
use crate::surface::Surface;
use geom::edges::Edges;
use glam::DVec3;
use tmesh::{Frame, Isometry, MirrorWall, Plane, Seam, Template, Triangle, Wall};

/// A body that is its own wedge.
pub fn whole(surface: Surface, frame: &Frame) -> Result<Template, CutError> {
    Ok(compact(surface, frame)?.into_parts().0)
}

/// A wedge between mirror walls; `caps` in the order of the sides.
pub fn mirror_wedge(
    mut surface: Surface,
    caps: Vec<Vec<Triangle>>,
    plan: &Plan,
    opening: &Opening,
    frame: &Frame,
) -> Result<Template, CutError> {
    let mut ranges = Vec::new();
    for cap in caps {
        let start = surface.faces.len() as u32;
        surface.faces.extend(cap);
        ranges.push(start..surface.faces.len() as u32);
    }
    let (mut template, classes) = compact(surface, frame)?.into_parts();
    for (i, range) in ranges.into_iter().enumerate() {
        let (side, name) = if i == 0 {
            (Side::A, "wall-a")
        } else {
            (Side::B, "wall-b")
        };
        let reflection = if i == 0 {
            Isometry::reflection(0, 1)
        } else {
            Isometry::reflection(1, plan.order)
        };
        let on = |class: &Class| class.of(side) == 0;
        let vertices = (0..classes.len() as u32)
            .filter(|&v| on(&classes[v as usize]))
            .collect();
        template.walls.push(Wall::Mirror(MirrorWall {
            name: name.to_owned(),
            plane: Plane {
                normal: -opening.inward(side),
                offset: 0.0,
            },
            reflection,
            vertices,
            triangles: range.collect(),
        }));
    }
    Ok(template)
}

/// A wedge with a seam; `cap` closes the low side, its image the high side.
pub fn rotation_wedge(
    mut surface: Surface,
    cap: Vec<Triangle>,
    matched: Matched,
    plan: &Plan,
    frame: &Frame,
) -> Result<Template, CutError> {
    let partner = |v: u32| {
        let i = matched.pairs.binary_search_by_key(&v, |p| p[0]);
        i.map_or(v, |i| matched.pairs[i][1])
    };
    let start = surface.faces.len() as u32;
    let count = cap.len() as u32;
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
    surface.faces.extend(cap);
    surface.faces.extend(image);
    let compacted = compact(surface, frame)?;
    let mut vertex_pairs: Vec<[u32; 2]> = matched
        .pairs
        .iter()
        .filter_map(|pair| {
            Some([
                compacted.renumbered(pair[0])?,
                compacted.renumbered(pair[1])?,
            ])
        })
        .collect();
    vertex_pairs.sort_unstable();
    let (mut template, _) = compacted.into_parts();
    template.walls.push(Wall::Seam(Seam {
        name: "seam".to_owned(),
        rotation: Isometry::rotation(1, plan.order),
        vertex_pairs,
        triangle_pairs: (0..count).map(|i| [start + i, start + count + i]).collect(),
    }));
    Ok(template)
}

struct Compacted {
    template: Template,
    classes: Vec<Class>,
    new_id: Vec<u32>,
}

impl Compacted {
    fn renumbered(&self, v: u32) -> Option<u32> {
        Some(self.new_id[v as usize]).filter(|&v| v != u32::MAX)
    }

    fn into_parts(self) -> (Template, Vec<Class>) {
        (self.template, self.classes)
    }
}

/// Drops unused points, lists the axis, and makes sure the surface closes.
fn compact(surface: Surface, frame: &Frame) -> Result<Compacted, CutError> {
    check_closed(&surface, frame)?;
    let mut used = vec![false; surface.points.len()];
    for v in surface.faces.iter().flat_map(|f| f.vertices) {
        used[v as usize] = true;
    }
    let mut new_id = vec![u32::MAX; surface.points.len()];
    let mut template = Template::default();
    let mut classes = Vec::new();
    for (v, &used) in used.iter().enumerate() {
        if used {
            new_id[v] = template.vertices.len() as u32;
            if surface.classes[v] == Class::AXIS {
                template.axis.push(new_id[v]);
            }
            // Adding zero folds negative zeros, which would make equal points differ in their bits.
            template.vertices.push(surface.points[v] + DVec3::ZERO);
            classes.push(surface.classes[v]);
        }
    }
    template.triangles = surface.faces;
    for t in &mut template.triangles {
        t.vertices = t.vertices.map(|v| new_id[v as usize]);
    }
    Ok(Compacted {
        template,
        classes,
        new_id,
    })
}

/// Around every edge each region must be left as often as it is entered.
fn check_closed(surface: &Surface, frame: &Frame) -> Result<(), CutError> {
    let corners: Vec<[u32; 3]> = surface.faces.iter().map(|f| f.vertices).collect();
    let edges = Edges::new(&corners);
    let mut open = 0;
    let mut first = DVec3::ZERO;
    let mut balance: Vec<(u32, i32)> = Vec::new();
    for e in 0..edges.len() {
        balance.clear();
        for u in edges.around(e) {
            let face = &surface.faces[u.triangle as usize];
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
                let [a, b] = edges.ends[e].map(|v| surface.points[v as usize]);
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
