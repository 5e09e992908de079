//! Triangulation of one flat facet, and its refinement with the outline kept.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation,
};

/// Triangles with smaller angles are improved where the outline allows it, degrees. Insertion of
/// circumcentres ends for any bound below 30.
const MIN_ANGLE: f64 = 27.0;

/// Sine of the turn up to which an outline counts as straight, and by how much it is bowed there, relative
/// to its length.
const STRAIGHT: f64 = 1e-10;
const BOW: f64 = 1e-8;

/// Rounds of removing and inserting points at most.
const ROUNDS: usize = 40;

/// A flat facet in its own plane.
pub struct Patch {
    /// Positions. The ones after `fixed` may be left out.
    pub points: Vec<DVec2>,
    /// Number of points that must stay.
    pub fixed: usize,
    /// Outline and inner edges, as pairs of points; the facet is to the left. Edges with the facet
    /// on both sides are listed in both directions.
    pub outline: Vec<[u32; 2]>,
}

/// What goes wrong in a plane: the point it happens at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Broken(pub u32);

struct Site(Point2<f64>);

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

type Cdt = ConstrainedDelaunayTriangulation<Site>;

/// A triangulation of those points of a patch that are in use.
struct Mesh {
    cdt: Cdt,
    /// Point of each vertex.
    points: Vec<u32>,
    /// Of each face, whether it belongs to the facet.
    inside: Vec<bool>,
}

impl Patch {
    /// Triangles of the facet, counter-clockwise, by constrained Delaunay (crate `spade`, exact
    /// predicates). Points beyond `fixed` that are in the diametral circle of an outline edge are
    /// left out; circumcentres of bad triangles are appended to `points` where they are in none.
    /// (After Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh
    /// generation", 1995, but the outline is never split.)
    pub fn triangulate(&mut self) -> Result<Vec<[u32; 3]>, Broken> {
        let scale = self.scale();
        let edges: FxHashSet<[u32; 2]> = self.outline.iter().copied().collect();
        self.bow(&edges);
        let mut used = vec![true; self.points.len()];
        // Triangles whose circumcentres were inserted in vain.
        let mut hopeless: FxHashSet<[u32; 3]> = FxHashSet::default();
        let mut author: FxHashMap<u32, [u32; 3]> = FxHashMap::default();
        for round in 0..=ROUNDS {
            let mesh = self.mesh(&used, &edges, scale)?;
            let triangles = mesh.triangles();
            if round == ROUNDS {
                return Ok(triangles);
            }
            let removed = self.encroaching(&triangles, &edges);
            if !removed.is_empty() {
                for p in removed {
                    used[p as usize] = false;
                    hopeless.extend(author.get(&p));
                }
                continue;
            }
            let added = self.centres(&mesh, &hopeless, scale);
            if added.is_empty() {
                return Ok(triangles);
            }
            for (triangle, centre) in added {
                author.insert(self.points.len() as u32, triangle);
                self.points.push(centre);
                used.push(true);
            }
        }
        Ok(Vec::new())
    }

    /// Bows straight runs of the outline inwards, by far less than any detail. Points on a straight edge are on
    /// one line up to rounding only, and a triangle of three of them would be the facet on the other
    /// side of the edge as well.
    fn bow(&mut self, edges: &FxHashSet<[u32; 2]>) {
        const NONE: u32 = u32::MAX;
        const MANY: u32 = u32::MAX - 1;
        let mut next = vec![NONE; self.fixed];
        let mut last = vec![NONE; self.fixed];
        for &[a, b] in &self.outline {
            for (slot, v) in [(&mut next[a as usize], b), (&mut last[b as usize], a)] {
                *slot = if *slot == NONE { v } else { MANY };
            }
        }
        let points = &self.points;
        let is_straight = |v: u32| {
            let (a, b) = (last[v as usize], next[v as usize]);
            if a >= MANY || b >= MANY || edges.contains(&[b, v]) || edges.contains(&[v, a]) {
                return false;
            }
            let [a, v, b] = [a, v, b].map(|v| points[v as usize]);
            let (p, q) = (v - a, b - v);
            p.perp_dot(q).abs() <= STRAIGHT * p.length() * q.length() && p.dot(q) > 0.0
        };
        let mut bowed: Vec<(u32, DVec2)> = Vec::new();
        for &[start, first] in &self.outline {
            if is_straight(start) || !is_straight(first) {
                continue;
            }
            let mut run = vec![start, first];
            while is_straight(run[run.len() - 1]) && run.len() <= self.fixed {
                run.push(next[run[run.len() - 1] as usize]);
            }
            let at = |v: u32| points[v as usize];
            let (from, to) = (at(start), at(run[run.len() - 1]));
            let along = to - from;
            for &v in &run[1..run.len() - 1] {
                let s = (at(v) - from).dot(along) / along.length_squared();
                bowed.push((v, along.perp() * (4.0 * BOW * s * (1.0 - s))));
            }
        }
        for (v, by) in bowed {
            self.points[v as usize] += by;
        }
    }

