//! A welded surface in groups.

use glam::DVec3;

/// No solid.
pub const NONE: u32 = u32::MAX;

/// A welded surface whose triangles belong to solids.
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
    /// Names of the groups, unique.
    pub groups: Vec<String>,
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
    }

    /// Drops triangles that name a point twice; returns how many.
    pub fn drop_degenerate(&mut self) -> usize {
        let before = self.triangles.len();
        let good = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[0] != t[2];
        if !self.triangles.iter().all(good) {
            let keep: Vec<bool> = self.triangles.iter().map(good).collect();
            self.retain(|t| keep[t]);
        }
        before - self.triangles.len()
    }
}
