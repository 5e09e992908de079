//! Triangulation of one flat facet, and its refinement with the outline kept.

use super::{Borders, Cdt, CdtError, NONE, Segment};
use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

/// Triangles with smaller angles are improved where the outline allows it, degrees. Insertion of
/// circumcentres ends for any bound below 30, and takes many more points close to it. Measured with `tetwedge` on bodies of `body`
/// without mirrors: with 21 degrees, where a triangle has the radius-edge ratio that is asked of tetrahedra by default, there are up
/// to 12 % fewer elements, but the first percentile of the angles of twisted bodies falls by a degree.
const MIN_ANGLE: f64 = 27.0;

/// A flat facet in its own plane.
pub struct Patch {
    /// Positions. The ones after `fixed` may be left out.
    pub points: Vec<DVec2>,
    /// Number of points that must stay.
    pub fixed: usize,
    /// Outline and inner edges, as pairs of points; the facet is to the left. Edges with the facet
    /// on both sides are listed in both directions.
    pub outline: Vec<[u32; 2]>,
    /// A point that is no farther from the line between its neighbours is on it.
    pub rounding: f64,
    /// Circumradius above which triangles get points, too.
    pub largest: f64,
}

/// What goes wrong in a plane: the point it happens at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Broken(pub u32);

/// Labels of the two sides of the outline.
const OUTSIDE: u32 = 0;
const FACET: u32 = 1;

/// A triangulation of those points of a patch that are in use.
struct Mesh {
    cdt: Cdt,
    /// Point of each vertex.
    points: Vec<u32>,
    /// Of each face, whether it belongs to the facet.
    inside: Vec<bool>,
}

