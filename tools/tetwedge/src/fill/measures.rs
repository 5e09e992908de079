//! What meshing must not change: the volume of each region and the area of each wall.

use geom::measure::{corners, double_area_vector, tet_volume, triangle_area};
use glam::DVec3;
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

/// Sums over the triangles of a wall.
#[derive(Default)]
struct Sum {
    /// Their vector areas, on which the border of the wall alone decides.
    vector: DVec3,
    /// Their areas: the length of that vector, if the wall is flat.
    area: f64,
}

impl Sum {
    fn add(&mut self, [a, b, c]: [DVec3; 3]) {
        let vector = double_area_vector(a, b, c) * 0.5;
        self.vector += vector;
        self.area += vector.length();
    }

    /// Whether it is flat, without triangles that are folded over others, but for `slack`.
    fn is_flat(&self, slack: f64) -> bool {
        self.area - self.vector.length() <= slack
    }
}

/// A wall before and after, and the length of its triangles' edges.
#[derive(Default)]
struct Wall {
    before: Sum,
    after: Sum,
    boundary: f64,
}

impl Wall {
    /// Whether it is the same but for a boundary that is off by `distance`, and flat if it was; not for NaN.
    fn is_kept(&self, distance: f64) -> bool {
        let slack = self.boundary * distance;
        self.after.vector.distance(self.before.vector) <= slack
            && (self.after.is_flat(slack) || !self.before.is_flat(slack))
    }
}

impl Measure {
    /// Whether it is the same but for a boundary that is off by `distance`, and for `slack`; not for NaN.
    fn is_kept(&self, distance: f64, slack: f64) -> bool {
        (self.after - self.before).abs() <= self.boundary * distance + slack
    }
}

/// Compares the filled template with the surface it was made from.
///
/// Uneven facets (see [`mesher::Facets`]) may be triangulated anew, which moves volume by no more
/// than their area times their unevenness.
pub fn measures(
    input: &Template,
    plc: &Plc,
    faces: &[u32],
    filled: &Template,
) -> Result<(), String> {
    let slack: f64 = plc
        .facets
        .facets
        .iter()
        .map(|f| 2.0 * f.area * f.deviation)
        .sum();

    let mut volumes: BTreeMap<u32, Measure> = BTreeMap::new();
    let origin = input.vertices[plc.vertex_of_point[0] as usize];
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

    let mut areas: BTreeMap<u32, Wall> = BTreeMap::new();
    let keys = plc.faces.of_triangle.iter();
    for (t, &key) in input.triangles.iter().zip(keys) {
        let [a, b, c] = corners(&input.vertices, t);
        let area = areas.entry(key).or_default();
        area.before.add([a, b, c]);
        area.boundary += a.distance(b) + b.distance(c) + c.distance(a);
    }
    for (t, &key) in filled.triangles.iter().zip(faces) {
        let [a, b, c] = corners(&filled.vertices, t);
        areas.entry(key).or_default().after.add([a, b, c]);
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
