//! Renamings of regions.

use serde::{Deserialize, Serialize};

/// A renaming of regions that an instance applies to its template: (from, to) pairs, increasing in
/// `from`; regions not listed keep their id.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionMap {
    /// The pairs.
    pub pairs: Vec<[u32; 2]>,
}

impl RegionMap {
    /// Where a region goes.
    pub fn get(&self, region: u32) -> u32 {
        match self.pairs.binary_search_by_key(&region, |p| p[0]) {
            Ok(i) => self.pairs[i][1],
            Err(_) => region,
        }
    }
}
