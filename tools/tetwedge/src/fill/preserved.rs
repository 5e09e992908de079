//! Triangles that had to be preserved, found again.

use super::filled::{Filled, NONE};
use mesher::{NO_FACE, Place, Plc};
use rustc_hash::FxHashMap;
use tmesh::Template;

/// Finds every triangle that had to be preserved, by its vertices.
pub fn restore_preserved(
    input: &Template,
    plc: &Plc,
    faces: &[u32],
    filled: &mut Filled,
) -> Result<(), String> {
    if !plc.faces.preserve() {
        return Ok(());
    }
    let mut new_index: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    for (i, t) in filled.template.triangles.iter().enumerate() {
        if faces[i] != NO_FACE {
            new_index.insert(sorted(t.vertices), i as u32);
        }
    }
    for (old, t) in input.triangles.iter().enumerate() {
        if !plc.faces.preserved[old] {
            continue;
        }
        let vertices = t.vertices.map(|v| filled.vertices[v as usize]);
        match new_index.get(&sorted(vertices)) {
            Some(&new) if vertices.iter().all(|&v| v != NONE) => filled.triangles[old] = new,
            _ => {
                let place = Place(t.vertices.map(|v| input.vertices[v as usize])[0]);
                return Err(format!(
                    "a triangle of a face that must be preserved is gone near {place}"
                ));
            }
        }
    }
    Ok(())
}

fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}
