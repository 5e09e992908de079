//! Flipping edges.

use super::worth::GAIN;
use crate::mesh::{Change, Mesh};

/// Replaces an edge by the other diagonal of the two triangles at it, if the worse of them gets better.
pub fn flip(mesh: &mut Mesh<'_>, [a, b]: [u32; 2]) -> bool {
    let stays = |v: u32| mesh.held[v as usize] || mesh.images.has(v);
    if mesh.curve(a, b).is_some() || stays(a) && stays(b) {
        return false;
    }
    let [s, t] = mesh.at_edge(a, b)[..] else {
        return false;
    };
    let patch = mesh.patch[s as usize];
    let apex = |t: u32| {
        let corners = mesh.triangles[t as usize];
        corners.into_iter().find(|&v| v != a && v != b)
    };
    let (Some(c), Some(d)) = (apex(s), apex(t)) else {
        return false;
    };
    if c == d || mesh.neighbours(c).binary_search(&d).is_ok() {
        return false;
    }
    let with = |t: u32, from: u32, to: u32| {
        let corners = mesh.triangles[t as usize];
        (corners.map(|v| if v == from { to } else { v }), patch)
    };
    let change = Change {
        new: vec![with(s, a, d), with(t, b, c)],
        gone: vec![s, t],
        ..Change::default()
    };
    let after = change.new.iter().map(|new| mesh.shape_of(new.0));
    let before = mesh.worst_shape(&change.gone);
    if after.fold(1.0, f64::min) <= before + before.min(GAIN) {
        return false;
    }
    let Some(fitted) = mesh.fit(&change) else {
        return false;
    };
    mesh.apply(&change, fitted);
    true
}
