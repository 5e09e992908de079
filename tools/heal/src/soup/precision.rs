//! How precise coordinates are, as solids that touch tell.
//!
//! A file that was rounded and then turned, scaled or printed by something else has more digits than are known. Where solids touch
//! there, the coordinates that they have of one place differ by what was rounded, which is more than what the digits tell.

use super::imprinted::{Imprinted, Unjoined, imprinted};
use super::surface::Surface;
use crate::contacts::Contacts;
use crate::document::tolerance;
use geom::tree::Tree;

/// Steps in which precisions are tried. What was rounded makes distances of all sizes up to that of the rounding: where there are others that are up to so many
/// times as large as what counts as equal, there was more of it. A choice: no wider than what does by much, in a handful of steps.
const STEP: f64 = 8.0;

/// Precision, relative to the largest coordinate, of what has been in a file of single precision, whatever it was turned and printed with since.
const SINGLE: f64 = 0.5 * f32::EPSILON as f64;

/// Precision, relative to the largest coordinate, beyond which nothing is taken for rounding: what is nearer than sixteen times that is
/// one, and the default tolerance of a symmetry is a thousandth.
const LEAST: f64 = 1e-3 / 16.0;

/// Solids that cannot be joined within the precision that coordinates seem to have, or that claim of each other what may be rounding, joined within the
/// least that can be, no wider than what is printed of them explains, or what single precision does; with that precision.
pub fn less_precise(
    surface: &Surface,
    made: &Result<Imprinted, Unjoined>,
    [seeming, printed]: [f64; 2],
    contacts: Contacts,
) -> Option<(f64, Imprinted)> {
    let most = printed.clamp(SINGLE, LEAST);
    let equal = |precision| tolerance(&surface.points, precision).equal();
    let is_doubtful = |made: &Imprinted| made.thinnest <= equal(most);
    match made {
        Ok(made) if !is_doubtful(made) => return None,
        Err(unjoined) if !unjoined.may_be_rounding => return None,
        _ => {}
    }
    let distances = distances(surface, STEP * equal(most));
    let is_between = |[low, high]: [f64; 2]| {
        let next = distances.partition_point(|d| *d <= low);
        distances.get(next).is_some_and(|d| *d <= high)
    };
    let mut precision = seeming;
    while precision < most {
        let before = equal(precision);
        precision = (STEP * precision).min(most);
        let here = equal(precision);
        let is_last = precision == most;
        let has_all = || is_between([before, here]) && !is_between([here, STEP * here]);
        if (is_last || has_all())
            && let Ok(made) = imprinted(
                surface,
                &tolerance(&surface.points, precision),
                contacts,
                None,
            )
            && !is_doubtful(&made)
        {
            return Some((precision, made));
        }
    }
    None
}

/// How far points of solids are from others, where that is within a distance, model units; increasing. n log n.
fn distances(surface: &Surface, within: f64) -> Vec<f64> {
    let place = |t: &[u32; 3]| t.map(|v| surface.points[v as usize]);
    let tree = Tree::new(surface.triangles.iter().map(place));
    let mut owners: Vec<(u32, u32)> = Vec::with_capacity(3 * surface.triangles.len());
    for (corners, &solid) in surface.triangles.iter().zip(&surface.solid) {
        owners.extend(corners.map(|v| (v, solid)));
    }
    owners.sort_unstable();
    owners.dedup();
    let nearest = |own: &[(u32, u32)]| {
        let is_other = |t: u32| {
            let solid = surface.solid[t as usize];
            own.iter().all(|owner| owner.1 != solid)
        };
        let near = tree.nearest_of(surface.points[own[0].0 as usize], within, is_other);
        near.map(|near| near.distance)
    };
    let each = owners.chunk_by(|a, b| a.0 == b.0);
    let mut distances: Vec<f64> = each.filter_map(nearest).collect();
    distances.sort_by(f64::total_cmp);
    distances
}