    /// A power of two that brings the coordinates near one, whatever the model's unit.
    fn scale(&self) -> f64 {
        let size = |m: f64, p: &DVec2| m.max(p.abs().max_element());
        let largest = self.points.iter().fold(0.0, size);
        if largest > 0.0 {
            (-largest.log2().floor()).exp2()
        } else {
            1.0
        }
    }

    fn mesh(&self, used: &[bool], edges: &FxHashSet<[u32; 2]>, scale: f64) -> Result<Mesh, Broken> {
        let mut vertex = vec![u32::MAX; self.points.len()];
        let mut points = Vec::new();
        let mut seen: FxHashSet<[u64; 2]> = FxHashSet::default();
        let mut sites = Vec::new();
        for (i, p) in self.points.iter().enumerate().filter(|(i, _)| used[*i]) {
            // What spade refuses to take is zero on the scale of the model.
            let tidy = |x: f64| {
                if (x * scale).abs() < 1e-40 {
                    0.0
                } else {
                    x * scale
                }
            };
            let site = Point2::new(tidy(p.x), tidy(p.y));
            if seen.insert([site.x.to_bits(), site.y.to_bits()]) {
                vertex[i] = points.len() as u32;
                points.push(i as u32);
                sites.push(Site(site));
            } else if i < self.fixed {
                return Err(Broken(i as u32));
            }
        }
        let constraints = self
            .outline
            .iter()
            .filter(|e| e[0] < e[1] || !edges.contains(&[e[1], e[0]]))
            .map(|e| e.map(|v| vertex[v as usize] as usize))
            .collect();
        let mut conflict = None;
        let cdt = Cdt::try_bulk_load_cdt(sites, constraints, |e| {
            conflict.get_or_insert(e[0]);
        })
        .map_err(|_| Broken(0))?;
        if let Some(v) = conflict {
            return Err(Broken(points[v]));
        }
        let mut mesh = Mesh {
            inside: vec![false; cdt.num_all_faces()],
            cdt,
            points,
        };
        mesh.label(edges)?;
        let found = mesh
            .cdt
            .inner_faces()
            .filter(|f| mesh.inside[f.fix().index()]);
        let sides: usize = found
            .map(|f| {
                f.adjacent_edges()
                    .iter()
                    .filter(|e| edges.contains(&mesh.key(**e)))
                    .count()
            })
            .sum();
        // Every edge has the facet to its left.
        if sides != edges.len() {
            return Err(Broken(self.outline[0][0]));
        }
        Ok(mesh)
    }

