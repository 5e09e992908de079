//! Nearest triangle along a ray: a bounding volume hierarchy, split at the median.

use glam::DVec3;

/// Triangles per leaf.
const LEAF: usize = 4;

/// Barycentric coordinates may be this much outside, so that no ray slips through an edge. A hit
/// reported a little too near is harmless here.
const SLACK: f64 = 1e-9;

struct Node {
    low: DVec3,
    high: DVec3,
    /// First child for inner nodes (the second follows it), first triangle for leaves.
    first: u32,
    /// Triangles of a leaf; 0 for inner nodes.
    count: u32,
}

/// A hierarchy over the triangles of a surface.
pub struct Rays<'a> {
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl<'a> Rays<'a> {
    /// Builds the hierarchy in `n log n`.
    pub fn new(vertices: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        let mut rays = Self {
            vertices,
            triangles,
            nodes: Vec::new(),
            order: (0..triangles.len() as u32).collect(),
        };
        let centres: Vec<DVec3> = triangles
            .iter()
            .map(|t| t.iter().map(|&v| vertices[v as usize]).sum::<DVec3>() / 3.0)
            .collect();
        let root = rays.leaf(0, triangles.len());
        rays.nodes.push(root);
        let mut open = vec![0_usize];
        while let Some(node) = open.pop() {
            let Node { first, count, .. } = rays.nodes[node];
            let (first, count) = (first as usize, count as usize);
            if count <= LEAF {
                continue;
            }
            let range = &mut rays.order[first..first + count];
            let (low, high) = range
                .iter()
                .map(|&t| centres[t as usize])
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| {
                    (l.min(p), h.max(p))
                });
            let axis = (high - low).max_position();
            let half = count / 2;
            range.select_nth_unstable_by(half, |&a, &b| {
                let key = |t: u32| centres[t as usize][axis];
                key(a).total_cmp(&key(b)).then(a.cmp(&b))
            });
            let children = rays.nodes.len();
            let (left, right) = (
                rays.leaf(first, half),
                rays.leaf(first + half, count - half),
            );
            rays.nodes.extend([left, right]);
            rays.nodes[node].first = children as u32;
            rays.nodes[node].count = 0;
            open.extend([children, children + 1]);
        }
        rays
    }

    fn leaf(&self, first: usize, count: usize) -> Node {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for &t in &self.order[first..first + count] {
            for v in self.triangles[t as usize] {
                let p = self.vertices[v as usize];
                low = low.min(p);
                high = high.max(p);
            }
        }
        // The same slack as for triangles: a ray along the side of a box must not miss it by rounding.
        let margin = SLACK * (high - low).max_element();
        Node {
            low: low - margin,
            high: high + margin,
            first: first as u32,
            count: count as u32,
        }
    }

    /// Distance along `direction` (in units of its length) from `origin` to the nearest triangle
    /// that is neither `except` nor parallel to the ray; `None` when there is none.
    pub fn nearest(&self, origin: DVec3, direction: DVec3, except: u32) -> Option<f64> {
        let inverse = direction.recip();
        let mut best = f64::INFINITY;
        let mut open = vec![0_u32];
        while let Some(node) = open.pop() {
            let node = &self.nodes[node as usize];
            if !enters(node, origin, inverse, best) {
                continue;
            }
            if node.count == 0 {
                open.extend([node.first, node.first + 1]);
                continue;
            }
            let range = node.first as usize..(node.first + node.count) as usize;
            for &t in &self.order[range] {
                if t != except
                    && let Some(distance) = self.hit(t, origin, direction)
                {
                    best = best.min(distance);
                }
            }
        }
        best.is_finite().then_some(best)
    }

    /// Möller and Trumbore's intersection, with slack.
    fn hit(&self, triangle: u32, origin: DVec3, direction: DVec3) -> Option<f64> {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.vertices[v as usize]);
        let (u, v) = (b - a, c - a);
        let p = direction.cross(v);
        let determinant = u.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let s = origin - a;
        let q = s.cross(u);
        let first = s.dot(p) / determinant;
        let second = direction.dot(q) / determinant;
        let inside = first >= -SLACK && second >= -SLACK && first + second <= 1.0 + SLACK;
        let distance = v.dot(q) / determinant;
        (inside && distance > 0.0).then_some(distance)
    }
}

fn enters(node: &Node, origin: DVec3, inverse: DVec3, best: f64) -> bool {
    let mut from = 0.0_f64;
    let mut to = best;
    for axis in 0..3 {
        let a = (node.low[axis] - origin[axis]) * inverse[axis];
        let b = (node.high[axis] - origin[axis]) * inverse[axis];
        // A ray in the plane of a box's side: it is between the two sides all along.
        if a.is_nan() || b.is_nan() {
            continue;
        }
        from = from.max(a.min(b));
        to = to.min(a.max(b));
    }
    // Boxes of flat triangles have no thickness: allow for rounding.
    from <= to * (1.0 + 1e-12) + f64::MIN_POSITIVE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_trying_all() {
        // A deterministic cloud of triangles.
        let mut state = 7_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..300_u32 {
            let centre = DVec3::new(next(), next(), next());
            for _ in 0..3 {
                vertices.push(centre + 0.1 * DVec3::new(next(), next(), next()));
            }
            triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let rays = Rays::new(&vertices, &triangles);
        for except in 0..100 {
            let origin = DVec3::new(next(), next(), next());
            let direction = DVec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
            let all = (0..300)
                .filter(|&t| t != except)
                .filter_map(|t| rays.hit(t, origin, direction))
                .min_by(f64::total_cmp);
            assert_eq!(rays.nearest(origin, direction, except), all);
        }
    }

    #[test]
    fn rays_along_the_side_of_a_box_do_not_miss_it_by_rounding() {
        let vertices = [
            DVec3::new(4.0, 1.0, 0.0),
            DVec3::new(5.0, 1.0, 0.0),
            DVec3::new(4.0, 1.0, 1.0),
        ];
        let triangles = [[0, 1, 2]];
        let rays = Rays::new(&vertices, &triangles);
        for x in [4.0_f64.next_down(), 4.0, 4.0_f64.next_up()] {
            let origin = DVec3::new(x, 0.0, 0.25);
            assert_eq!(rays.nearest(origin, DVec3::Y, u32::MAX), Some(1.0));
        }
    }

    #[test]
    fn axis_parallel_rays_meet_flat_triangles() {
        let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.2, 0.2, -1.0)];
        let triangles = [[0, 1, 2]];
        let rays = Rays::new(&vertices, &triangles);
        assert_eq!(rays.nearest(vertices[3], DVec3::Z, u32::MAX), Some(1.0));
        assert_eq!(rays.nearest(vertices[3], -DVec3::Z, u32::MAX), None);
    }

    #[test]
    fn rays_along_the_side_of_a_box_enter_it() {
        // A row of triangles above z = 0.
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..8_u32 {
            let x = f64::from(i);
            let corners = [[x, 1.0, 0.0], [x + 1.0, 1.0, 0.0], [x + 0.5, 1.0, 1.0]];
            vertices.extend(corners.map(DVec3::from_array));
            triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let rays = Rays::new(&vertices, &triangles);
        for x in [0.25, 3.5, 7.75] {
            let origin = DVec3::new(x, 0.0, 0.0);
            assert_eq!(rays.nearest(origin, DVec3::Y, u32::MAX), Some(1.0), "{x}");
        }
    }
}
