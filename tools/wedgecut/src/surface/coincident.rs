//! Faces on the same three points.

use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Triangle};

/// Joins faces on the same three points, as they are left when the layer between them has been
/// collapsed: one face from the material before the first to the material behind the second, or none
/// where these are the same.
pub fn join_coincident(faces: &mut Vec<Triangle>, patches: &mut Vec<u32>) {
    let mut seen: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let mut keep = vec![true; faces.len()];
    for i in 0..faces.len() {
        let f = faces[i];
        let mut key = f.vertices;
        key.sort_unstable();
        let Some(&j) = seen.get(&key) else {
            seen.insert(key, i);
            continue;
        };
        let g = faces[j];
        let [a, b, c] = f.vertices;
        let same = [[a, b, c], [b, c, a], [c, a, b]].contains(&g.vertices);
        // What lies before and behind the second face, seen from the front of the first.
        let (front, back) = if same {
            (f.front, f.back)
        } else {
            (f.back, f.front)
        };
        let joined = if g.back == front {
            (g.front, back)
        } else if g.front == back {
            (front, g.back)
        } else {
            // No layer between them: contradicting faces, left for the caps to report.
            continue;
        };
        keep[i] = false;
        if joined.0 == joined.1 {
            keep[j] = false;
            seen.remove(&key);
            continue;
        }
        let outer = |t: &Triangle| t.front == OUTSIDE || t.back == OUTSIDE;
        let marker = if outer(&f) && !outer(&g) {
            f.marker
        } else {
            g.marker
        };
        faces[j] = Triangle {
            front: joined.0,
            back: joined.1,
            marker,
            ..g
        };
    }
    let mut flags = keep.iter();
    faces.retain(|_| *flags.next().unwrap_or(&true));
    let mut flags = keep.iter();
    patches.retain(|_| *flags.next().unwrap_or(&true));
}
