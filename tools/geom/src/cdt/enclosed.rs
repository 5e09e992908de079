//! What segments enclose.

use super::triangulation::{Cdt, CdtError, NONE};

impl Cdt {
    /// Whether each triangle is enclosed by segments: what can be reached from the outside of the convex hull or
    /// from one of the `holes` without crossing a segment is not. A hole on a segment is none.
    pub fn enclosed(&self, holes: &[[f64; 2]]) -> Vec<bool> {
        let mut inside = vec![true; self.triangles.len()];
        let mut stack: Vec<u32> = holes.iter().filter_map(|&h| self.beside(h)).collect();
        let at_hull = |t: &u32| {
            let sides = self.across[*t as usize]
                .iter()
                .zip(self.is_segment[*t as usize]);
            sides
                .into_iter()
                .any(|(&next, is_segment)| next == NONE && !is_segment)
        };
        stack.extend((0..self.triangles.len() as u32).filter(at_hull));
        while let Some(t) = stack.pop() {
            if !std::mem::replace(&mut inside[t as usize], false) {
                continue;
            }
            let sides = self.across[t as usize]
                .iter()
                .zip(self.is_segment[t as usize]);
            let open = sides.filter(|&(&next, is_segment)| next != NONE && !is_segment);
            stack.extend(open.map(|(&next, _)| next));
        }
        inside
    }
}

/// Triangles of the part of the plane that segments enclose, counter-clockwise, points by index, without the parts
/// around holes; see [`Cdt::enclosed`]. No points are added.
///
/// # Errors
/// Segments that cross, coincident points.
pub fn triangulate_enclosed(
    points: &[[f64; 2]],
    segments: &[[u32; 2]],
    holes: &[[f64; 2]],
) -> Result<Vec<[u32; 3]>, CdtError> {
    if points.len() < 3 {
        return Ok(Vec::new());
    }
    let cdt = Cdt::new(points, segments)?;
    let triangles = cdt.triangles.iter().zip(cdt.enclosed(holes));
    Ok(triangles.filter(|t| t.1).map(|t| *t.0).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(low: f64, high: f64) -> [[f64; 2]; 4] {
        [[low, low], [high, low], [high, high], [low, high]]
    }

    fn area(points: &[[f64; 2]], segments: &[[u32; 2]], holes: &[[f64; 2]]) -> f64 {
        let triangles = triangulate_enclosed(points, segments, holes).unwrap();
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| points[v as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        triangles.iter().map(area).sum()
    }

    const LOOPS: [[u32; 2]; 8] = [
        [0, 1],
        [1, 2],
        [2, 3],
        [3, 0],
        [4, 5],
        [5, 6],
        [6, 7],
        [7, 4],
    ];

    #[test]
    fn inner_loops_are_holes_only_with_a_hole_point() {
        let points = [ring(0.0, 4.0), ring(1.0, 3.0)].concat();
        assert_eq!(area(&points, &LOOPS, &[]), 16.0);
        for hole in [[2.0, 2.25], [2.0, 2.0]] {
            assert_eq!(area(&points, &LOOPS, &[hole]), 12.0);
        }
        assert_eq!(area(&points, &LOOPS, &[[1.0, 2.0]]), 16.0, "on a segment");
    }

    #[test]
    fn an_open_chain_encloses_nothing() {
        let chain = [[0, 1], [1, 2], [2, 3]];
        let triangles = triangulate_enclosed(&ring(0.0, 1.0), &chain, &[]);
        assert_eq!(triangles, Ok(Vec::new()));
    }

    #[test]
    fn crossing_segments_and_equal_points_are_errors() {
        let points = ring(0.0, 1.0);
        let crossing = triangulate_enclosed(&points, &[[0, 2], [1, 3]], &[]);
        assert!(matches!(crossing, Err(CdtError::Crossing(..))));
        let twice = [points.as_slice(), &[[-0.0, 0.0]]].concat();
        let twice = triangulate_enclosed(&twice, &[[0, 1]], &[]);
        assert_eq!(twice, Err(CdtError::Coincident(0, 4)));
    }

    #[test]
    fn any_scale_will_do() {
        for scale in [1e-200, 1e-6, 1e200] {
            let points = ring(0.0, 4.0).map(|p| p.map(|x| x * scale));
            let square = triangulate_enclosed(&points, &LOOPS[..4], &[]).unwrap();
            assert_eq!(square.len(), 2);
        }
    }
}
