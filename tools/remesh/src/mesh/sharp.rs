//! Angles between triangles at edges.

use super::Mesh;
use super::change::Change;
use glam::DVec3;

impl Mesh<'_> {
    /// Whether a change leaves no edge at which triangles meet in a smaller angle than asked for, but where it replaces one with an
    /// angle as small.
    pub fn keeps_angles(&self, change: &Change) -> bool {
        let was = |v: u32| self.before(change, v);
        let is = |v: u32| self.points[v as usize];
        let corners = |t: &u32| self.triangles[*t as usize];
        let stays = |t: &u32| !change.gone.contains(t);
        let new: Vec<[u32; 3]> = change.new.iter().map(|n| n.0).collect();
        let after = edges(&new).map(|[a, b]| {
            let new = new.iter().filter(|t| t.contains(&a) && t.contains(&b));
            let around = self.at_edge(a, b).into_iter();
            let old = around.filter(stays).map(|t| corners(&t));
            cosine_of_sharpest([a, b], old.chain(new.copied()), is)
        });
        let after = after.fold(-1.0, f64::max);
        after <= libm::cos(self.rules.sharp) || {
            let gone: Vec<[u32; 3]> = change.gone.iter().map(corners).collect();
            let before = edges(&gone).map(|[a, b]| {
                let around = self.at_edge(a, b).into_iter();
                cosine_of_sharpest([a, b], around.map(|t| corners(&t)), was)
            });
            after <= before.fold(-1.0, f64::max)
        }
    }
}

/// The edges of triangles, each as often as there is a triangle.
fn edges(triangles: &[[u32; 3]]) -> impl Iterator<Item = [u32; 2]> {
    let each = |[a, b, c]: &[u32; 3]| [[*a, *b], [*b, *c], [*c, *a]];
    triangles.iter().flat_map(each)
}

/// The cosine of the smallest angle between triangles at an edge.
fn cosine_of_sharpest(
    [a, b]: [u32; 2],
    triangles: impl Iterator<Item = [u32; 3]>,
    at: impl Fn(u32) -> DVec3,
) -> f64 {
    let along = (at(b) - at(a)).normalize_or_zero();
    let across = triangles.map(|corners| {
        // The one that is neither end.
        let apex = corners.into_iter().find(|&v| v != a && v != b);
        let away = apex.map_or(DVec3::ZERO, |v| at(v) - at(a));
        away.reject_from_normalized(along).normalize_or_zero()
    });
    let across: Vec<DVec3> = across.collect();
    let mut cosine = -1.0_f64;
    for (i, d) in across.iter().enumerate() {
        for e in &across[..i] {
            cosine = cosine.max(d.dot(*e));
        }
    }
    cosine
}
