//! What meshing must not change: the volume of each region and the area of each wall.

use geom::measure::{corners, tet_volume, triangle_area};
use mesher::{FLATNESS, NO_FACE, Plc};
use std::collections::BTreeMap;
use tmesh::{Document, OUTSIDE, Template};

/// Compares the filled template with the surface it was made from.
///
/// Uneven facets (see [`mesher::Facets`]) may be triangulated anew, which moves volume by no more
/// than their area times their unevenness.
pub fn measures(
    document: &Document,
    plc: &Plc,
    faces: &[u32],
    filled: &Template,
) -> Result<(), String> {
    let input = &document.templates[plc.template];
    let slack: f64 = plc
        .facets
        .facets
        .iter()
        .map(|f| 2.0 * f.area * f.deviation)
        .sum();

    let mut volumes: BTreeMap<u32, (f64, f64)> = BTreeMap::new();
    let origin = input.vertices[plc.vertex_of_point[0] as usize];
    for t in &input.triangles {
        let [a, b, c] = corners(&input.vertices, t);
        let cone = tet_volume(origin, a, b, c);
        for (region, part) in [(t.back, cone), (t.front, -cone)] {
            if region != OUTSIDE {
                volumes.entry(region).or_default().0 += part;
            }
        }
    }
    for t in &filled.tets {
        let [a, b, c, d] = t.vertices.map(|v| filled.vertices[v as usize]);
        volumes.entry(t.region).or_default().1 += tet_volume(a, b, c, d);
    }
    for (region, (before, after)) in volumes {
        let allowed = FLATNESS * before.abs() + slack + rounding(plc, 3);
        if !within(before, after, allowed) {
            return Err(format!(
                "region {region} has the volume {after:.12e}, its surface encloses {before:.12e} \
                 (allowed difference {allowed:.1e})"
            ));
        }
    }

    let mut areas: BTreeMap<u32, (f64, f64)> = BTreeMap::new();
    let keys = plc.faces.of_triangle.iter();
    for (t, &key) in input.triangles.iter().zip(keys) {
        let [a, b, c] = corners(&input.vertices, t);
        areas.entry(key).or_default().0 += triangle_area(a, b, c);
    }
    for (t, &key) in filled.triangles.iter().zip(faces) {
        let [a, b, c] = corners(&filled.vertices, t);
        areas.entry(key).or_default().1 += triangle_area(a, b, c);
    }
    areas.remove(&NO_FACE);
    for (key, (before, after)) in areas {
        let allowed = FLATNESS * before + rounding(plc, 2);
        if !within(before, after, allowed) {
            let wall = input.gluings.get((key as usize - 1) / 2);
            let name = wall.map_or("hub", |w| w.name.as_str());
            return Err(format!(
                "wall '{name}' has the area {after:.12e}, it had {before:.12e}"
            ));
        }
    }
    Ok(())
}

/// False for NaN, too.
fn within(before: f64, after: f64, allowed: f64) -> bool {
    (after - before).abs() <= allowed
}

/// Rounding of a sum of volumes (`power` 3) or areas (2), whatever they cancel to.
fn rounding(plc: &Plc, power: i32) -> f64 {
    1e-15 * plc.extent.powi(power)
}
