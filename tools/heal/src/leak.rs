//! Where a surface that encloses nothing is open.

use crate::words::place;
use geom::edges::Edges;
use glam::DVec3;
use interchange::text::counted;

/// The number of edges of one triangle, called `one` or `many`, and where the first is, to be added to
/// a sentence; nothing where there are none.
pub fn leak(points: &[DVec3], edges: &Edges, one: &str, many: &str) -> String {
    let mut open = (0..edges.len()).filter(|&e| edges.around(e).len() == 1);
    let Some(first) = open.next() else {
        return String::new();
    };
    let [a, b] = edges.ends[first].map(|v| place(points[v as usize]));
    let count = counted(1 + open.count(), one, many);
    format!("; {count} (the first from {a} to {b})")
}
