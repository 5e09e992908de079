//! Own numbers for the points of a patch.

use rustc_hash::FxHashMap;

/// Numbers the points of one patch 0, 1, ... in order of appearance.
#[derive(Default)]
pub struct Local {
    /// The points in order.
    pub ids: Vec<u32>,
    index: FxHashMap<u32, u32>,
}

impl Local {
    /// The number of a point.
    pub fn id(&mut self, v: u32) -> u32 {
        *self.index.entry(v).or_insert_with(|| {
            self.ids.push(v);
            self.ids.len() as u32 - 1
        })
    }
}
