//! Triangulation of a planar subdivision whose edges know what lies on either side.

use rustc_hash::FxHashMap;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};
use thiserror::Error;

/// An edge of the subdivision between two points, by index.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Start and end.
    pub ends: [u32; 2],
    /// Label of the face to the left, walking from start to end; `None` leaves it open.
    pub left: Option<u32>,
    /// Label of the face to the right.
    pub right: Option<u32>,
}

/// Why a subdivision could not be triangulated. Points are given by index.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlanarError {
    /// Two points have the same position.
    #[error("points {0} and {1} coincide")]
    Coincident(u32, u32),
    /// A coordinate is outside of what the triangulation can represent.
    #[error("a coordinate cannot be represented")]
    Coordinate,
    /// An edge crosses another one or passes through a point.
    #[error("the edge between points {0} and {1} crosses another one or passes through a point")]
    Crossing(u32, u32),
    /// The edges of one face disagree on its label.
    #[error("the edges of a face claim the labels {labels:?} for it, near point {near}")]
    Ambiguous {
        /// Two of the labels.
        labels: [u32; 2],
        /// A point of the face.
        near: u32,
    },
}

struct Site(Point2<f64>);

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

/// Triangles of a subdivision with the label of the face they lie in, counter-clockwise, points by
/// index. Faces labelled `outside` and faces that no edge labels are left out.
///
/// Constrained Delaunay triangulation (crate `spade`, exact predicates); labels spread through
/// edges that are no segments or leave both sides open.
///
/// # Errors
/// Crossing segments, coincident points, contradicting labels.
pub fn triangulate(
    points: &[[f64; 2]],
    segments: &[Segment],
    outside: u32,
) -> Result<Vec<([u32; 3], u32)>, PlanarError> {
    if points.len() < 3 {
        return Ok(Vec::new());
    }
    if let Some((a, b)) = coincident(points) {
        return Err(PlanarError::Coincident(a, b));
    }
    // Normal range whatever the model's unit: an exact power of two.
    let largest = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scale = if largest > 0.0 {
        (-largest.log2().floor()).exp2()
    } else {
        1.0
    };
    // Below this, spade refuses coordinates; such a number is zero on the scale of the model.
    let tidy = |x: f64| {
        if (x * scale).abs() < 1e-40 {
            0.0
        } else {
            x * scale
        }
    };
    let sites = points
        .iter()
        .map(|p| Site(Point2::new(tidy(p[0]), tidy(p[1]))))
        .collect();
    let edges = segments
        .iter()
        .map(|s| s.ends.map(|v| v as usize))
        .collect();
    let mut conflict = None;
    let cdt = ConstrainedDelaunayTriangulation::<Site>::try_bulk_load_cdt(sites, edges, |e| {
        conflict.get_or_insert(e);
    })
    .map_err(|_| PlanarError::Coordinate)?;
    if let Some([a, b]) = conflict {
        return Err(PlanarError::Crossing(a as u32, b as u32));
    }
    let mut labels: FxHashMap<[u32; 2], (Option<u32>, bool)> = FxHashMap::default();
    for s in segments {
        let [a, b] = s.ends;
        let present = cdt
            .get_edge_from_neighbors(handle(a), handle(b))
            .is_some_and(|e| e.is_constraint_edge());
        if !present {
            return Err(PlanarError::Crossing(a, b));
        }
        let open = s.left.is_none() && s.right.is_none();
        labels.insert([a, b], (s.left, open));
        labels.insert([b, a], (s.right, open));
    }
    let faces: Vec<_> = cdt.inner_faces().collect();
    let mut label: Vec<Option<u32>> = vec![None; faces.len() + 1];
    let mut stack = Vec::new();
    // Seed every face at a labelled edge, then spread.
    for face in &faces {
        for edge in face.adjacent_edges() {
            let key = [edge.from(), edge.to()].map(|v| v.fix().index() as u32);
            if let Some((Some(l), _)) = labels.get(&key) {
                claim(&mut label[face.fix().index()], *l, key[0])?;
            }
        }
        if label[face.fix().index()].is_some() {
            stack.push(*face);
        }
    }
    while let Some(face) = stack.pop() {
        let Some(own) = label[face.fix().index()] else {
            continue;
        };
        for edge in face.adjacent_edges() {
            let key = [edge.from(), edge.to()].map(|v| v.fix().index() as u32);
            if labels.get(&key).is_some_and(|(_, open)| !open) {
                continue;
            }
            let Some(next) = edge.rev().face().as_inner() else {
                continue;
            };
            let slot = &mut label[next.fix().index()];
            let fresh = slot.is_none();
            claim(slot, own, key[0])?;
            if fresh {
                stack.push(next);
            }
        }
    }
    let mut triangles = Vec::with_capacity(faces.len());
    for face in &faces {
        if let Some(l) = label[face.fix().index()].filter(|&l| l != outside) {
            triangles.push((face.vertices().map(|v| v.fix().index() as u32), l));
        }
    }
    Ok(triangles)
}

fn handle(index: u32) -> spade::handles::FixedVertexHandle {
    spade::handles::FixedVertexHandle::from_index(index as usize)
}

fn claim(slot: &mut Option<u32>, label: u32, near: u32) -> Result<(), PlanarError> {
    match *slot {
        Some(other) if other != label => Err(PlanarError::Ambiguous {
            labels: [other, label],
            near,
        }),
        _ => {
            *slot = Some(label);
            Ok(())
        }
    }
}

fn coincident(points: &[[f64; 2]]) -> Option<(u32, u32)> {
    let mut seen: FxHashMap<[u64; 2], u32> = FxHashMap::default();
    for (i, p) in points.iter().enumerate() {
        // Adding zero folds the two zeros into one.
        if let Some(other) = seen.insert(p.map(|x| (x + 0.0).to_bits()), i as u32) {
            return Some((other, i as u32));
        }
    }
    None
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
            Err(PlanarError::Crossing(..))
        ));
        let round = [
            segment(0, 1, 1, 0),
            segment(1, 2, 2, 0),
            segment(2, 3, 1, 0),
            segment(3, 0, 1, 0),
        ];
        assert!(matches!(
            triangulate(&points, &round, 0),
            Err(PlanarError::Ambiguous { .. })
        ));
        let through = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
        assert!(matches!(
            triangulate(&through, &[segment(0, 2, 1, 0)], 0),
            Err(PlanarError::Crossing(0, 2))
        ));
    }
}
