//! Flat faces whose border was moved onto another solid's.

use super::skin::Skin;
use crate::imprint::{Division, Parts};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// The facets of flat faces, divided anew; `None` where the border of one crosses itself. `face` has the face of each facet
/// of before.
pub fn redivided(
    skin: &Skin,
    face: &[u32],
    which: &FxHashSet<u32>,
) -> Option<FxHashMap<u32, Vec<[u32; 3]>>> {
    let mut of: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for t in 0..skin.corners.len() as u32 {
        let face = face[skin.origin[t as usize] as usize];
        if which.contains(&face) {
            of.entry(face).or_default().push(t);
        }
    }
    let mut divided = FxHashMap::default();
    for (face, facets) in of {
        let sides = facets.iter().flat_map(|&t| {
            let corners = skin.corners[t as usize];
            [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]])
        });
        let sides: FxHashSet<[u32; 2]> = sides.collect();
        let is_border = |s: &&[u32; 2]| !sides.contains(&[s[1], s[0]]);
        let mut border: Vec<[u32; 2]> = sides.iter().filter(is_border).copied().collect();
        border.sort_unstable();
        let area = |&t: &u32| {
            let [a, b, c] = skin.corners[t as usize].map(|v| skin.points[v as usize]);
            (b - a).cross(c - a)
        };
        let division = Division {
            normal: facets.iter().map(area).sum::<DVec3>(),
            border,
            inside: Vec::new(),
            segments: Vec::new(),
        };
        let parts = division.divide(&skin.points, &mut Parts::default())?;
        divided.insert(face, parts.concat());
    }
    Some(divided)
}
