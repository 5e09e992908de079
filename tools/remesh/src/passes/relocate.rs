//! Moving vertices along the surface.

use super::worth::{GAIN, GOOD};
use crate::mesh::{Change, Mesh};
use crate::shape::Near;
use geom::measure::triangle_area;
use glam::DVec3;

/// Moves a vertex to the middle of what is around it, along the surface or along its curve, if the worst of its triangles
/// gets no worse.
pub fn relocate(mesh: &mut Mesh<'_>, v: u32) -> bool {
    if mesh.fixed[v as usize] || mesh.images.has(v) || mesh.around(v).is_empty() {
        return false;
    }
    let along = mesh.along(v);
    let target = match along[..] {
        [] => on_surface(mesh, v),
        [(a, curve), (b, other)] if curve == other => {
            let middle = 0.5 * (mesh.points[a as usize] + mesh.points[b as usize]);
            mesh.envelope.nearest(Near::Curve(curve), middle)
        }
        _ => None,
    };
    let Some(target) = target.and_then(|p| mesh.rules.put(mesh.bound[v as usize], p)) else {
        return false;
    };
    let old = mesh.points[v as usize];
    let gone = mesh.around(v).to_vec();
    let before = mesh.worst(&gone);
    let mut change = Change::replacing(mesh, &gone, v, v);
    change.moved = Some((v, old));
    for &(w, curve) in &along {
        let key = [v.min(w), v.max(w)];
        change.chords_gone.push(key);
        change.chords.push((key, curve));
    }
    mesh.points[v as usize] = target;
    let after = change
        .new
        .iter()
        .map(|&(t, patch)| mesh.quality_of(t, patch));
    let after = after.fold(1.0, f64::min);
    let is_better = after > before + GAIN || (after >= GOOD && before >= GOOD);
    let fitted = match is_better {
        true => mesh.fit(&change),
        false => None,
    };
    match fitted {
        Some(fitted) => {
            mesh.apply(&change, fitted);
            true
        }
        None => {
            mesh.points[v as usize] = old;
            false
        }
    }
}

/// The middle of the triangles around a vertex, weighted by area over the square of the size wanted, on the surface.
fn on_surface(mesh: &Mesh<'_>, v: u32) -> Option<DVec3> {
    let first = *mesh.around(v).first()?;
    let patch = mesh.patch[first as usize];
    if mesh.planes[patch as usize].is_some() {
        return None;
    }
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for &t in mesh.around(v) {
        let corners = mesh.triangles[t as usize];
        let [a, b, c] = corners.map(|v| mesh.points[v as usize]);
        let size: f64 = corners.iter().map(|&v| mesh.size[v as usize]).sum();
        let weight = triangle_area(a, b, c) / (size * size);
        sum += (a + b + c) / 3.0 * weight;
        weights += weight;
    }
    if weights <= 0.0 || !weights.is_finite() {
        return None;
    }
    mesh.envelope.nearest(Near::Patch(patch), sum / weights)
}
