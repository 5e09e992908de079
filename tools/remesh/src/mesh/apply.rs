//! Making changes.

use super::change::{Change, Fitted};
use super::{Mesh, NONE};

impl Change {
    /// Several changes of different triangles as one.
    pub fn all(changes: Vec<Self>) -> Self {
        let mut all = Self::default();
        for change in changes {
            all.gone.extend(change.gone);
            all.new.extend(change.new);
            all.chords_gone.extend(change.chords_gone);
            all.chords.extend(change.chords);
            all.joins |= change.joins;
        }
        all
    }

    /// Replaces a vertex by another one in triangles.
    pub fn replacing(mesh: &Mesh<'_>, gone: &[u32], from: u32, to: u32) -> Self {
        let with = |t: &u32| {
            let corners = mesh.triangles[*t as usize];
            let new = corners.map(|v| if v == from { to } else { v });
            let keep = !corners.contains(&to) || from == to;
            keep.then_some((new, mesh.patch[*t as usize]))
        };
        Self {
            new: gone.iter().filter_map(with).collect(),
            gone: gone.to_vec(),
            ..Self::default()
        }
    }
}

impl Mesh<'_> {
    /// Makes a change that was found to fit.
    pub fn apply(&mut self, change: &Change, fitted: Fitted) {
        self.joined += usize::from(change.joins);
        for &t in &change.gone {
            for v in self.triangles[t as usize] {
                self.around[v as usize].retain(|&u| u != t);
            }
            self.triangles[t as usize] = [NONE; 3];
            self.samples[t as usize].clear();
        }
        for (&(corners, patch), samples) in change.new.iter().zip(fitted.samples) {
            let t = self.triangles.len() as u32;
            self.triangles.push(corners);
            self.patch.push(patch);
            self.samples.push(samples);
            corners
                .iter()
                .for_each(|&v| self.around[v as usize].push(t));
        }
        for ends in &change.chords_gone {
            self.features.remove(ends);
            self.on_chords.remove(ends);
        }
        for (&(ends, curve), samples) in change.chords.iter().zip(fitted.on_chords) {
            self.features.insert(ends, curve);
            self.loose[curve as usize] |= change.joins;
            self.on_chords.insert(ends, samples);
        }
    }
}
