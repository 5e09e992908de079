//! Moves of the surface, carried into the volume.

use super::nodes::{Bound, Nodes};
use glam::DVec3;
use tmesh::Document;

/// How many times moves are averaged: so many layers of elements share what the surface moves. A choice: facets hide little
/// more than the elements beside them are high, which a few layers can share, and each more is one pass over all elements.
const PASSES: usize = 12;

impl Nodes<'_> {
    /// Moves the vertices whose moves are not known by the mean of those they are next to (Jacobi's method for the Laplace
    /// equation of the graph), and points on edges with the ends of these. Linear.
    pub fn carry(&mut self, document: &Document) {
        let is_moved = |moves: &Vec<DVec3>| moves.iter().any(|m| *m != DVec3::ZERO);
        if self.moves.iter().any(is_moved) {
            for _ in 0..PASSES {
                self.pass(document);
            }
        }
        self.follow_ends();
    }

    fn pass(&mut self, document: &Document) {
        let mut sums: Vec<Vec<(DVec3, f64)>> = (self.moves.iter())
            .map(|m| vec![(DVec3::ZERO, 0.0); m.len()])
            .collect();
        for (t, template) in document.templates.iter().enumerate() {
            for tet in &template.tets {
                let moves = tet.vertices.map(|v| self.moves[t][v as usize]);
                let sum: DVec3 = moves.iter().sum();
                for (&v, &own) in tet.vertices.iter().zip(&moves) {
                    let (all, weight) = &mut sums[t][v as usize];
                    *all += sum - own;
                    *weight += 3.0;
                }
            }
        }
        for shared in self.roots.shared.iter().filter(|s| s.own != s.root) {
            let (sum, weight) = sums[shared.own.0][shared.own.1 as usize];
            let all = &mut sums[shared.root.0][shared.root.1 as usize];
            all.0 += shared.offset.inverse().apply(sum);
            all.1 += weight;
        }
        for (t, sums) in sums.iter().enumerate() {
            for (v, &(sum, weight)) in sums.iter().enumerate().take(self.vertices(t)) {
                if self.bounds[t][v] != Bound::Known && weight > 0.0 {
                    self.moves[t][v] = self.within((t, v as u32), sum / weight);
                }
            }
        }
        self.spread();
    }

    /// Moves points on edges, where it is not known how, with the ends of these.
    pub fn follow_ends(&mut self) {
        for t in 0..self.moves.len() {
            let first = self.vertices(t);
            for i in 0..self.ends[t].len() {
                if self.bounds[t][first + i] != Bound::Known {
                    self.moves[t][first + i] = self.mean(t, self.ends[t][i]);
                }
            }
        }
    }
}
