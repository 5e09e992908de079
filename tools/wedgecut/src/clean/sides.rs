//! Collapsing short edges at the faces of a cell, which a cut leaves wherever it passes points closely.

use crate::surface::Surface;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::Triangle;

/// Least cosine between a face's normals before and after one of its corners is moved, 45 degrees: it may not turn
/// over, nor nearly so.
const TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Least height of a face after one of its corners was moved, relative to the movement: what is flatter would be the
/// next short edge.
const HEIGHT: f64 = 0.5;

/// Joins the ends of edges shorter than `length` (model units) of which one end at least is on a face
/// of the cell, be it a side, the plane across the axis or what divides a face into images: the cut leaves such edges
/// wherever it passes points closely. The point on the face stays. Unlike [`super::collapse_short_edges`], for lengths at which shape matters: nothing is joined that
/// would turn a face over, flatten it, lay it into a side or pinch the surface. Returns the number of
/// points joined.
pub fn collapse_at_sides(surface: &mut Surface, length: f64) -> usize {
    let mut short: Vec<(f64, [u32; 2])> = Vec::new();
    let mut around: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for face in &surface.faces {
        for k in 0..3 {
            let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
            let d = surface.points[v as usize].distance(surface.points[w as usize]);
            let classes = [v, w].map(|v| surface.classes[v as usize]);
            if d < length && classes.iter().any(|c| c.bound() != 0) {
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
        let [x, y] = [v, w].map(|v| surface.classes[v as usize].bound());
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
    let plane = |v: u32| surface.classes[v as usize].bound();
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
