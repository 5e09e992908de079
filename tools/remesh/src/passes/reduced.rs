//! A surface that something was left out of, with what it must keep, for what is done to it next.

use super::remeshed::Remeshed;
use crate::input::{Link, Rules};
use crate::mesh::NONE;
use std::sync::Arc;

/// A surface that something was left out of, with what it must keep.
pub struct Reduced {
    /// What is left of it.
    pub remeshed: Remeshed,
    held: Vec<bool>,
    nearer: Vec<f64>,
    noise: f64,
    links: Vec<Link>,
}

impl Reduced {
    /// What is left under some rules, where the surface may move so far at each vertex that there was, model units.
    pub fn new(remeshed: Remeshed, rules: &Rules<'_>, nearer: &[f64]) -> Self {
        let count = remeshed.surface.points.len();
        let mut reduced = Self {
            held: vec![false; count],
            nearer: vec![rules.deviation; count],
            noise: nearer.iter().copied().fold(rules.noise, f64::min),
            links: Vec::new(),
            remeshed,
        };
        for (v, &new) in reduced.remeshed.vertices.iter().enumerate() {
            if new != NONE {
                // Several may have become one.
                let new = new as usize;
                reduced.held[new] |= rules.held[v];
                reduced.nearer[new] = reduced.nearer[new].min(nearer[v]);
            }
        }
        let left = |v: u32| reduced.remeshed.vertices[v as usize];
        for link in rules.links {
            let pairs = link.pairs.iter().map(|pair| pair.map(left));
            // What went, went together.
            let mut pairs: Vec<[u32; 2]> = pairs.filter(|pair| !pair.contains(&NONE)).collect();
            pairs.sort_unstable();
            pairs.dedup();
            reduced.links.push(Link {
                pairs,
                labels: link.labels.clone(),
                image: Arc::clone(&link.image),
                back: Arc::clone(&link.back),
            });
        }
        reduced
    }

    /// What must stay of what is left.
    pub fn rules<'a>(&'a self, rules: &Rules<'a>) -> Rules<'a> {
        Rules {
            held: &self.held,
            bound: &self.remeshed.bound,
            links: &self.links,
            nearer: &self.nearer,
            noise: self.noise,
            ..*rules
        }
    }

    /// What became of the input, where this became of what is left.
    pub fn then(&self, mut remeshed: Remeshed) -> Remeshed {
        let through = |first: &[u32], second: &[u32]| {
            let each = first.iter();
            each.map(|&i| second.get(i as usize).copied().unwrap_or(NONE))
                .collect()
        };
        remeshed.vertices = through(&self.remeshed.vertices, &remeshed.vertices);
        remeshed.triangles = through(&self.remeshed.triangles, &remeshed.triangles);
        remeshed.told.collapsed += self.remeshed.told.collapsed;
        remeshed.told.flipped += self.remeshed.told.flipped;
        remeshed.told.moved += self.remeshed.told.moved;
        remeshed
    }
}
