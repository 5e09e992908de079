//! What is the image of what.

use crate::input::{Link, Surface};
use crate::shape::Patches;
use rustc_hash::FxHashMap;

/// Images of vertices, as they are now.
pub struct Images {
    /// Of each link, the images of vertices, and what vertices are images of.
    pub maps: Vec<[FxHashMap<u32, u32>; 2]>,
    /// Of each patch, the links in a face of which it lies, a bit each.
    pub faces: Vec<u64>,
    /// Of each link, whether both of its faces lie in one plane, as the two halves of a face that a half turn exchanges.
    pub level: Vec<bool>,
}

impl Images {
    /// As they are given.
    pub fn new(surface: &Surface, links: &[Link], patches: &Patches) -> Self {
        let map =
            |link: &Link, [a, b]: [usize; 2]| link.pairs.iter().map(|p| (p[a], p[b])).collect();
        let mut faces = vec![0; patches.planes.len()];
        for (&patch, label) in patches.of.iter().zip(&surface.labels) {
            for (i, link) in links.iter().enumerate() {
                faces[patch as usize] |= u64::from(link.labels.contains(label)) << i;
            }
        }
        let level = |(i, link): (usize, &Link)| {
            let patches = faces.iter().zip(&patches.planes).zip(&patches.off);
            let mut of_link = patches.filter(|((faces, _), _)| *faces & 1 << i != 0);
            let Some(((_, Some(plane)), off)) = of_link.next() else {
                return false;
            };
            let mut all = link.pairs.iter().flatten();
            all.all(|&v| plane.off([surface.points[v as usize]; 3]) <= *off)
        };
        let level = links.iter().enumerate().map(level).collect();
        Self {
            level,
            maps: links
                .iter()
                .map(|link| [map(link, [0, 1]), map(link, [1, 0])])
                .collect(),
            faces,
        }
    }

    /// Whether a vertex has an image, or is one.
    pub fn has(&self, v: u32) -> bool {
        self.maps.iter().flatten().any(|map| map.contains_key(&v))
    }

    /// Whether a vertex is its own image.
    pub fn is_fixed(&self, v: u32) -> bool {
        self.maps.iter().any(|map| map[0].get(&v) == Some(&v))
    }

    /// Whether a triangle of a patch lies in a face of a link that the patch is no part of, or in both.
    pub fn lies_in_face(&self, corners: [u32; 3], patch: u32) -> bool {
        let links = self.maps.iter().enumerate();
        let mut others = links.filter(|(i, _)| self.faces[patch as usize] & 1 << i == 0);
        others.any(|(i, map)| {
            let on = |side: usize| corners.map(|v| map[side].contains_key(&v));
            let [low, high] = [on(0), on(1)];
            let both = || (0..3).all(|k| low[k] || high[k]);
            low == [true; 3] || high == [true; 3] || self.level[i] && both()
        })
    }

    /// Notes that a vertex of a link has an image.
    pub fn add(&mut self, link: usize, [v, image]: [u32; 2]) {
        self.maps[link][0].insert(v, image);
        self.maps[link][1].insert(image, v);
    }

    /// Each vertex of a link with its image, increasing.
    pub fn pairs(&self, link: usize) -> Vec<[u32; 2]> {
        let mut pairs: Vec<[u32; 2]> = self.maps[link][0].iter().map(|(&v, &w)| [v, w]).collect();
        pairs.sort_unstable();
        pairs
    }

    /// Takes a vertex that is gone out of all links.
    pub fn drop(&mut self, v: u32) {
        for map in self.maps.iter_mut().flatten() {
            map.remove(&v);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_of_other_patches_may_not_lie_in_a_linked_face() {
        let mut images = Images {
            maps: vec![Default::default()],
            faces: vec![0, 1],
            level: vec![false],
        };
        for v in 0..3 {
            images.add(0, [v, v + 3]);
        }
        assert!(images.lies_in_face([0, 1, 2], 0) && images.lies_in_face([5, 3, 4], 0));
        // The face itself, and triangles that reach out of it.
        assert!(!images.lies_in_face([0, 1, 2], 1));
        assert!(!images.lies_in_face([0, 1, 6], 0) && !images.lies_in_face([0, 1, 3], 0));
        // The halves of one face.
        images.level = vec![true];
        assert!(images.lies_in_face([0, 1, 3], 0) && !images.lies_in_face([0, 1, 6], 0));
    }
}
