//! Positive numbers for regions and pieces of surface, for formats that want such.

use super::{Label, MeshStream};
use std::collections::BTreeSet;
use std::io;

/// Largest number that a signed 32-bit integer holds.
const LARGEST: u32 = i32::MAX as u32;

/// Consecutive tetrahedra of one region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Region id.
    pub region: u32,
    /// How many there are.
    pub count: u64,
}

/// Regions of the tetrahedra in order. Meshes whose templates have each region in one piece have a
/// run per instance and region at most.
pub fn runs(mesh: &dyn MeshStream) -> io::Result<Vec<Run>> {
    let mut runs: Vec<Run> = Vec::new();
    mesh.tet_regions(&mut |block| {
        for piece in block.regions.chunk_by(|a, b| a == b) {
            let (region, count) = (piece[0], piece.len() as u64);
            match runs.last_mut() {
                Some(last) if last.region == region => last.count += count,
                _ => runs.push(Run { region, count }),
            }
        }
        Ok(())
    })?;
    Ok(runs)
}

/// Numbers of regions and patches. Ids are kept where they are positive and fit a signed integer;
/// others get the next free numbers, and so do walls and what has no label.
#[derive(Clone, Debug)]
pub struct Tags {
    /// Region ids that occur, increasing, with their numbers.
    regions: Vec<(u32, u32)>,
    /// Number of each patch.
    patches: Vec<u32>,
}

impl Tags {
    /// The numbers of the regions of these runs and of the patches of the mesh.
    pub fn new(mesh: &dyn MeshStream, runs: &[Run]) -> Self {
        let ids: BTreeSet<u32> = runs.iter().map(|r| r.region).collect();
        let numbers = positive(ids.iter().map(|&id| Some(id)));
        let labels = mesh.patches().iter().map(|p| match p.label {
            Label::Marker(id) => Some(id),
            Label::Wall(_) | Label::Unnamed => None,
        });
        Self {
            regions: ids.into_iter().zip(numbers).collect(),
            patches: positive(labels),
        }
    }

    /// Regions that occur, with their numbers.
    pub fn regions(&self) -> &[(u32, u32)] {
        &self.regions
    }

    /// A region's number.
    pub fn region(&self, id: u32) -> u32 {
        let found = self.regions.binary_search_by_key(&id, |r| r.0);
        found.map_or(1, |i| self.regions[i].1)
    }

    /// A patch's number.
    pub fn patch(&self, patch: usize) -> u32 {
        self.patches[patch]
    }

    /// The number of the patch that is a wall.
    pub fn wall(&self, mesh: &dyn MeshStream, wall: u32) -> Option<u32> {
        let mut patches = mesh.patches().iter();
        let at = patches.position(|p| p.label == Label::Wall(wall))?;
        Some(self.patches[at])
    }
}

/// The ids themselves where they can be used, else the next numbers above all of those.
fn positive(ids: impl Iterator<Item = Option<u32>> + Clone) -> Vec<u32> {
    let fits = |id: u32| (1..=LARGEST / 2).contains(&id);
    let largest = ids.clone().flatten().filter(|&id| fits(id)).max();
    let mut next = largest.unwrap_or(0);
    ids.map(|id| match id {
        Some(id) if fits(id) => id,
        _ => {
            next += 1;
            next
        }
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_kept_where_they_can_be() {
        let ids = [Some(0), Some(3), None, Some(u32::MAX - 1), Some(7)];
        assert_eq!(positive(ids.into_iter()), [8, 3, 9, 10, 7]);
        assert_eq!(positive([None, Some(0)].into_iter()), [1, 2]);
    }
}
