//! Division of flat faces at the vertices and segments in them.

use geom::cdt::{Cdt, CdtError, NONE};
use glam::DVec3;
use robust::{Coord, orient2d};
use rustc_hash::{FxHashMap, FxHashSet};

/// A face that is to be divided.
pub struct Division {
    /// The sides of its border, each with the face on the left, seen against the normal.
    pub border: Vec<[u32; 2]>,
    /// Vertices in the interior.
    pub inside: Vec<u32>,
    /// Segments between vertices of it.
    pub segments: Vec<[u32; 2]>,
    /// A normal of it.
    pub normal: DVec3,
}

/// Divided parts, so that the same part of another triangle is divided alike: by their borders, as vertex pairs in
/// order, and their vertices, in order.
#[derive(Default)]
pub struct Parts {
    known: FxHashMap<(Vec<[u32; 2]>, Vec<u32>), Part>,
}

/// A part as it was divided first.
struct Part {
    triangles: Vec<[u32; 3]>,
    /// A side of its border as it runs counter-clockwise.
    side: [u32; 2],
}

impl Division {
    /// The parts that segments divide it into, a list of triangles each; nothing where it has no area. `None` where it
    /// cannot be divided: its border crosses itself.
    pub fn divide(&self, points: &[DVec3], parts: &mut Parts) -> Option<Vec<Vec<[u32; 3]>>> {
        let mut ids: Vec<u32> = [self.border.as_flattened(), &self.inside].concat();
        ids.sort_unstable();
        ids.dedup();
        if ids.len() < 3 {
            return Some(Vec::new());
        }
        let (x, y) = frame(self.normal)?;
        let origin = points[ids[0] as usize];
        let flat: Vec<[f64; 2]> = ids
            .iter()
            .map(|&v| {
                let p = points[v as usize] - origin;
                [p.dot(x), p.dot(y)]
            })
            .collect();
        let local = |v: u32| ids.binary_search(&v).map_or(NONE, |i| i as u32);
        let border = self.sides(local);
        let cdt = self.triangulate(&flat, &border, local)?;
        let is_border: FxHashSet<[u32; 2]> = border.iter().map(|s| sorted(*s)).collect();
        let inside = enclosed(&cdt, &is_border);
        Some(collect(&cdt, &inside, &ids, parts))
    }

    /// Sides of the border that are there once; what is there twice, back and forth, is no border.
    fn sides(&self, local: impl Fn(u32) -> u32) -> Vec<[u32; 2]> {
        let mut odd: FxHashSet<[u32; 2]> = FxHashSet::default();
        for side in &self.border {
            let side = sorted(side.map(&local));
            if side[0] != side[1] && !odd.insert(side) {
                odd.remove(&side);
            }
        }
        let mut sides: Vec<[u32; 2]> = odd.into_iter().collect();
        sides.sort_unstable();
        sides
    }

    /// The triangulation with the border and those segments that cross neither it nor segments before them.
    fn triangulate(
        &self,
        flat: &[[f64; 2]],
        border: &[[u32; 2]],
        local: impl Fn(u32) -> u32,
    ) -> Option<Cdt> {
        let mut segments = border.to_vec();
        let mut known: FxHashSet<[u32; 2]> = segments.iter().map(|s| sorted(*s)).collect();
        for s in &self.segments {
            let s = s.map(&local);
            let crosses = |other: &[u32; 2]| crosses(flat, s, *other);
            if !s.contains(&NONE)
                && s[0] != s[1]
                && known.insert(sorted(s))
                && !segments.iter().any(crosses)
            {
                segments.push(s);
            }
        }
        match Cdt::new(flat, &segments) {
            Ok(cdt) => Some(cdt),
            Err(CdtError::Crossing(..)) => Cdt::new(flat, border).ok(),
            Err(_) => None,
        }
    }
}

