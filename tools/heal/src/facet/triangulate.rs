//! Triangulation of a planar facet: polygons, loose segments and hole points.

use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation,
};
use std::collections::HashMap;

type Cdt = ConstrainedDelaunayTriangulation<Site>;

struct Site(Point2<f64>);

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

/// Why a facet could not be triangulated. Points are given by index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FacetError {
    /// Two points have the same position in the facet's plane.
    Coincident(u32, u32),
    /// A segment crosses another one.
    Crossing(u32, u32),
    /// A coordinate cannot be represented.
    Coordinate,
}

/// Triangles of the part of the plane that `segments` enclose, counter-clockwise, without the parts
/// around `holes`: what can be reached from infinity or from a hole without crossing a segment is
/// left out. No points are added.
///
/// Constrained Delaunay triangulation (crate `spade`, exact predicates).
///
/// # Errors
/// Crossing segments, coincident points.
pub fn triangulate(
    points: &[[f64; 2]],
    segments: &[[u32; 2]],
    holes: &[[f64; 2]],
) -> Result<Vec<[u32; 3]>, FacetError> {
    if points.len() < 3 {
        return Ok(Vec::new());
    }
    // Normal range whatever the model's unit: an exact power of two.
    let largest = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scale = if largest > 0.0 {
        (-largest.log2().floor()).clamp(-1000.0, 1000.0).exp2()
    } else {
        1.0
    };
    let site = |p: &[f64; 2]| {
        let [x, y] = p.map(|x| x * scale);
        spade::mitigate_underflow(Point2::new(x, y))
    };
    let sites: Vec<Point2<f64>> = points.iter().map(site).collect();
    if let Some((a, b)) = coincident(&sites) {
        return Err(FacetError::Coincident(a, b));
    }
    let edges = segments.iter().map(|s| s.map(|v| v as usize)).collect();
    let mut crossing = None;
    let cdt = Cdt::try_bulk_load_cdt(sites.into_iter().map(Site).collect(), edges, |e| {
        crossing.get_or_insert(e);
    })
    .map_err(|_| FacetError::Coordinate)?;
    if let Some([a, b]) = crossing {
        return Err(FacetError::Crossing(a as u32, b as u32));
    }
    let mut out = vec![false; cdt.num_all_faces()];
    let mut stack = vec![cdt.outer_face().fix().index()];
    out[stack[0]] = true;
    let around = neighbours(&cdt);
    for hole in holes {
        let face = match cdt.locate(site(hole)) {
            PositionInTriangulation::OnFace(face) => Some(face.index()),
            // A point on an edge of the triangulation, which often is the middle of a facet.
            PositionInTriangulation::OnEdge(edge) => {
                let edge = cdt.directed_edge(edge);
                if edge.is_constraint_edge() {
                    continue;
                }
                Some(edge.face().fix().index())
            }
            PositionInTriangulation::OnVertex(vertex) => {
                let vertex = cdt.vertex(vertex);
                if vertex.out_edges().any(|e| e.is_constraint_edge()) {
                    continue;
                }
                vertex.out_edges().next().map(|e| e.face().fix().index())
            }
            _ => continue,
        };
        if let Some(face) = face
            && !out[face]
        {
            out[face] = true;
            stack.push(face);
        }
    }
    while let Some(face) = stack.pop() {
        for &next in &around[face] {
            if !out[next] {
                out[next] = true;
                stack.push(next);
            }
        }
    }
    Ok(cdt
        .inner_faces()
        .filter(|f| !out[f.fix().index()])
        .map(|f| f.vertices().map(|v| v.fix().index() as u32))
        .collect())
}

/// Faces that each face touches across edges that are no segments.
fn neighbours(cdt: &Cdt) -> Vec<Vec<usize>> {
    let mut around = vec![Vec::new(); cdt.num_all_faces()];
    for edge in cdt.undirected_edges() {
        if !edge.is_constraint_edge() {
            let [a, b] =
                [edge.as_directed(), edge.as_directed().rev()].map(|e| e.face().fix().index());
            around[a].push(b);
            around[b].push(a);
        }
    }
    around
}

fn coincident(sites: &[Point2<f64>]) -> Option<(u32, u32)> {
    let mut seen = HashMap::with_capacity(sites.len());
    sites.iter().enumerate().find_map(|(i, p)| {
        // Adding zero makes -0.0 and 0.0 the same.
        let key = [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
        seen.insert(key, i as u32).map(|first| (first, i as u32))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(low: f64, high: f64) -> [[f64; 2]; 4] {
        [[low, low], [high, low], [high, high], [low, high]]
    }

    fn area(points: &[[f64; 2]], triangles: &[[u32; 3]]) -> f64 {
        triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| points[v as usize]);
                0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
            })
            .sum()
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
        let full = triangulate(&points, &LOOPS, &[]).unwrap();
        assert_eq!(area(&points, &full), 16.0);
        for hole in [[2.0, 2.25], [2.0, 2.0]] {
            let pierced = triangulate(&points, &LOOPS, &[hole]).unwrap();
            assert_eq!(area(&points, &pierced), 12.0);
        }
    }

    #[test]
    fn an_open_chain_encloses_nothing_and_a_crossing_is_an_error() {
        let points = ring(0.0, 1.0);
        let chain = [[0, 1], [1, 2], [2, 3]];
        assert_eq!(triangulate(&points, &chain, &[]), Ok(Vec::new()));
        let crossing = [[0, 2], [1, 3]];
        assert!(matches!(
            triangulate(&points, &crossing, &[]),
            Err(FacetError::Crossing(..))
        ));
        let twice = [points.as_slice(), &[[-0.0, 0.0]]].concat();
        assert_eq!(
            triangulate(&twice, &chain, &[]),
            Err(FacetError::Coincident(0, 4))
        );
    }

    #[test]
    fn any_scale_will_do() {
        for scale in [1e-200, 1e-6, 1e200] {
            let points = ring(0.0, 4.0).map(|p| p.map(|x| x * scale));
            let square = triangulate(&points, &LOOPS[..4], &[]).unwrap();
            assert_eq!(square.len(), 2);
        }
    }
}
