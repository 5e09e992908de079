//! Patches that are no wider than the surface may move.

use super::patches::{Patches, UPRIGHT};
use crate::input::{Rules, Surface};
use glam::DVec3;
use rustc_hash::FxHashMap;

impl Patches {
    /// Takes flat faces that are nowhere farther from their border than the surface may be off where it is for what they are parts of where that is
    /// curved: next to something curved, or to another one that is. How they lie means nothing, and held in their planes, strips as an
    /// exporter draws them between two edges of a blade would stay needles. Between flat faces, however narrow, they are a shape of their own,
    /// and what lies in walls or linked faces stays there.
    pub(super) fn leave_strips(&mut self, surface: &Surface, rules: &Rules<'_>) {
        let is_strip = self.strips(surface, rules);
        let mut beside = vec![Vec::new(); self.planes.len()];
        for edge in 0..self.edges.len() {
            let around = self.edges.around(edge).iter();
            let all: Vec<u32> = around.map(|u| self.of[u.triangle as usize]).collect();
            for &p in &all {
                beside[p as usize].extend(all.iter().filter(|&&q| q != p));
            }
        }
        let curved = (0..).zip(&self.planes).filter(|(_, plane)| plane.is_none());
        let mut next: Vec<u32> = curved.map(|(p, _)| p).collect();
        while let Some(p) = next.pop() {
            for &q in &beside[p as usize] {
                if self.planes[q as usize].is_some() && is_strip[q as usize] {
                    self.planes[q as usize] = None;
                    next.push(q);
                }
            }
        }
    }

    /// Takes such strips between flat faces for nothing of their own, too, so that the faces on both sides may meet in their place: a corner that
    /// was cut off by less than the surface may move. Not those across which sides face away from each other, as at the edge of a sheet. Returns
    /// whether there are any, flat ones or others. Linear.
    pub fn open_strips(&mut self, surface: &Surface, rules: &Rules<'_>) -> bool {
        let mut is_open = self.strips(surface, rules);
        if !is_open.contains(&true) {
            return false;
        }
        let sides = self.sides(surface, rules, &is_open);
        let at = |p: u32, v: u32| sides.get(&(p, v)).map_or(&[][..], Vec::as_slice);
        for (edge, &[a, b]) in self.edges.ends.iter().enumerate() {
            for u in self.edges.around(edge) {
                let p = self.of[u.triangle as usize];
                let is_away = |m: &DVec3| at(p, b).iter().any(|n| m.dot(*n) < -UPRIGHT);
                is_open[p as usize] &= !at(p, a).iter().any(is_away);
            }
        }
        for (plane, is_open) in self.planes.iter_mut().zip(&is_open) {
            if *is_open {
                *plane = None;
            }
        }
        is_open.contains(&true)
    }

    /// The normals of what is beside patches, by patch and vertex of its border. What is beyond the ends of a strip may face anywhere, and cuts are
    /// no sides.
    fn sides(
        &self,
        surface: &Surface,
        rules: &Rules<'_>,
        of: &[bool],
    ) -> FxHashMap<(u32, u32), Vec<DVec3>> {
        let widths = self.widths(surface);
        let is_cut = self.cut(surface, rules);
        let mut sides: FxHashMap<(u32, u32), Vec<DVec3>> = FxHashMap::default();
        for (edge, ends) in self.edges.ends.iter().enumerate() {
            let [a, b] = ends.map(|v| surface.points[v as usize]);
            let around = self.edges.around(edge);
            for u in around {
                let p = self.of[u.triangle as usize];
                if !of[p as usize] || a.distance(b) <= widths[p as usize] {
                    continue;
                }
                for v in around {
                    let other = self.of[v.triangle as usize];
                    if other != p && !is_cut[other as usize] {
                        let normal = self.normals[v.triangle as usize];
                        let each = ends.map(|v| (p, v));
                        each.iter()
                            .for_each(|key| sides.entry(*key).or_default().push(normal));
                    }
                }
            }
        }
        sides
    }

    /// Whether each patch is nowhere farther from its border than the surface may move there, and lies in no wall and no linked face.
    pub fn strips(&self, surface: &Surface, rules: &Rules<'_>) -> Vec<bool> {
        let widths = self.widths(surface);
        let is_cut = self.cut(surface, rules);
        let mut moves = vec![rules.deviation; self.planes.len()];
        for (t, &p) in self.of.iter().enumerate() {
            for v in surface.triangles[t] {
                moves[p as usize] = moves[p as usize].min(rules.deviation_at(v as usize));
            }
        }
        let is_strip = |p: usize| widths[p] <= 2.0 * moves[p] && !is_cut[p];
        (0..self.planes.len()).map(is_strip).collect()
    }

    /// Whether each patch lies in a wall or a linked face: where the body was cut.
    pub fn cut(&self, surface: &Surface, rules: &Rules<'_>) -> Vec<bool> {
        let mut walls = vec![u32::MAX; self.planes.len()];
        let mut is_linked = vec![false; self.planes.len()];
        for (t, &p) in self.of.iter().enumerate() {
            let [a, b, c] = surface.triangles[t].map(|v| rules.bound[v as usize]);
            walls[p as usize] &= a & b & c;
            let mut links = rules.links.iter();
            is_linked[p as usize] |= links.any(|link| link.labels.contains(&surface.labels[t]));
        }
        let each = walls.into_iter().zip(is_linked);
        each.map(|(walls, linked)| walls != 0 || linked).collect()
    }

    /// Whether any facet of what is curved is nowhere farther from its border than the surface may move.
    pub fn has_narrow_facets(&self, surface: &Surface, rules: &Rules<'_>) -> bool {
        let widths = self.widths_of(surface, &self.facet);
        let mut facets = self.of.iter().zip(&self.facet);
        facets.any(|(&p, &f)| {
            self.planes[p as usize].is_none() && widths[f as usize] <= 2.0 * rules.deviation
        })
    }
}