/// Whether two segments cross in the interior of both, exactly.
fn crosses(flat: &[[f64; 2]], s: [u32; 2], t: [u32; 2]) -> bool {
    if s.iter().any(|v| t.contains(v)) {
        return false;
    }
    let at = |v: u32| Coord {
        x: flat[v as usize][0],
        y: flat[v as usize][1],
    };
    let turn = |a: [u32; 2], b: u32| orient2d(at(a[0]), at(a[1]), at(b));
    turn(s, t[0]) * turn(s, t[1]) < 0.0 && turn(t, s[0]) * turn(t, s[1]) < 0.0
}

/// Two directions across a normal, so that the normal is the third.
fn frame(normal: DVec3) -> Option<(DVec3, DVec3)> {
    let z = normal.try_normalize()?;
    let x = z.any_orthonormal_vector();
    Some((x, z.cross(x)))
}

pub fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Which triangles the border has around them, an odd number of times.
fn enclosed(cdt: &Cdt, is_border: &FxHashSet<[u32; 2]>) -> Vec<bool> {
    let mut depth: Vec<Option<bool>> = vec![None; cdt.triangles.len()];
    let mut stack = Vec::new();
    let side = |t: usize, i: usize| {
        let c = &cdt.triangles[t];
        is_border.contains(&sorted([c[i], c[(i + 1) % 3]]))
    };
    for (t, across) in cdt.across.iter().enumerate() {
        if let Some(i) = across.iter().position(|&next| next == NONE) {
            depth[t] = Some(side(t, i));
            stack.push(t);
        }
    }
    while let Some(t) = stack.pop() {
        let Some(here) = depth[t] else { continue };
        for i in 0..3 {
            let next = cdt.across[t][i];
            if next != NONE && depth[next as usize].is_none() {
                depth[next as usize] = Some(here != side(t, i));
                stack.push(next as usize);
            }
        }
    }
    depth.into_iter().map(|d| d == Some(true)).collect()
}

/// The triangles of the parts that segments bound; a part that is known is divided as it was the first time.
fn collect(cdt: &Cdt, inside: &[bool], ids: &[u32], parts: &mut Parts) -> Vec<Vec<[u32; 3]>> {
    let mut seen = vec![false; inside.len()];
    let mut all = Vec::new();
    for first in 0..inside.len() {
        if !inside[first] || seen[first] {
            continue;
        }
        let (mut part, mut border, mut used) = (Vec::new(), Vec::new(), Vec::new());
        let mut stack = vec![first];
        seen[first] = true;
        while let Some(t) = stack.pop() {
            let corners = cdt.triangles[t].map(|v| ids[v as usize]);
            part.push(corners);
            used.extend(corners);
            for i in 0..3 {
                let next = cdt.across[t][i];
                if cdt.is_segment[t][i] || next == NONE || !inside[next as usize] {
                    border.push([corners[i], corners[(i + 1) % 3]]);
                } else if !std::mem::replace(&mut seen[next as usize], true) {
                    stack.push(next as usize);
                }
            }
        }
        all.push(parts.divided(part, border, used));
    }
    all
}

impl Parts {
    fn divided(
        &mut self,
        mut part: Vec<[u32; 3]>,
        border: Vec<[u32; 2]>,
        mut used: Vec<u32>,
    ) -> Vec<[u32; 3]> {
        if part.len() == 1 {
            return part;
        }
        let mut key: Vec<[u32; 2]> = border.iter().map(|s| sorted(*s)).collect();
        key.sort_unstable();
        used.sort_unstable();
        used.dedup();
        let known = self.known.entry((key, used)).or_insert_with(|| {
            part.sort_unstable();
            Part {
                triangles: part,
                side: border[0],
            }
        });
        let triangles = known.triangles.iter();
        match border.contains(&known.side) {
            true => triangles.copied().collect(),
            false => triangles.map(|&[a, b, c]| [a, c, b]).collect(),
        }
    }
}
