//! Pairs of places that are near each other, each by a measure of its own.

use geom::tree::{Search, pairs};
use glam::DVec3;

/// Calls `visit` with the pairs of boxes of different groups that meet; false if they are too many to visit all.
pub fn near(
    boxes: &[[DVec3; 2]],
    group: impl Fn(u32) -> u32,
    mut visit: impl FnMut(u32, u32),
) -> bool {
    let search = pairs(boxes.iter().copied(), group, |a, b| {
        visit(a.min(b), a.max(b));
        true
    });
    search == Search::Done
}
