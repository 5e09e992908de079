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
}

impl Images {
    /// Links whose faces can be told apart.
    pub const MOST: usize = u64::BITS as usize;

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
        Self {
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
