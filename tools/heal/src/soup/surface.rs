//! A welded surface in groups.

use glam::DVec3;

/// No solid.
pub const NONE: u32 = u32::MAX;

/// A welded surface whose triangles belong to solids.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Distinct points.
    pub points: Vec<DVec3>,
    /// Three different point ids each.
    pub triangles: Vec<[u32; 3]>,
    /// Group of each triangle, as in the file.
    pub group: Vec<u32>,
    /// Solid of each triangle: its group, or 0 when the groups are pieces of one boundary.
    pub solid: Vec<u32>,
    /// The solid on the other side of an interface, or [`NONE`].
    pub partner: Vec<u32>,
    /// The triangle that each one is, or is a part of, before corners were joined and edges divided.
    pub source: Vec<u32>,
    /// Names of the groups, unique.
    pub groups: Vec<String>,
    /// Names of the solids, unique: those of the groups, or one for all.
    pub solids: Vec<String>,
    /// What a group is called in the file format.
    pub group_word: &'static str,
}

impl Surface {
    /// Positions of a triangle's corners.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.points[v as usize])
    }

    /// A group's name for a message.
    pub fn group_name(&self, group: u32) -> String {
        format!("{} '{}'", self.group_word, self.groups[group as usize])
    }

    /// A solid's name for a message.
    pub fn solid_name(&self, solid: u32) -> String {
        format!("{} '{}'", self.group_word, self.solids[solid as usize])
    }

    /// Makes all groups pieces of the boundary of one solid. A lone group lends it its name.
    pub fn make_one_solid(&mut self) {
        self.solid.fill(0);
        self.solids.truncate(1);
        if self.groups.len() > 1 {
            self.solids[0] = "region1".to_owned();
        }
    }

    /// Keeps the triangles that `keep` accepts.
    pub fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        fn filter<T>(list: &mut Vec<T>, keep: impl Fn(usize) -> bool) {
            let mut i = 0;
            list.retain(|_| {
                i += 1;
                keep(i - 1)
            });
        }
        filter(&mut self.triangles, &keep);
        filter(&mut self.group, &keep);
        filter(&mut self.solid, &keep);
        filter(&mut self.partner, &keep);
        filter(&mut self.source, &keep);
    }

    /// Puts parts in the place of a triangle; the first takes its number, the others the last ones.
    pub fn replace(&mut self, triangle: u32, parts: &[[u32; 3]]) {
        let t = triangle as usize;
        let Some((&first, others)) = parts.split_first() else {
            return;
        };
        self.triangles[t] = first;
        for &part in others {
            self.triangles.push(part);
            self.group.push(self.group[t]);
            self.solid.push(self.solid[t]);
            self.partner.push(self.partner[t]);
            self.source.push(self.source[t]);
        }
    }

    /// The triangles of a group, with all points.
    pub fn part(&self, group: u32) -> Self {
        let of = |list: &[u32]| -> Vec<u32> {
            let both = list.iter().zip(&self.group);
            both.filter(|(_, g)| **g == group)
                .map(|(x, _)| *x)
                .collect()
        };
        let both = self.triangles.iter().zip(&self.group);
        Self {
            points: self.points.clone(),
            triangles: both
                .filter(|(_, g)| **g == group)
                .map(|(t, _)| *t)
                .collect(),
            group: of(&self.group),
            solid: of(&self.solid),
            partner: of(&self.partner),
            source: of(&self.source),
            groups: self.groups.clone(),
            solids: self.solids.clone(),
            group_word: self.group_word,
        }
    }

    /// Puts the triangles that `others` has of a group in the place of those here, with the same points.
    pub fn take_group(&mut self, group: u32, others: Self) {
        let keep: Vec<bool> = self.group.iter().map(|&g| g != group).collect();
        self.retain(|t| keep[t]);
        self.triangles.extend(others.triangles);
        self.group.extend(others.group);
        self.solid.extend(others.solid);
        self.partner.extend(others.partner);
        self.source.extend(others.source);
    }

    /// Drops triangles that name a point twice; returns how many, and a corner of the first.
    pub fn drop_collapsed(&mut self) -> Option<(usize, DVec3)> {
        let good = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[0] != t[2];
        let first = self.triangles.iter().find(|t| !good(t))?[0];
        let before = self.triangles.len();
        let keep: Vec<bool> = self.triangles.iter().map(good).collect();
        self.retain(|t| keep[t]);
        let count = before - self.triangles.len();
        Some((count, self.points[first as usize]))
    }
}
