//! A seam that passes along edges of the body rather than beside them.

use super::seam::Graph;
use glam::DVec3;
use tmesh::Triangle;

/// How much an edge has to rise over its length, the sine of ten degrees: less steep, a seam along it meets the faces that it ends at
/// below the smallest dihedral angle that elements are asked for by default. Noise of what is drawn level rises by next to nothing, and
/// a seam would turn at once there.
const LEAST_RISE: f64 = 0.173_6;

/// Edges of a surface in the canonical frame.
pub struct Rails<'a> {
    points: &'a [DVec3],
    /// Heights within this are one, model units.
    equal: f64,
    /// Ends of edges that rise steeply enough, the lower one first, in the order of its height.
    rising: Vec<[u32; 2]>,
}

/// The way upward along edges that ends at a point and comes from farthest below.
#[derive(Clone, Copy)]
struct Way {
    /// Height of its first point, model units.
    from: f64,
    /// By how much its points are turned against the graph, and from one to the next, in all, radians.
    turned: f64,
    before: Option<u32>,
}

impl<'a> Rails<'a> {
    /// The edges of triangles; heights within `equal` (model units) are one.
    pub fn new(points: &'a [DVec3], triangles: &[Triangle], equal: f64) -> Self {
        let height = |v: u32| points[v as usize].z;
        let rises = |&[a, b]: &[u32; 2]| {
            let rise = height(b) - height(a);
            rise > equal && rise >= LEAST_RISE * points[a as usize].distance(points[b as usize])
        };
        let sides = triangles.iter().flat_map(|t| {
            let [a, b, c] = t.vertices;
            [[a, b], [b, c], [c, a]]
        });
        // Each edge is there in both directions.
        let mut rising: Vec<[u32; 2]> = sides.filter(rises).collect();
        rising.sort_unstable_by(|p, q| height(p[0]).total_cmp(&height(q[0])).then(p.cmp(q)));
        Self {
            points,
            equal,
            rising,
        }
    }

    /// A graph bent so that it passes through the way upward along edges no farther beside it than `reach` (radians) that rises
    /// most, of several the one that it is bent by least. Its images are `opening` (radians) apart. `None`
    /// where there are no such edges.
    ///
    /// Along blades that are drawn level by level no face is cut then.
    pub fn bend(&self, graph: &Graph, [opening, reach]: [f64; 2]) -> Option<Graph> {
        let beside = |p: &DVec3| {
            let straight = graph.straighten(*p);
            let angle = libm::atan2(straight.y, straight.x);
            angle - opening * (angle / opening).round()
        };
        let by: Vec<f64> = self.points.iter().map(beside).collect();
        let height = |v: u32| self.points[v as usize].z;
        let is_near = |v: &u32| by[*v as usize].abs() <= reach;
        let start = |v: u32| Way {
            from: height(v),
            turned: by[v as usize].abs(),
            before: None,
        };
        let mut ways: Vec<Way> = (0..self.points.len() as u32).map(start).collect();
        for &[low, high] in self.rising.iter().filter(|e| e.iter().all(is_near)) {
            let way = ways[low as usize];
            let known = &mut ways[high as usize];
            let turned = way.turned + (by[high as usize] - by[low as usize]).abs();
            let is_longer = way.from < known.from - self.equal;
            if is_longer || way.from <= known.from + self.equal && turned < known.turned {
                *known = Way {
                    turned,
                    before: Some(low),
                    ..way
                };
            }
        }
        let rise = |v: &u32| height(*v) - ways[*v as usize].from;
        let ends = (0..self.points.len() as u32).filter(|v| ways[*v as usize].before.is_some());
        let last = ends.reduce(|best, v| {
            let [old, new] = [best, v].map(|v| rise(&v));
            let less = ways[v as usize].turned < ways[best as usize].turned;
            let is_better = new > old + self.equal || new >= old - self.equal && less;
            if is_better { v } else { best }
        })?;
        let way = std::iter::successors(Some(last), |v| ways[*v as usize].before);
        let mut knots: Vec<(f64, f64)> = way.map(|v| (height(v), by[v as usize])).collect();
        knots.reverse();
        graph.shifted(&knots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::OUTSIDE;

    #[test]
    fn a_graph_is_bent_to_the_edges_beside_it() {
        // Two strips of edges that rise, at 10 degrees and, up to half of the height, at 2 degrees.
        let at = |degrees: f64, z: f64| {
            let a = degrees.to_radians();
            DVec3::new(a.cos(), a.sin(), z)
        };
        let points = [
            at(10.0, 0.0),
            at(10.0, 1.0),
            at(10.0, 2.0),
            at(2.0, 0.0),
            at(2.0, 1.0),
        ];
        let triangle = |vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        };
        let triangles = [[0, 1, 4], [1, 2, 4], [0, 3, 4]].map(triangle);
        let rails = Rails::new(&points, &triangles, 1e-9);
        let flat = Graph::new(vec![0.5], vec![0.0], vec![0.0]);
        let opening = 0.5;
        let bent = rails.bend(&flat, [opening, 12.0_f64.to_radians()]).unwrap();
        // From 2 degrees to the top, or from 10: the way at 10 is as high and turns as little, and comes first.
        let angles = [0.0, 1.0, 2.0].map(|z| bent.angle(1.0, z).to_degrees());
        assert!(angles.iter().all(|a| (a - 10.0).abs() < 1e-9), "{angles:?}");
        // Where that is out of reach the other one is taken, as far as it goes.
        let bent = rails.bend(&flat, [opening, 5.0_f64.to_radians()]).unwrap();
        assert!((bent.angle(1.0, 2.0).to_degrees() - 2.0).abs() < 1e-9);
        assert!(rails.bend(&flat, [opening, 1.0_f64.to_radians()]).is_none());
        // What is drawn level rises by noise alone.
        let level = [at(10.0, 0.0), at(8.0, 1e-7), at(6.0, 2e-7)];
        let triangle = triangle([0, 1, 2]);
        let rails = Rails::new(&level, &[triangle], 1e-9);
        assert!(
            rails
                .bend(&flat, [opening, 12.0_f64.to_radians()])
                .is_none()
        );
    }
}
