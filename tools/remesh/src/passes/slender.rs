//! What narrow facets cost.

use crate::mesh::NONE;
use geom::edges::Edges;
use geom::measure::triangle_area;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Corners of facets, by facet and vertex, with their angles in degrees. Triangles without vertices are none.
pub fn corners_of_facets(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    facets: &[u32],
) -> FxHashMap<(u32, u32), f64> {
    let mut angles: FxHashMap<(u32, u32), f64> = FxHashMap::default();
    let there = triangles.iter().zip(facets).filter(|t| t.0[0] != NONE);
    for (corners, &facet) in there {
        let points = corners.map(|v| points[v as usize]);
        for i in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|k| points[(i + k) % 3]);
            let angle = (q - p).angle_between(r - p).to_degrees();
            *angles.entry((facet, corners[i])).or_default() += angle;
        }
    }
    angles
}

/// What narrow facets cost, all of them together.
pub fn slenderness(points: &[DVec3], triangles: &[[u32; 3]], facets: &[u32]) -> f64 {
    by_facet(points, triangles, facets).into_iter().sum()
}

/// What each narrow facet costs: elements as wide as it is, along all of its border. The square
/// of the perimeter over the area, which for a strip is four times its length over its width, and over all its corners
/// two over the angle, as often elements fit along both sides of a corner while its width doubles: facets may be narrow
/// only where they end. Triangles without vertices are none.
pub fn by_facet(points: &[DVec3], triangles: &[[u32; 3]], facets: &[u32]) -> Vec<f64> {
    let corners = corners_of_facets(points, triangles, facets);
    let there = triangles.iter().zip(facets).filter(|t| t.0[0] != NONE);
    let (there, facets): (Vec<[u32; 3]>, Vec<u32>) = there.map(|(t, f)| (*t, *f)).unzip();
    let count = facets.iter().max().map_or(0, |most| *most as usize + 1);
    let mut costs = vec![0.0; count];
    for ((facet, _), angle) in corners {
        // As sharp as rounding may leave a corner.
        costs[facet as usize] += 2.0 / angle.to_radians().max(f64::EPSILON);
    }
    let mut measures = vec![(0.0, 0.0); count];
    for (corners, &facet) in there.iter().zip(&facets) {
        let [a, b, c] = corners.map(|v| points[v as usize]);
        measures[facet as usize].1 += triangle_area(a, b, c);
    }
    let edges = Edges::new(&there);
    for (edge, ends) in edges.ends.iter().enumerate() {
        let around = edges.around(edge).iter();
        let around: Vec<u32> = around.map(|u| facets[u.triangle as usize]).collect();
        if matches!(around[..], [f, g] if f == g) {
            continue;
        }
        let [a, b] = ends.map(|v| points[v as usize]);
        let length = a.distance(b);
        around
            .iter()
            .for_each(|&f| measures[f as usize].0 += length);
    }
    for (cost, (perimeter, area)) in costs.iter_mut().zip(measures) {
        if area > 0.0 {
            *cost += perimeter * perimeter / area;
        }
    }
    costs
}
