//! Where a surface meets itself.

use crate::input::{Rules, Surface};
use geom::contacts::contacts;
use glam::DVec3;

/// Places where triangles of one space meet that should not, with their size.
pub fn crossings(surface: &Surface, rules: &Rules<'_>) -> Vec<(DVec3, f64)> {
    let mut spaces: Vec<u32> = surface.labels.iter().map(|&l| rules.space(l)).collect();
    let of = spaces.clone();
    spaces.sort_unstable();
    spaces.dedup();
    let mut found = Vec::new();
    for space in spaces {
        let here = surface.triangles.iter().zip(&of);
        let here: Vec<[u32; 3]> = here.filter(|t| *t.1 == space).map(|t| *t.0).collect();
        contacts(
            &surface.points,
            &here,
            |t| t,
            |contact| {
                let sides = contact.triangles.into_iter().flat_map(|t| {
                    let [a, b, c] = here[t as usize].map(|v| surface.points[v as usize]);
                    [a.distance(b), b.distance(c), c.distance(a)]
                });
                found.push((contact.point, sides.fold(0.0, f64::max)));
                true
            },
        );
    }
    found
}
