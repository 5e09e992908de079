//! About how many elements a size field asks for, before it is folded.

use super::fold::Sectors;
use crate::cubes::{Material, PLACES, place_in_cube};
use glam::DVec3;
use tmesh::{Document, Size};

/// The largest volume of elements that, everywhere in a template, would ask for as many of them as the document's size field does, model
/// units cubed; `None` without a field, or where that has no tetrahedra in the body.
///
/// Copies that the field wants different elements in count by their mean, and the gradation is left out: this is for forecasts. Linear
/// in the field.
pub fn mean_volume((document, index): (&Document, usize), volume: f64) -> Option<f64> {
    Some(Size::OF_CUBE * volume / mean_cubes((document, index))?)
}

/// Cubes of the lengths wanted in a copy of a template, in the mean; `None` as of [`mean_volume`].
pub fn mean_cubes((document, index): (&Document, usize)) -> Option<f64> {
    let field = document.size_field.as_ref()?;
    let corners = |tet: &[u32; 4]| tet.map(|v| field.points[v as usize]);
    let each = |tet: &[u32; 4]| {
        let [a, b, c, d] = corners(tet);
        let [u, v, w] = [b, c, d].map(|p| p.position - a.position);
        let size = 0.25 * (a.size + b.size + c.size + d.size);
        u.dot(v.cross(w)).abs() / 6.0 / size.powi(3)
    };
    let all: f64 = field.tets.iter().map(each).sum();
    if !(all > 0.0 && all.is_finite()) {
        return None;
    }
    let sectors = Sectors::new(document, index);
    let material = Material::new(&document.templates[index]);
    let rays = material.rays();
    let mut images = Vec::new();
    let mut is_inside = |p: DVec3| {
        sectors.meeting(&[p], 0.0, &mut images);
        let mut there = images.iter().map(|&i| sectors.places[i as usize].apply(p));
        there.any(|p| material.is_at(&rays, p))
    };
    let (mut passed, mut next, mut inside) = (0.0, 0, 0);
    for tet in &field.tets {
        passed += each(tet);
        while next < PLACES && (next as f64 + 0.5) * all <= passed * PLACES as f64 {
            // What sorted numbers leave between them divides a tetrahedron evenly.
            let mut parts = place_in_cube(next).to_array();
            parts.sort_by(f64::total_cmp);
            let [x, y, z] = parts;
            let [a, b, c, d] = corners(tet).map(|p| p.position);
            let place = a * x + b * (y - x) + c * (z - y) + d * (1.0 - z);
            inside += usize::from(is_inside(document.frame.to_canonical(place)));
            next += 1;
        }
    }
    let copies = sectors.places.len().max(1) as f64;
    (inside > 0).then(|| all * inside as f64 / PLACES as f64 / copies)
}
