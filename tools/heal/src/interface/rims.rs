//! The curves behind sharp edges.

use crate::imprint::Curves;
use geom::edges::Edges;
use geom::smooth::SMOOTH;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The curve behind a sharp edge.
pub struct Rim {
    /// How far it is from the middle of the edge, model units; 0 where it is straight.
    pub sagitta: f64,
    /// The direction across the edge in which it bends, or zero.
    pub bend: DVec3,
    /// Angle between the directions in which it bends at its ends, radians.
    pub twist: f64,
}

/// Sharp edges of solids.
pub struct Rims {
    /// Of vertices and solids: the other ends of sharp edges.
    next: FxHashMap<[u32; 2], Vec<u32>>,
    /// Of vertices and solids: unit normals of the facets at sharp edges.
    normals: FxHashMap<[u32; 2], Vec<DVec3>>,
}

impl Rims {
    /// Those of all solids; `solid` has the solid of each facet.
    pub fn new(edges: &Edges, curves: &Curves, solid: &[u32]) -> Self {
        let mut next: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
        let mut normals: FxHashMap<[u32; 2], Vec<DVec3>> = FxHashMap::default();
        for (e, &[a, b]) in edges.ends.iter().enumerate() {
            for u in edges.around(e) {
                let patch = &curves.patches[u.triangle as usize];
                if patch.smooth[u.corner as usize] {
                    continue;
                }
                let solid = solid[u.triangle as usize];
                for [v, w] in [[a, b], [b, a]] {
                    let list = next.entry([v, solid]).or_default();
                    if !list.contains(&w) {
                        list.push(w);
                    }
                    let list = normals.entry([v, solid]).or_default();
                    if !list.contains(&patch.normal) {
                        list.push(patch.normal);
                    }
                }
            }
        }
        Self { next, normals }
    }

    /// Whether a vertex is on a sharp edge of a solid.
    pub fn has(&self, v: u32, solid: u32) -> bool {
        self.next.contains_key(&[v, solid])
    }

    /// Whether a facet at a sharp edge of one solid looks at one at a sharp edge of another solid, at these vertices of theirs: the cosine
    /// between their normals is no more than `most`.
    pub fn face(&self, one: [u32; 2], other: [u32; 2], most: f64) -> bool {
        let of = |key| self.normals.get(&key).map_or(&[][..], Vec::as_slice);
        let others = of(other);
        of(one)
            .iter()
            .any(|n| others.iter().any(|m| n.dot(*m) <= most))
    }

    /// The curve behind a sharp edge of a solid, by how it turns where it goes on.
    pub fn rim(&self, [a, b]: [u32; 2], solid: u32, points: &[DVec3]) -> Rim {
        let at = |v: u32| points[v as usize];
        let along = at(b) - at(a);
        let turn = |v: u32, next: u32| {
            let before = match self.next.get(&[v, solid]).map(Vec::as_slice) {
                Some(&[x, y]) if x == next => y,
                Some(&[x, y]) if y == next => x,
                _ => return DVec3::ZERO,
            };
            let [back, ahead] = [at(v) - at(before), at(next) - at(v)];
            match back.angle_between(ahead) <= SMOOTH {
                true => (ahead.normalize_or_zero() - back.normalize_or_zero()).reject_from(along),
                false => DVec3::ZERO,
            }
        };
        let [first, second] = [turn(a, b), turn(b, a)];
        let twist = match first == DVec3::ZERO || second == DVec3::ZERO {
            true => 0.0,
            false => first.angle_between(second),
        };
        Rim {
            sagitta: first.length().max(second.length()) * along.length() / 8.0,
            bend: (first + second).normalize_or_zero(),
            twist,
        }
    }
}
