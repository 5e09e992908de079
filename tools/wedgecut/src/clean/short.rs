//! Collapsing detail too small to mesh: edges shorter than a tolerance, as a cut leaves them where it
//! passes a vertex closely, and as CAD exports have them.

use crate::surface::{Surface, join_coincident};
use geom::measure::area_of_region;
use geom::sets::DisjointSets;
use tmesh::OUTSIDE;

/// What was collapsed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Collapsed {
    /// Points joined to another one.
    pub points: usize,
    /// Faces that had no area left.
    pub faces: usize,
    /// Area of the body's boundary on both sides of what had no thickness left, model units squared.
    pub boundary: f64,
}

/// Joins the ends of edges shorter than `length` (model units), shortest first. A point on a cut
/// plane stays on it, a point on the axis stays where it is, and points on different planes are not
/// joined, so the walls keep their place.
///
/// Linear but for sorting the short edges.
pub fn collapse_short_edges(surface: &mut Surface, length: f64) -> Collapsed {
    let mut short: Vec<(f64, [u32; 2])> = Vec::new();
    for face in &surface.faces {
        for k in 0..3 {
            let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
            let d = surface.points[v as usize].distance(surface.points[w as usize]);
            if d < length {
                short.push((d, [v.min(w), v.max(w)]));
            }
        }
    }
    if short.is_empty() {
        return Collapsed::default();
    }
    short.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    short.dedup_by_key(|s| s.1);
    let count = surface.points.len();
    let mut sets = DisjointSets::new(count);
    // The point that stands for a set: the one bound to most planes, else the one numbered lowest.
    let mut stands: Vec<u32> = (0..count as u32).collect();
    let mut collapsed = Collapsed::default();
    for (_, [v, w]) in short {
        let (a, b) = (stands[sets.find(v) as usize], stands[sets.find(w) as usize]);
        if a == b {
            continue;
        }
        let (p, q) = (surface.points[a as usize], surface.points[b as usize]);
        let (m, n) = (surface.classes[a as usize], surface.classes[b as usize]);
        let (x, y) = (m.bound(), n.bound());
        let stay = match (x & y, x, y) {
            // Where planes meet, points stay.
            _ if x == y && x.count_ones() > 1 => continue,
            _ if x == y => a.min(b),
            (both, _, _) if both == y => a,
            (both, _, _) if both == x => b,
            _ => continue,
        };
        // Distances are between the points that stay, so a chain of short edges does not vanish.
        if p.distance(q) < length {
            sets.join(a, b);
            stands[sets.find(a) as usize] = stay;
            collapsed.points += 1;
        }
    }
    for face in &mut surface.faces {
        face.vertices = face.vertices.map(|v| stands[sets.find(v) as usize]);
    }
    let before = surface.faces.len();
    let mut patches = std::mem::take(&mut surface.patches).into_iter();
    let mut kept = Vec::new();
    surface.faces.retain(|f| {
        let [a, b, c] = f.vertices;
        let keep = a != b && b != c && a != c;
        let patch = patches.next();
        if keep {
            kept.extend(patch);
        }
        keep
    });
    surface.patches = kept;
    let boundary = area_of_boundary(surface);
    join_coincident(&mut surface.faces, &mut surface.patches);
    collapsed.boundary = boundary - area_of_boundary(surface);
    collapsed.faces = before - surface.faces.len();
    collapsed
}

fn area_of_boundary(surface: &Surface) -> f64 {
    let faces = (surface.faces.iter()).map(|f| (f.vertices, [f.front, f.back]));
    area_of_region(&surface.points, faces, OUTSIDE)
}
