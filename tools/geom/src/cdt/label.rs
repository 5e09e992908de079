//! Regions of the plane from what lies on either side of segments.

use super::triangulation::{Cdt, CdtError, NONE};
use rustc_hash::FxHashMap;

/// A segment between two points, by index, and what lies on either side of it.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Start and end.
    pub ends: [u32; 2],
    /// Label of the region to the left, walking from start to end; `None` where the segment does not know.
    pub left: Option<u32>,
    /// Label of the region to the right. A segment that knows neither side bounds nothing: the same
    /// region is on both sides.
    pub right: Option<u32>,
}

/// Segments by their ends.
pub struct Borders {
    /// Pairs of points, to be triangulated with.
    pub segments: Vec<[u32; 2]>,
    /// Of each direction of a segment, the label to the left, and whether the segment bounds nothing.
    left: FxHashMap<[u32; 2], (Option<u32>, bool)>,
}

impl Borders {
    /// Takes each segment once.
    pub fn new(segments: &[Segment]) -> Self {
        let mut left = FxHashMap::default();
        for s in segments {
            let [a, b] = s.ends;
            let open = s.left.is_none() && s.right.is_none();
            left.insert([a, b], (s.left, open));
            left.insert([b, a], (s.right, open));
        }
        Self {
            segments: segments.iter().map(|s| s.ends).collect(),
            left,
        }
    }

    fn bounds(&self, side: [u32; 2]) -> bool {
        self.left.get(&side).is_some_and(|(_, open)| !open)
    }
}

/// Labels of the triangles of a [`Cdt`].
pub struct Labels {
    /// Label of each triangle; `None` where no segment knows.
    pub of: Vec<Option<u32>>,
    /// A point where a region other than the outside of all is not closed: one can leave the convex hull from
    /// there. Its label and the point, of each such place.
    pub open: Vec<(u32, u32)>,
}

impl Cdt {
    /// Spreads labels from the segments to the triangles beside them, and further across sides that bound nothing.
    ///
    /// # Errors
    /// Segments that are not in the triangulation as they are, because they pass through a point;
    /// contradicting labels.
    pub fn label(&self, borders: &Borders) -> Result<Labels, CdtError> {
        if let Some([a, b]) = borders.segments.iter().find(|s| !self.has_segment(**s)) {
            return Err(CdtError::Crossing(*a, *b));
        }
        let side = |t: usize, i: usize| {
            let corners = &self.triangles[t];
            [corners[i], corners[(i + 1) % 3]]
        };
        let mut labels = Labels {
            of: vec![None; self.triangles.len()],
            open: Vec::new(),
        };
        let mut stack = Vec::new();
        for t in 0..self.triangles.len() {
            for i in 0..3 {
                let key = side(t, i);
                if let Some((Some(l), _)) = borders.left.get(&key) {
                    claim(&mut labels.of[t], *l, key[0])?;
                }
            }
            if labels.of[t].is_some() {
                stack.push(t);
            }
        }
        while let Some(t) = stack.pop() {
            let Some(own) = labels.of[t] else { continue };
            for i in 0..3 {
                let key = side(t, i);
                if borders.bounds(key) {
                    continue;
                }
                let next = self.across[t][i];
                if next == NONE {
                    labels.open.push((own, key[0]));
                    continue;
                }
                let slot = &mut labels.of[next as usize];
                let fresh = slot.is_none();
                claim(slot, own, key[0])?;
                if fresh {
                    stack.push(next as usize);
                }
            }
        }
        Ok(labels)
    }
}

fn claim(slot: &mut Option<u32>, label: u32, near: u32) -> Result<(), CdtError> {
    match *slot {
        Some(other) if other != label => Err(CdtError::Ambiguous {
            labels: [other, label],
            near,
        }),
        _ => {
            *slot = Some(label);
            Ok(())
        }
    }
}

/// Triangles of a subdivision of the plane with the label of the region they lie in, counter-clockwise, points by
/// index. Regions labelled `outside` and regions that no segment labels are left out.
///
/// # Errors
/// Segments that cross or pass through points, coincident points, contradicting labels.
pub fn triangulate(
    points: &[[f64; 2]],
    segments: &[Segment],
    outside: u32,
) -> Result<Vec<([u32; 3], u32)>, CdtError> {
    if points.len() < 3 {
        return Ok(Vec::new());
    }
    let borders = Borders::new(segments);
    let cdt = Cdt::new(points, &borders.segments)?;
    let labels = cdt.label(&borders)?;
    let labelled = cdt.triangles.iter().zip(labels.of);
    Ok(labelled
        .filter_map(|(t, label)| Some((*t, label.filter(|&l| l != outside)?)))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(a: u32, b: u32, left: u32, right: u32) -> Segment {
        Segment {
            ends: [a, b],
            left: Some(left),
            right: Some(right),
        }
    }

    fn area(points: &[[f64; 2]], triangles: &[([u32; 3], u32)], label: u32) -> f64 {
        let doubled: f64 = triangles
            .iter()
            .filter(|t| t.1 == label)
            .map(|t| {
                let [a, b, c] = t.0.map(|v| points[v as usize]);
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            })
            .sum();
        doubled / 2.0
    }

    #[test]
    fn a_square_with_a_hole_and_an_island() {
        let mut points = Vec::new();
        for h in [4.0, 2.0, 1.0] {
            points.extend([[-h, -h], [h, -h], [h, h], [-h, h]]);
        }
        let mut segments = Vec::new();
        for (ring, (inner, outer)) in [(7, 0), (0, 7), (9, 0)].into_iter().enumerate() {
            for k in 0..4 {
                let base = 4 * ring as u32;
                segments.push(segment(base + k, base + (k + 1) % 4, inner, outer));
            }
        }
        // The outermost ring's outside is 0, the middle ring's inside is 0.
        let triangles = triangulate(&points, &segments, 0).unwrap();
        assert_eq!(area(&points, &triangles, 7), 64.0 - 16.0);
        assert_eq!(area(&points, &triangles, 9), 4.0);
        assert!(triangles.iter().all(|t| t.1 != 0));
    }

    #[test]
    fn crossing_and_contradicting_edges_are_reported() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let cross = [segment(0, 2, 1, 1), segment(1, 3, 1, 1)];
        assert!(matches!(
            triangulate(&points, &cross, 0),
            Err(CdtError::Crossing(..))
        ));
        let round = [
            segment(0, 1, 1, 0),
            segment(1, 2, 2, 0),
            segment(2, 3, 1, 0),
            segment(3, 0, 1, 0),
        ];
        assert!(matches!(
            triangulate(&points, &round, 0),
            Err(CdtError::Ambiguous { .. })
        ));
        let through = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
        assert!(matches!(
            triangulate(&through, &[segment(0, 2, 1, 0)], 0),
            Err(CdtError::Crossing(0, 2))
        ));
    }

    #[test]
    fn a_region_that_is_not_closed_is_told() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let ring: Vec<Segment> = (0..4).map(|k| segment(k, (k + 1) % 4, 1, 0)).collect();
        let open = |segments: &[Segment]| {
            let borders = Borders::new(segments);
            let cdt = Cdt::new(&points, &borders.segments).unwrap();
            cdt.label(&borders).unwrap().open
        };
        assert!(open(&ring).is_empty());
        assert_eq!(open(&ring[..3]), [(1, 3)]);
    }
}
