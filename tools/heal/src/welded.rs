//! Points with equal coordinates as one.

use geom::weld::Welder;
use glam::DVec3;

/// The distinct points, in order of first appearance, and the number of each point among them.
/// `expected` is about how many are distinct.
pub fn welded(points: impl IntoIterator<Item = DVec3>, expected: usize) -> (Vec<DVec3>, Vec<u32>) {
    let mut welder = Welder::new(expected);
    let ids = points.into_iter().map(|p| welder.id(p)).collect();
    let distinct = welder.into_points().into_iter().map(DVec3::from);
    (distinct.collect(), ids)
}
