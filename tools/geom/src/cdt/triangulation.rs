//! The triangulation as arrays.

use super::order::{SWEPT, insertion_order};
use crate::points::weld::Welder;
use crate::rounding::power_of_two;
use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, InsertionError, Point2, PositionInTriangulation,
    Triangulation,
};
use thiserror::Error;

/// No triangle: the outside of the convex hull.
pub const NONE: u32 = u32::MAX;

/// Why points and segments could not be triangulated. Points are given by index, which says the place.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CdtError {
    /// Two points have the same position.
    #[error("points {0} and {1} coincide")]
    Coincident(u32, u32),
    /// A coordinate is outside of what the triangulation can represent.
    #[error("a coordinate cannot be represented")]
    Coordinate,
    /// A segment, given by its ends, crosses another one, or passes through a point where that matters.
    #[error("the edge between points {0} and {1} crosses another one or passes through a point")]
    Crossing(u32, u32),
    /// The segments around one region disagree on its label.
    #[error("the edges of a face claim the labels {labels:?} for it, near point {near}")]
    Ambiguous {
        /// Two of the labels.
        labels: [u32; 2],
        /// A point of the region.
        near: u32,
    },
}

struct Site {
    place: Point2<f64>,
    /// Index of the point; spade numbers sites in an order of its own.
    index: u32,
}

impl From<Point2<f64>> for Site {
    /// A new point, which has no index.
    fn from(place: Point2<f64>) -> Self {
        Self { place, index: NONE }
    }
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

/// A constrained Delaunay triangulation of the convex hull of points.
pub struct Cdt {
    /// Point indices of each triangle, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle beyond the side that runs from corner `i` to the next, or [`NONE`].
    pub across: Vec<[u32; 3]>,
    /// Whether that side is a segment or a part of one.
    pub is_segment: Vec<[bool; 3]>,
    inner: ConstrainedDelaunayTriangulation<Site>,
    /// spade's vertex of each point.
    vertices: Vec<FixedVertexHandle>,
    /// A power of two that brings the coordinates near one, whatever the model's unit.
    scale: f64,
}

/// Triangulates points one by one.
fn inserted(
    sites: &[Point2<f64>],
) -> Result<ConstrainedDelaunayTriangulation<Site>, InsertionError> {
    let mut inner = ConstrainedDelaunayTriangulation::new();
    for index in insertion_order(sites) {
        let place = sites[index as usize];
        inner.insert(Site { place, index })?;
    }
    Ok(inner)
}

impl Cdt {
    /// Triangulates points with the given segments, pairs of point indices. A segment that passes through a point
    /// is divided there.
    ///
    /// # Errors
    /// Coincident points, segments that cross, coordinates that are not finite.
    pub fn new(points: &[[f64; 2]], segments: &[[u32; 2]]) -> Result<Self, CdtError> {
        let largest = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        if !largest.is_finite() {
            return Err(CdtError::Coordinate);
        }
        let scale = power_of_two(largest).recip();
        let sites: Vec<Point2<f64>> = points.iter().map(|&p| site(p, scale)).collect();
        let mut welder = Welder::new(sites.len());
        for (i, p) in (0..).zip(&sites) {
            // Numbers of points and their indices are the same as long as no two are welded.
            if let (first, false) = welder.add([p.x, p.y]) {
                return Err(CdtError::Coincident(first, i));
            }
        }
        // Points first, segments after them: where both are given at once, spade takes what it left for later in the
        // order of a hash table, which is another one in every run.
        let inner = match sites.len() <= SWEPT {
            true => {
                let sites = (0..).zip(sites).map(|(index, place)| Site { place, index });
                ConstrainedDelaunayTriangulation::bulk_load(sites.collect())
            }
            false => inserted(&sites),
        };
        let mut inner = inner.map_err(|_| CdtError::Coordinate)?;
        let mut vertices = vec![FixedVertexHandle::from_index(0); points.len()];
        for vertex in inner.vertices() {
            vertices[vertex.data().index as usize] = vertex.fix();
        }
        for &ends in segments {
            let [a, b] = ends.map(|v| vertices[v as usize]);
            if inner.try_add_constraint(a, b).is_empty() {
                return Err(CdtError::Crossing(ends[0], ends[1]));
            }
        }
        Ok(Self::from_spade(inner, vertices, scale))
    }

    fn from_spade(
        inner: ConstrainedDelaunayTriangulation<Site>,
        vertices: Vec<FixedVertexHandle>,
        scale: f64,
    ) -> Self {
        let count = inner.num_inner_faces();
        let mut cdt = Self {
            triangles: Vec::with_capacity(count),
            across: Vec::with_capacity(count),
            is_segment: Vec::with_capacity(count),
            inner,
            vertices,
            scale,
        };
        for face in cdt.inner.inner_faces() {
            // Sides in the order of the corners that they begin at.
            let sides = face.adjacent_edges();
            cdt.triangles.push(sides.map(|e| e.from().data().index));
            cdt.across.push(sides.map(|e| {
                let beyond = e.rev().face().as_inner();
                beyond.map_or(NONE, |f| number(f.fix().index()))
            }));
            cdt.is_segment.push(sides.map(|e| e.is_constraint_edge()));
        }
        cdt
    }

