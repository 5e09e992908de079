//! Collapsing detail too small to mesh: edges shorter than a tolerance, as a cut leaves them where it
//! passes a vertex closely, and as CAD exports have them.

use crate::opening::Class;
use crate::surface::{Surface, join_coincident};
use geom::sets::DisjointSets;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::Triangle;

/// The bits of [`planes`] that are sides through the axis.
const SIDES: u8 = 0b11;
/// Least cosine between a face's normals before and after one of its corners is moved: 45 degrees.
const TURN: f64 = 0.7;
/// Least height of a face after one of its corners was moved, relative to the movement.
const HEIGHT: f64 = 0.5;

/// What was collapsed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Collapsed {
    /// Points joined to another one.
    pub points: usize,
    /// Faces that had no area left.
    pub faces: usize,
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
        let (x, y) = (planes(m), planes(n));
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
    join_coincident(&mut surface.faces, &mut surface.patches);
    collapsed.faces = before - surface.faces.len();
    collapsed
}

/// The cut planes that a point lies on, a bit each.
fn planes(class: Class) -> u8 {
    u8::from(class.a == 0) | u8::from(class.b == 0) << 1 | u8::from(class.level == 0) << 2
}

/// Joins the ends of edges shorter than `length` (model units) of which one end at least is on a side
/// of the wedge: the cut leaves such edges wherever it passes points closely. The point on the side
/// stays. Unlike [`collapse_short_edges`], for lengths at which shape matters: nothing is joined that
/// would turn a face over, flatten it, lay it into a side or pinch the surface. Returns the number of
/// points joined.
pub fn collapse_at_sides(surface: &mut Surface, length: f64) -> usize {
    let on_side = |class: Class| planes(class) & SIDES;
    let mut short: Vec<(f64, [u32; 2])> = Vec::new();
    let mut around: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for face in &surface.faces {
        for k in 0..3 {
            let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
            let d = surface.points[v as usize].distance(surface.points[w as usize]);
            let classes = [v, w].map(|v| surface.classes[v as usize]);
            if d < length && classes.iter().any(|&c| on_side(c) != 0) {
                short.push((d, [v.min(w), v.max(w)]));
                around.insert(v, Vec::new());
                around.insert(w, Vec::new());
            }
        }
    }
    short.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    short.dedup_by_key(|s| s.1);
    for (i, face) in surface.faces.iter().enumerate() {
        for v in face.vertices {
            if let Some(list) = around.get_mut(&v) {
                list.push(i as u32);
            }
        }
    }
    let mut stands: FxHashMap<u32, u32> = FxHashMap::default();
    let mut joined = 0;
    for (_, ends) in short {
        let [v, w] = ends.map(|mut v| {
            while let Some(&next) = stands.get(&v) {
                v = next;
            }
            v
        });
        let [x, y] = [v, w].map(|v| planes(surface.classes[v as usize]));
        let distance = surface.points[v as usize].distance(surface.points[w as usize]);
        let (stay, go) = match (x & y, x, y) {
            _ if v == w || distance >= length => continue,
            _ if x == y && x.count_ones() > 1 => continue,
            (both, _, _) if both == y => (v, w),
            (both, _, _) if both == x => (w, v),
            _ => continue,
        };
        if !may_join(surface, &around, stay, go) {
            continue;
        }
        let moved = around.remove(&go).unwrap_or_default();
        for &f in &moved {
            let corners = &mut surface.faces[f as usize].vertices;
            *corners = corners.map(|v| if v == go { stay } else { v });
        }
        around.entry(stay).or_default().extend(moved);
        stands.insert(go, stay);
        joined += 1;
    }
    let has_area = |f: &Triangle| {
        let [a, b, c] = f.vertices;
        a != b && b != c && a != c
    };
    let (faces, patches) = (&mut surface.faces, &mut surface.patches);
    let mut flags = faces.iter().map(has_area).collect::<Vec<_>>().into_iter();
    patches.retain(|_| flags.next().unwrap_or(true));
    faces.retain(has_area);
    joined
}

/// Whether a point can be moved to another one, at the other end of an edge.
fn may_join(surface: &Surface, around: &FxHashMap<u32, Vec<u32>>, stay: u32, go: u32) -> bool {
    let faces = |v: u32| {
        let list = around.get(&v).map_or(&[][..], |list| list.as_slice());
        let corners = list.iter().map(|&f| surface.faces[f as usize].vertices);
        corners.filter(|[a, b, c]| a != b && b != c && a != c)
    };
    let neighbours =
        |v: u32| -> FxHashSet<u32> { faces(v).flatten().filter(|&w| w != v).collect() };
    // Around an edge, only the third corners of its faces are neighbours of both ends.
    let third: FxHashSet<u32> = (faces(go).filter(|f| f.contains(&stay)).flatten())
        .filter(|v| ![go, stay].contains(v))
        .collect();
    let (of_stay, of_go) = (neighbours(stay), neighbours(go));
    if of_stay.intersection(&of_go).any(|v| !third.contains(v)) {
        return false;
    }
    let at = |v: u32| surface.points[v as usize];
    let plane = |v: u32| planes(surface.classes[v as usize]);
    faces(go).filter(|f| !f.contains(&stay)).all(|f| {
        let after = f.map(|v| if v == go { stay } else { v });
        let [old, new] =
            [f, after].map(|[a, b, c]| geom::measure::double_area_vector(at(a), at(b), at(c)));
        let longest = (0..3).map(|k| at(after[k]).distance(at(after[(k + 1) % 3])));
        let height = new.length() / longest.fold(0.0, f64::max);
        let in_plane = after.map(plane).into_iter().fold(u8::MAX, |x, y| x & y) != 0;
        old.dot(new) > TURN * old.length() * new.length()
            && height > HEIGHT * at(stay).distance(at(go))
            && !in_plane
    })
}
