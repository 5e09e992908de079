//! Pairs of places that are near each other, each by a measure of its own.

use geom::tree::pairs;
use glam::DVec3;

/// Pairs of boxes looked at, at most, for each box: a choice. Sound files and usual cracks have a few each; without a
/// limit, a file whose points all lie in each other's reach takes quadratic time.
const PAIRS_EACH: usize = 1000;

/// Calls `visit` with the pairs of boxes of different groups that meet; false if they are too many to visit all.
pub fn near(
    boxes: &[[DVec3; 2]],
    group: impl Fn(u32) -> u32,
    mut visit: impl FnMut(u32, u32),
) -> bool {
    let mut left = PAIRS_EACH * boxes.len();
    pairs(boxes.iter().copied(), group, |a, b| {
        visit(a.min(b), a.max(b));
        left = left.saturating_sub(1);
        left > 0
    });
    boxes.is_empty() || left > 0
}
