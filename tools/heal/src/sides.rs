//! From cells of space with regions to triangles with sides.

use geom::cells::Cells;
use tmesh::{OUTSIDE, Triangle};

/// Triangles between different regions, and how many are not.
pub struct Sided {
    /// Boundaries face outwards, interfaces towards the higher region id.
    pub triangles: Vec<Triangle>,
    /// Triangles left out that have the same region on both sides.
    pub inner: usize,
    /// Triangles left out that have no region on either side.
    pub outer: usize,
}

/// Gives triangles the regions of the cells on both sides, and markers by their positions.
pub fn sided(
    triangles: &[[u32; 3]],
    cells: &Cells<'_>,
    region_of: &[u32],
    marker: impl Fn(usize) -> u32,
) -> Sided {
    let mut sided = Sided {
        triangles: Vec::with_capacity(triangles.len()),
        inner: 0,
        outer: 0,
    };
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        let front = region_of[cells.front(t) as usize];
        let back = region_of[cells.back(t) as usize];
        if front == back {
            *(if front == OUTSIDE {
                &mut sided.outer
            } else {
                &mut sided.inner
            }) += 1;
            continue;
        }
        // OUTSIDE is the highest id.
        let turned = front < back;
        sided.triangles.push(Triangle {
            vertices: if turned { [a, c, b] } else { [a, b, c] },
            marker: marker(t),
            front: front.max(back),
            back: front.min(back),
        });
    }
    sided
}