impl Patch {
    /// Triangles of the facet, counter-clockwise, by constrained Delaunay triangulation. Points beyond `fixed` that are in the diametral circle of an outline edge are
    /// left out; circumcentres of bad triangles are appended to `points` where they are in none.
    /// (After Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh
    /// generation", 1995, but the outline is never split.)
    pub fn triangulate(&mut self) -> Result<Vec<[u32; 3]>, Broken> {
        let edges: FxHashSet<[u32; 2]> = self.outline.iter().copied().collect();
        let borders = self.borders(&edges);
        self.bow(&edges);
        let mut used = vec![true; self.points.len()];
        // Triangles whose circumcentres were inserted in vain.
        let mut hopeless: FxHashSet<[u32; 3]> = FxHashSet::default();
        let mut author: FxHashMap<u32, [u32; 3]> = FxHashMap::default();
        // Each round inserts one point for every few triangles that are bad, so that their number halves about every
        // round; what is left when no bit of it can be is outlines that allow nothing better.
        for round in 0..=usize::BITS {
            let mesh = self.mesh(&used, &borders, &edges)?;
            let triangles = mesh.triangles();
            if round == usize::BITS {
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
            let added = self.centres(&mesh, &hopeless);
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

    /// Bows straight runs of the outline inwards, by the geometric mean of their length and of what rounding makes of it, so
    /// that the triangulation sees the bow and nobody else. Points on a straight edge are on one line up to rounding
    /// only, and a triangle of three of them would be the facet on the other side of the edge as well.
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
            p.perp_dot(q).abs() <= self.rounding * (p + q).length() && p.dot(q) > 0.0
        };
        let bow = f64::EPSILON.sqrt();
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
                bowed.push((v, along.perp() * (4.0 * bow * s * (1.0 - s))));
            }
        }
        for (v, by) in bowed {
            self.points[v as usize] += by;
        }
    }

    /// The outline, with what lies on either side. Points that must stay have the same numbers in every
    /// triangulation.
    fn borders(&self, edges: &FxHashSet<[u32; 2]>) -> Borders {
        let both = |e: &[u32; 2]| edges.contains(&[e[1], e[0]]);
        let once = self.outline.iter().filter(|e| e[0] < e[1] || !both(e));
        let segments: Vec<Segment> = once
            .map(|e| Segment {
                ends: *e,
                left: Some(FACET),
                right: Some(if both(e) { FACET } else { OUTSIDE }),
            })
            .collect();
        Borders::new(&segments)
    }

    fn mesh(
        &self,
        used: &[bool],
        borders: &Borders,
        edges: &FxHashSet<[u32; 2]>,
    ) -> Result<Mesh, Broken> {
        let mut points: Vec<u32> = (0..self.points.len() as u32)
            .filter(|&p| used[p as usize])
            .collect();
        let cdt = loop {
            let places: Vec<[f64; 2]> = points
                .iter()
                .map(|&p| self.points[p as usize].to_array())
                .collect();
            match Cdt::new(&places, &borders.segments) {
                Ok(cdt) => break cdt,
                Err(CdtError::Coincident(_, twice)) if twice as usize >= self.fixed => {
                    points.remove(twice as usize);
                }
                Err(error) => return Err(broken(&error, &points)),
            }
        };
        let labels = cdt.label(borders).map_err(|e| broken(&e, &points))?;
        if let Some((_, near)) = labels.open.iter().find(|open| open.0 == FACET) {
            return Err(Broken(points[*near as usize]));
        }
        let mesh = Mesh {
            inside: labels.of.iter().map(|l| *l == Some(FACET)).collect(),
            cdt,
            points,
        };
        let sides = |t: [u32; 3]| {
            (0..3)
                .filter(|&i| edges.contains(&[t[i], t[(i + 1) % 3]]))
                .count()
        };
        // Every edge has the facet to its left.
        if mesh.triangles().into_iter().map(sides).sum::<usize>() != edges.len() {
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
    fn centres(&self, mesh: &Mesh, hopeless: &FxHashSet<[u32; 3]>) -> Vec<([u32; 3], DVec2)> {
        let mut bad = Vec::new();
        for mut key in mesh.triangles() {
            let found = bad_circle(key.map(|v| self.points[v as usize]), self.largest);
            key.sort_unstable();
            if let Some((ratio, centre)) = found
                && !hopeless.contains(&key)
            {
                bad.push((ratio, key, centre));
            }
        }
        bad.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        let mut taken = vec![false; mesh.inside.len()];
        let mut added = Vec::new();
        for (_, key, centre) in bad {
            let Some(t) = mesh.cdt.containing(centre.to_array()) else {
                continue;
            };
            let across = mesh.cdt.across[t as usize];
            let around = across.into_iter().filter(|&f| f != NONE);
            let mut near = around.clone().chain([t]);
            if !mesh.inside[t as usize] || near.any(|f| taken[f as usize]) {
                continue;
            }
            around.chain([t]).for_each(|f| taken[f as usize] = true);
            added.push((key, centre));
        }
        added
    }
}

/// Circumradius over shortest side, and circumcentre, of a triangle that a patch improves where its outline allows it.
pub fn narrow(corners: [DVec2; 3]) -> Option<(f64, DVec2)> {
    bad_circle(corners, f64::INFINITY)
}

/// The same where triangles with a larger circumradius than `largest` are improved, too.
fn bad_circle([a, b, c]: [DVec2; 3], largest: f64) -> Option<(f64, DVec2)> {
    let limit = 0.5 / libm::sin(MIN_ANGLE.to_radians());
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
    let is_bad = ratio > limit || offset.length() > largest;
    (is_bad && ratio.is_finite()).then(|| (ratio, a + offset))
}

/// Where a triangulation of these points fails.
fn broken(error: &CdtError, points: &[u32]) -> Broken {
    let near = match *error {
        CdtError::Coincident(_, p) | CdtError::Crossing(p, _) => p,
        CdtError::Ambiguous { near, .. } => near,
        CdtError::Coordinate => 0,
    };
    Broken(points[near as usize])
}

impl Mesh {
    /// The triangles of the facet, by points of the patch.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let triangles = self.cdt.triangles.iter().zip(&self.inside);
        triangles
            .filter(|(_, inside)| **inside)
            .map(|(t, _)| t.map(|v| self.points[v as usize]))
            .collect()
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
            rounding: 1e-10,
            largest: f64::INFINITY,
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
    fn wide_triangles_get_points_where_a_size_is_asked_for() {
        let corners =
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
        let widest = |largest: f64| {
            let (mut points, mut outline) = (Vec::new(), Vec::new());
            ring(&mut points, &mut outline, &corners, 10);
            let mut patch = Patch {
                fixed: points.len(),
                points,
                outline,
                rounding: 1e-10,
                largest,
            };
            let triangles = patch.triangulate().unwrap();
            let radii = triangles.iter().map(|t| {
                let [a, b, c] = t.map(|v| patch.points[v as usize]);
                let sides = [a.distance(b), b.distance(c), c.distance(a)];
                let product: f64 = sides.iter().product();
                product / (2.0 * (b - a).perp_dot(c - a))
            });
            radii.fold(0.0, f64::max)
        };
        assert!(widest(f64::INFINITY) > 0.2);
        assert!(widest(0.16) <= 0.16);
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
            rounding: 1e-10,
            largest: f64::INFINITY,
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
            rounding: 1e-10,
            largest: f64::INFINITY,
        };
        assert!(patch.triangulate().is_err());
    }
}
