//! Surfaces whose solids are told, and several of them as one.

use super::mending::Mending;
use super::surface::{NONE, Surface};
use crate::Repair;
use crate::document::largest_coordinate;
use crate::welded::welded;

/// A closed surface whose solids are told, before it is told which of them is on either side of a triangle.
pub struct Mended {
    /// The surface, and what was repaired.
    pub mending: Mending,
    /// What the user should know, a sentence each.
    pub notices: Vec<String>,
}

/// Puts surfaces together: the solids of all of them, and all their groups. Points with equal coordinates become one.
/// Names are those that the parts have.
pub fn join(parts: Vec<Mended>) -> Mended {
    let mut whole = Surface {
        points: Vec::new(),
        triangles: Vec::new(),
        group: Vec::new(),
        solid: Vec::new(),
        partner: Vec::new(),
        source: Vec::new(),
        groups: Vec::new(),
        solids: Vec::new(),
        group_word: "region",
    };
    let (mut notices, mut repairs) = (Vec::new(), Vec::<Repair>::new());
    let mut precision = [0.0_f64; 2];
    for part in parts {
        let Mending {
            surface,
            repairs: done,
            relative_precision,
            printed_precision,
            ..
        } = part.mending;
        let largest = largest_coordinate(&surface.points);
        for (most, of_part) in (precision.iter_mut()).zip([relative_precision, printed_precision]) {
            *most = most.max(of_part * largest);
        }
        let [point, group, solid] =
            [whole.points.len(), whole.groups.len(), whole.solids.len()].map(|n| n as u32);
        let triangles = surface.triangles.iter();
        whole
            .triangles
            .extend(triangles.map(|t| t.map(|v| v + point)));
        whole.points.extend(surface.points);
        whole.group.extend(surface.group.iter().map(|g| g + group));
        whole.solid.extend(surface.solid.iter().map(|s| s + solid));
        whole.groups.extend(surface.groups);
        whole.solids.extend(surface.solids);
        notices.extend(part.notices);
        for repair in done {
            match repairs.iter_mut().find(|r| r.kind == repair.kind) {
                Some(known) => known.add(&repair),
                None => repairs.push(repair),
            }
        }
    }
    let expected = whole.points.len();
    let (points, ids) = welded(std::mem::take(&mut whole.points), expected);
    for t in &mut whole.triangles {
        *t = t.map(|v| ids[v as usize]);
    }
    whole.points = points;
    whole.partner = vec![NONE; whole.triangles.len()];
    whole.source = (0..whole.triangles.len() as u32).collect();
    let largest = largest_coordinate(&whole.points);
    let relative = |precision: f64| match largest > 0.0 {
        true => precision / largest,
        false => 0.0,
    };
    let mut mending = Mending::new(whole, precision.map(relative));
    mending.repairs = repairs;
    Mended { mending, notices }
}
