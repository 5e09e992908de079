//! What flat patches have in common.

use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::Triangle;

/// What patches have in common.
pub struct Shared {
    /// For each point, whether it is one of more than one patch.
    pub points: Vec<bool>,
    /// Edges of more than one patch, lower point first.
    pub edges: FxHashSet<[u32; 2]>,
}

impl Shared {
    /// Of faces and the patch of each, on `count` points.
    pub fn new(faces: &[Triangle], patches: &[u32], count: usize) -> Self {
        let mut first = vec![u32::MAX; count];
        let mut points = vec![false; count];
        for (face, &patch) in faces.iter().zip(patches) {
            for v in face.vertices.map(|v| v as usize) {
                if first[v] == u32::MAX {
                    first[v] = patch;
                }
                points[v] |= first[v] != patch;
            }
        }
        let mut first: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        let mut edges = FxHashSet::default();
        for (face, &patch) in faces.iter().zip(patches) {
            for k in 0..3 {
                let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
                let key = if v < w { [v, w] } else { [w, v] };
                let both = points[v as usize] && points[w as usize];
                if both && *first.entry(key).or_insert(patch) != patch {
                    edges.insert(key);
                }
            }
        }
        Self { points, edges }
    }
}
