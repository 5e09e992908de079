//! What operations do to regions.

use crate::budget::SCAN;
use crate::shape::{Motion, NO_CLASS, Permutation, Shape};
use crate::verify::deviation::{Bound, Deviation};
use rustc_hash::FxHashMap;

impl Shape {
    /// The permutation of regions an operation makes, by votes of the triangles that images land on;
    /// `None` when the votes are no permutation or outside does not stay outside.
    pub fn vote(&self, motion: &Motion, bound: Bound) -> Option<Permutation> {
        let n = self.region_count();
        let mut votes: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        let mut asked = vec![0; self.interfaces.classes.len()];
        for sample in &self.samples.faces {
            let asked = &mut asked[self.interfaces.class[sample.triangle as usize] as usize];
            if *asked == SCAN {
                continue;
            }
            *asked += 1;
            let from = sample.triangle as usize;
            let normal = motion.linear * self.normals[from];
            let image = (motion.apply(sample.point), normal);
            let within = (bound.limit, bound.facets);
            let Some(hit) = self.nearest_alike(image, sample.triangle, within) else {
                continue;
            };
            let to = hit.triangle as usize;
            let cosine = self.normals[to].dot(normal);
            let ([a, b], [c, d]) = (self.interfaces.sides[from], self.interfaces.sides[to]);
            let (c, d) = if cosine > 0.0 { (c, d) } else { (d, c) };
            *votes.entry([a, c]).or_default() += 1;
            *votes.entry([b, d]).or_default() += 1;
        }
        let mut best: Vec<(u32, u32)> = vec![(0, NO_CLASS); n];
        for (&[from, to], &count) in &votes {
            let b = &mut best[from as usize];
            // Ties go to the lower region, so that the order of the table does not matter.
            if count > b.0 || (count == b.0 && to < b.1) {
                *b = (count, to);
            }
        }
        let last = n as u32 - 1;
        let permutation = Permutation::new(best.iter().map(|b| b.1).collect())?;
        (permutation.get(last) == last).then_some(permutation)
    }

    /// Runs `check` with regions in place; should that fail, with the permutation of regions that the motion makes. Without regions, what is
    /// near another solid lands on that instead of where it belongs, and tells nothing.
    pub fn with_permutation(
        &self,
        motion: Motion,
        bound: Bound,
        check: impl Fn(&Permutation) -> Result<Deviation, Deviation>,
    ) -> Result<(Deviation, Permutation), Deviation> {
        let identity = Permutation::identity(self.region_count());
        let failed = match check(&identity) {
            Ok(deviation) => return Ok((deviation, identity)),
            Err(failed) => failed,
        };
        if self.may_exchange
            && self.region_count() > 2
            && let Some(permutation) = self.vote(&motion, bound)
            && !permutation.is_identity()
            && let Ok(deviation) = check(&permutation)
        {
            return Ok((deviation, permutation));
        }
        Err(failed)
    }
}