    /// Whether two points are joined by a segment or a part of one.
    pub fn has_segment(&self, ends: [u32; 2]) -> bool {
        let [a, b] = ends.map(|v| self.vertices[v as usize]);
        self.inner.exists_constraint(a, b)
    }

    /// The triangle that a place is in the interior of; `None` on sides, points and outside.
    pub fn containing(&self, place: [f64; 2]) -> Option<u32> {
        match self.inner.locate(site(place, self.scale)) {
            PositionInTriangulation::OnFace(face) => Some(number(face.index())),
            _ => None,
        }
    }

    /// A triangle that a place is in or on the border of, where no segment passes through the place.
    pub fn beside(&self, place: [f64; 2]) -> Option<u32> {
        let face = match self.inner.locate(site(place, self.scale)) {
            PositionInTriangulation::OnFace(face) => Some(self.inner.face(face)),
            PositionInTriangulation::OnEdge(edge) => {
                let edge = self.inner.directed_edge(edge);
                (!edge.is_constraint_edge()).then(|| edge.face().as_inner())?
            }
            PositionInTriangulation::OnVertex(vertex) => {
                let vertex = self.inner.vertex(vertex);
                if vertex.out_edges().any(|e| e.is_constraint_edge()) {
                    return None;
                }
                vertex.out_edges().find_map(|e| e.face().as_inner())
            }
            _ => None,
        };
        face.map(|f| number(f.fix().index()))
    }
}

/// Number of an inner face: spade's face 0 is the outer one.
fn number(face: usize) -> u32 {
    face as u32 - 1
}

/// Coordinates in the range that spade takes; what underflows is zero on the scale of the model.
fn site(p: [f64; 2], scale: f64) -> Point2<f64> {
    let [x, y] = p.map(|x| x * scale);
    spade::mitigate_underflow(Point2::new(x, y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_points_are_triangulated_as_few_are() {
        // More towards a corner, without four on a circle.
        let mut state = 1_u64;
        let mut random = || {
            state = super::super::order::next(state);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        points.extend((0..2 * SWEPT).map(|_| [random().powi(3), random().powi(3)]));
        let sites: Vec<Point2<f64>> = points.iter().map(|&p| site(p, 1.0)).collect();
        let swept = (0..)
            .zip(&sites)
            .map(|(index, &place)| Site { place, index });
        let swept = ConstrainedDelaunayTriangulation::<Site>::bulk_load(swept.collect()).unwrap();
        let all = |inner: &ConstrainedDelaunayTriangulation<Site>| {
            let faces = inner.inner_faces();
            let mut list: Vec<[u32; 3]> = faces
                .map(|f| {
                    let mut corners = f.vertices().map(|v| v.data().index);
                    corners.sort_unstable();
                    corners
                })
                .collect();
            list.sort_unstable();
            list
        };
        assert!(all(&inserted(&sites).unwrap()) == all(&swept));
        let cdt = Cdt::new(&points, &[[0, 2], [0, 1]]).unwrap();
        assert!(cdt.has_segment([2, 0]) && cdt.triangles.len() == 2 * points.len() - 6);
    }

    #[test]
    fn sides_and_neighbours_fit() {
        let points = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.9, 0.4]];
        let cdt = Cdt::new(&points, &[[0, 2]]).unwrap();
        assert!(cdt.has_segment([2, 0]) && !cdt.has_segment([0, 1]));
        for (t, corners) in cdt.triangles.iter().enumerate() {
            for i in 0..3 {
                let ends = [corners[i], corners[(i + 1) % 3]];
                assert_eq!(cdt.is_segment[t][i], cdt.has_segment(ends));
                let beyond = cdt.across[t][i];
                if beyond != NONE {
                    let other = cdt.triangles[beyond as usize];
                    let back = (0..3).find(|&j| cdt.across[beyond as usize][j] == t as u32);
                    let j = back.unwrap();
                    assert_eq!([other[(j + 1) % 3], other[j]], ends);
                }
            }
            let centre =
                [0, 1].map(|k| corners.iter().map(|&v| points[v as usize][k]).sum::<f64>() / 3.0);
            assert_eq!(cdt.containing(centre), Some(t as u32));
        }
        assert_eq!(cdt.containing([3.0, 3.0]), None);
        assert_eq!(cdt.beside([1.0, 0.5]), None);
    }

    #[test]
    fn equal_points_and_crossing_segments_are_refused() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let crossing = Cdt::new(&square, &[[0, 2], [1, 3]]);
        assert!(matches!(crossing, Err(CdtError::Crossing(..))));
        let twice = [square.as_slice(), &[[-0.0, 0.0]]].concat();
        let twice = Cdt::new(&twice, &[]).err();
        assert_eq!(twice, Some(CdtError::Coincident(0, 4)));
        let infinite = Cdt::new(&[[0.0, f64::INFINITY], [1.0, 0.0], [0.0, 0.0]], &[]).err();
        assert_eq!(infinite, Some(CdtError::Coordinate));
    }
}