    /// Points that may go, in the diametral circle of an outline edge.
    fn encroaching(&self, triangles: &[[u32; 3]], edges: &FxHashSet<[u32; 2]>) -> Vec<u32> {
        let mut found = Vec::new();
        for t in triangles {
            for i in 0..3 {
                let [a, b, c] = [t[i], t[(i + 1) % 3], t[(i + 2) % 3]];
                let [p, q, apex] = [a, b, c].map(|v| self.points[v as usize]);
                if c as usize >= self.fixed
                    && edges.contains(&[a, b])
                    && (p - apex).dot(q - apex) <= 0.0
                {
                    found.push(c);
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Circumcentres to insert, worst triangles first, far from each other, each with its triangle.
    fn centres(
        &self,
        mesh: &Mesh,
        hopeless: &FxHashSet<[u32; 3]>,
        scale: f64,
    ) -> Vec<([u32; 3], DVec2)> {
        let limit = 0.5 / libm::sin(MIN_ANGLE.to_radians());
        let mut bad = Vec::new();
        for face in mesh.cdt.inner_faces() {
            if !mesh.inside[face.fix().index()] {
                continue;
            }
            let mut key = mesh.corners(face);
            let [a, b, c] = key.map(|v| self.points[v as usize]);
            let (u, v) = (b - a, c - a);
            let shortest = u
                .length_squared()
                .min(v.length_squared())
                .min((c - b).length_squared());
            let twice = 2.0 * u.perp_dot(v);
            let offset = DVec2::new(
                v.y * u.length_squared() - u.y * v.length_squared(),
                u.x * v.length_squared() - v.x * u.length_squared(),
            ) / twice;
            let ratio = (offset.length_squared() / shortest).sqrt();
            key.sort_unstable();
            if ratio > limit && ratio.is_finite() && !hopeless.contains(&key) {
                bad.push((ratio, key, a + offset));
            }
        }
        bad.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        let mut taken = vec![false; mesh.inside.len()];
        let mut added = Vec::new();
        for (_, key, centre) in bad {
            let place = Point2::new(centre.x * scale, centre.y * scale);
            let PositionInTriangulation::OnFace(face) = mesh.cdt.locate(place) else {
                continue;
            };
            let face = mesh.cdt.face(face);
            let around = face.adjacent_edges().map(|e| e.rev().face().fix().index());
            let index = face.fix().index();
            if !mesh.inside[index] || taken[index] || around.iter().any(|&f| taken[f]) {
                continue;
            }
            taken[index] = true;
            // The outer face has the index 0 and is next to many.
            around
                .iter()
                .filter(|&&f| f != 0)
                .for_each(|&f| taken[f] = true);
            added.push((key, centre));
        }
        added
    }
}

type Edge<'a> = spade::handles::DirectedEdgeHandle<'a, Site, (), spade::CdtEdge<()>, ()>;
type Face<'a> =
    spade::handles::FaceHandle<'a, spade::handles::InnerTag, Site, (), spade::CdtEdge<()>, ()>;

impl Mesh {
    fn key(&self, edge: Edge<'_>) -> [u32; 2] {
        [edge.from(), edge.to()].map(|v| self.points[v.fix().index()])
    }

    fn corners(&self, face: Face<'_>) -> [u32; 3] {
        face.vertices().map(|v| self.points[v.fix().index()])
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        self.cdt
            .inner_faces()
            .filter(|f| self.inside[f.fix().index()])
            .map(|f| self.corners(f))
            .collect()
    }

    /// Spreads from the left sides of the edges until the next edge.
    fn label(&mut self, edges: &FxHashSet<[u32; 2]>) -> Result<(), Broken> {
        let mut inside = vec![false; self.inside.len()];
        let mut open = Vec::new();
        for face in self.cdt.inner_faces() {
            if face
                .adjacent_edges()
                .iter()
                .any(|e| edges.contains(&self.key(*e)))
            {
                inside[face.fix().index()] = true;
                open.push(face);
            }
        }
        while let Some(face) = open.pop() {
            for edge in face.adjacent_edges() {
                let [a, b] = self.key(edge);
                if edges.contains(&[a, b]) {
                    continue;
                }
                // Out through the wrong side of an edge, or of all.
                let next = edge.rev().face().as_inner();
                let (false, Some(next)) = (edges.contains(&[b, a]), next) else {
                    return Err(Broken(a));
                };
                let slot = &mut inside[next.fix().index()];
                if !*slot {
                    *slot = true;
                    open.push(next);
                }
            }
        }
        self.inside = inside;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &mut Vec<DVec2>, outline: &mut Vec<[u32; 2]>, corners: &[DVec2], parts: u32) {
        let first = points.len() as u32;
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            points.extend((0..parts).map(|k| a.lerp(b, f64::from(k) / f64::from(parts))));
        }
        let n = points.len() as u32 - first;
        outline.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
    }

    #[test]
    fn square_with_a_hole() {
        let square = |h: f64| [(-h, -h), (h, -h), (h, h), (-h, h)].map(|(x, y)| DVec2::new(x, y));
        let (mut points, mut outline) = (Vec::new(), Vec::new());
        ring(&mut points, &mut outline, &square(1.0), 5);
        let mut hole = square(0.1);
        hole.reverse();
        ring(&mut points, &mut outline, &hole, 1);
        let fixed = points.len();
        // In the diametral circle of an outline edge.
        points.push(DVec2::new(0.0, -0.99));
        let given = points.clone();
        let mut patch = Patch {
            points,
            fixed,
            outline,
        };
        let triangles = patch.triangulate().unwrap();
        assert!(patch.points.len() > fixed + 1);
        // What is bowed inwards for the triangulation is as given again.
        patch.points[..fixed].copy_from_slice(&given[..fixed]);
        let mut area = 0.0;
        for t in &triangles {
            assert!(!t.contains(&(fixed as u32)));
            let [a, b, c] = t.map(|v| patch.points[v as usize]);
            let twice = (b - a).perp_dot(c - a);
            assert!(twice > 0.0);
            area += 0.5 * twice;
            let sides = [a.distance(b), b.distance(c), c.distance(a)];
            let product: f64 = sides.iter().product();
            let least = sides.iter().fold(f64::MAX, |m, &x| m.min(x));
            assert!(product / (2.0 * twice) / least < 1.3);
        }
        assert!((area - 3.96).abs() < 1e-12);
    }

    #[test]
    fn points_on_a_straight_edge_make_no_triangle() {
        // A square whose sides are divided, in a frame where nothing is exactly straight.
        let turn = DVec2::from_angle(0.3);
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let corners = corners.map(|(x, y)| turn.rotate(DVec2::new(7.0 + x, y)));
        let (mut points, mut outline) = (Vec::new(), Vec::new());
        ring(&mut points, &mut outline, &corners, 23);
        let fixed = points.len();
        let mut patch = Patch {
            points,
            fixed,
            outline,
        };
        let triangles = patch.triangulate().unwrap();
        // Points come side by side, each with its first corner.
        let on = |i: u32, k: u32| {
            let ends_there = i.is_multiple_of(23) && (i / 23 + 3) % 4 == k;
            (i as usize) < fixed && (i / 23 == k || ends_there)
        };
        for t in &triangles {
            for k in 0..4 {
                assert!(!t.iter().all(|&i| on(i, k)), "{t:?}");
            }
        }
        assert!(triangles.len() > 90);
    }

    #[test]
    fn crossing_outlines_are_refused() {
        let mut patch = Patch {
            points: [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]
                .map(|(x, y)| DVec2::new(x, y))
                .to_vec(),
            fixed: 4,
            outline: vec![[0, 1], [1, 2], [2, 3], [3, 0]],
        };
        assert!(patch.triangulate().is_err());
    }
}
