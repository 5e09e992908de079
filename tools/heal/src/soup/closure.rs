//! Whether a surface is closed, as a whole and solid by solid.

use super::surface::Surface;
use crate::words::place;
use crate::{HealError, OddEdges};
use geom::edges::Edges;
use interchange::text::counted;

/// Edges with an odd number of triangles.
pub fn odd_edges(edges: &Edges) -> Vec<usize> {
    (0..edges.len())
        .filter(|&e| edges.around(e).len() % 2 == 1)
        .collect()
}

/// Whether every group has an even number of triangles at every edge.
pub fn groups_are_closed(surface: &Surface, edges: &Edges) -> bool {
    let mut groups = Vec::new();
    (0..edges.len()).all(|e| {
        let group = |i: usize| surface.group[edges.around(e)[i].triangle as usize];
        let n = edges.around(e).len();
        if n == 2 {
            return group(0) == group(1);
        }
        groups.clear();
        groups.extend((0..n).map(group));
        groups.sort_unstable();
        groups.chunk_by(|a, b| a == b).all(|c| c.len() % 2 == 0)
    })
}

/// The error for a surface with these odd edges; `None` when there are none.
pub fn open_surface(surface: &Surface, edges: &Edges, odd: &[usize]) -> Option<HealError> {
    let describe = |list: &[usize], one: &str, many: &str| {
        let first = *list.first()?;
        let [a, b] = edges.ends[first].map(|v| place(surface.points[v as usize]));
        let owner = edges.around(first)[0].triangle as usize;
        let solid = if surface.groups.len() > 1 {
            format!(", in {}", surface.group_name(surface.group[owner]))
        } else {
            String::new()
        };
        let which = if list.len() == 1 {
            "it runs"
        } else {
            "the first"
        };
        Some(format!(
            "{} ({which} from {a} to {b}{solid})",
            counted(list.len(), one, many)
        ))
    };
    let (open, crowded): (Vec<usize>, Vec<usize>) =
        odd.iter().partition(|&&e| edges.around(e).len() == 1);
    let parts: Vec<String> = [
        describe(&open, "open edge", "open edges"),
        describe(
            &crowded,
            "edge with an odd number of triangles",
            "edges with an odd number of triangles",
        ),
    ]
    .into_iter()
    .flatten()
    .collect();
    (!parts.is_empty()).then(|| {
        let ends = |list: &[usize]| {
            let points = |e: &usize| edges.ends[*e].map(|v| surface.points[v as usize]);
            list.iter().map(points).collect()
        };
        HealError::NotClosed {
            message: format!("the surface is not closed: {}", parts.join(" and ")),
            edges: Box::new(OddEdges {
                open: ends(&open),
                crowded: ends(&crowded),
            }),
        }
    })
}
