//! Permutations of region ids that come with a symmetry operation.

/// A permutation of `0..n`, where the numbers stand for regions in increasing order of id; outside
/// is the last of them and maps to itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Permutation(Vec<u32>);

impl Permutation {
    /// The identity on `n` regions.
    pub fn identity(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    /// From the image of each region, or `None` when it is no permutation.
    pub fn new(images: Vec<u32>) -> Option<Self> {
        let mut seen = vec![false; images.len()];
        for &i in &images {
            if std::mem::replace(seen.get_mut(i as usize)?, true) {
                return None;
            }
        }
        Some(Self(images))
    }

    /// Image of a region.
    pub fn get(&self, region: u32) -> u32 {
        self.0[region as usize]
    }

    /// Whether nothing moves.
    pub fn is_identity(&self) -> bool {
        self.0.iter().enumerate().all(|(i, &x)| i as u32 == x)
    }

    /// First `other`, then `self`.
    pub fn after(&self, other: &Self) -> Self {
        Self(other.0.iter().map(|&i| self.get(i)).collect())
    }

    /// The powers 0 to `n - 1`.
    pub fn powers(&self, n: u32) -> Vec<Self> {
        let mut all = vec![Self::identity(self.0.len())];
        for _ in 1..n {
            let last = &all[all.len() - 1];
            all.push(self.after(last));
        }
        all
    }

    /// The pairs (from, to) of region ids that differ, given the ids in increasing order.
    pub fn pairs(&self, ids: &[u32]) -> Vec<[u32; 2]> {
        (self.0.iter().enumerate())
            .filter(|(i, x)| *i as u32 != **x)
            .map(|(i, &x)| [ids[i], ids[x as usize]])
            .collect()
    }
}
