//! What meshing must not change: the volume of each region and the area of each wall.

use geom::measure::{Areas, corners, tet_volume, triangle_area};
use mesher::{NO_FACE, Plc};
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Template};

/// A measure before and after, and how much it changes for each unit of length that its boundary is off.
#[derive(Default)]
struct Measure {
    before: f64,
    after: f64,
    boundary: f64,
}

/// A wall before and after.
#[derive(Default)]
struct Wall {
    before: Areas,
    after: Areas,
}

impl Wall {
    /// Whether it is the same but for a boundary that is off by `distance`, and flat if it was; not for NaN.
    fn is_kept(&self, distance: f64) -> bool {
        let slack = self.before.edges * distance;
        self.after.vector.distance(self.before.vector) <= slack
            && (self.after.is_flat(distance) || !self.before.is_flat(distance))
    }
}

impl Measure {
    /// Whether it is the same but for a boundary that is off by `distance`, and for `slack`; not for NaN.
    fn is_kept(&self, distance: f64, slack: f64) -> bool {
        (self.after - self.before).abs() <= self.boundary * distance + slack
    }
}

/// Compares the volumes of a filled template's regions with those that a surface encloses.
///
/// Uneven facets (see [`mesher::Facets`]) may be triangulated anew, which moves volume by no more
/// than their area times their unevenness.
pub fn volumes(input: &Template, plc: &Plc, filled: &Template) -> Result<(), String> {
    let slack: f64 = plc
        .facets
        .facets
        .iter()
        .map(|f| 2.0 * f.area * f.deviation)
        .sum();

    let mut volumes: BTreeMap<u32, Measure> = BTreeMap::new();
    let origin = input.vertices.first().copied().unwrap_or_default();
    for t in &input.triangles {
        let [a, b, c] = corners(&input.vertices, t);
        let cone = tet_volume(origin, a, b, c);
        for (region, part) in [(t.back, cone), (t.front, -cone)] {
            if region != OUTSIDE {
                let volume = volumes.entry(region).or_default();
                volume.before += part;
                volume.boundary += triangle_area(a, b, c);
            }
        }
    }
    for t in &filled.tets {
        let [a, b, c, d] = t.vertices.map(|v| filled.vertices[v as usize]);
        volumes.entry(t.region).or_default().after += tet_volume(a, b, c, d);
    }
    for (region, volume) in volumes {
        if !volume.is_kept(plc.rounding, slack) {
            return Err(format!(
                "region {region} has the volume {:.12e}, its surface encloses {:.12e} \
                 (allowed difference {:.1e})",
                volume.after,
                volume.before,
                volume.boundary * plc.rounding + slack
            ));
        }
    }
    Ok(())
}

/// Compares the walls of a filled template with those of the surface it was made from; `faces` has the face of each triangle.
pub fn walls(input: &Template, plc: &Plc, faces: &[u32], filled: &Template) -> Result<(), String> {
    let mut areas: BTreeMap<u32, Wall> = BTreeMap::new();
    let keys = plc.faces.of_triangle.iter();
    for (t, &key) in input.triangles.iter().zip(keys) {
        let area = areas.entry(key).or_default();
        area.before.add(corners(&input.vertices, t));
    }
    for (t, &key) in filled.triangles.iter().zip(faces) {
        let area = areas.entry(key).or_default();
        area.after.add(corners(&filled.vertices, t));
    }
    areas.remove(&NO_FACE);
    for (key, area) in areas {
        if !area.is_kept(plc.rounding) {
            let wall = input.gluings.get((key as usize - 1) / 2);
            let name = wall.map_or("hub", |w| w.name.as_str());
            return Err(format!(
                "wall '{name}' has the area {:.12e}, it had {:.12e}",
                area.after.area, area.before.area
            ));
        }
    }
    Ok(())
}
