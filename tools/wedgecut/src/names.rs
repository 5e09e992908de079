//! Whether the names of boundary pieces survive where copies of a wedge make the body.

use glam::DVec3;
use std::collections::BTreeMap;
use tmesh::{Document, Template};

/// A part in whole percents, as messages tell it; what is less is not told apart.
fn percents(part: f64) -> f64 {
    (100.0 * part).round()
}

/// Whether the mirror plane across the axis maps every boundary piece onto itself, as far as their centres
/// tell: half a body has only the names of its half. The plane is through `origin` across `axis`.
pub fn keeps_names(body: &Template, origin: DVec3, axis: DVec3) -> bool {
    // Area of each piece, and its moment about the plane.
    let mut pieces: BTreeMap<u32, (f64, f64)> = BTreeMap::new();
    let mut extent = 0.0_f64;
    for triangle in &body.triangles {
        let corners = geom::measure::corners(&body.vertices, triangle);
        let [a, b, c] = corners;
        let area = geom::measure::triangle_area(a, b, c);
        let heights = corners.map(|p| (p - origin).dot(axis));
        extent = heights.iter().fold(extent, |m, h| m.max(h.abs()));
        let piece = pieces.entry(triangle.marker).or_default();
        piece.0 += area;
        piece.1 += area * heights.iter().sum::<f64>() / 3.0;
    }
    let is_centred = |&(area, moment): &(f64, f64)| {
        area * extent == 0.0 || percents(moment / (area * extent)) == 0.0
    };
    pieces.len() < 2 || pieces.values().all(is_centred)
}

/// What the copies of a wedge do to boundary pieces that differ from sector to sector: a sentence, if there are
/// any. Every copy has the names of the sector that was cut.
pub fn lost(wedge: &Document) -> Option<String> {
    let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
    for (index, template) in wedge.templates.iter().enumerate() {
        let copies = wedge
            .instances
            .iter()
            .filter(|i| i.template as usize == index);
        let copies = copies.count() as f64;
        for triangle in &template.triangles {
            let [a, b, c] = geom::measure::corners(&template.vertices, triangle);
            *areas.entry(triangle.marker).or_default() +=
                copies * geom::measure::triangle_area(a, b, c);
        }
    }
    let differ: Vec<(&str, f64)> = (wedge.markers.iter())
        .filter_map(|m| {
            let now = areas.get(&m.id).copied().unwrap_or(0.0);
            let area = m.area.filter(|area| *area > 0.0)?;
            (percents(now / area) != percents(1.0)).then_some((m.name.as_str(), now / area))
        })
        .collect();
    let (name, part) = differ.first()?;
    let others = match differ.len() {
        1 => String::new(),
        n => format!(" ({} pieces in all)", n),
    };
    Some(format!(
        "boundary pieces differ from sector to sector, and all copies get the names of one: \"{name}\" has {:.0} % \
         of its area in the copies of the wedge{others}; to keep the names, name sectors alike or cut with a lower \
         --order (1 keeps all)",
        percents(*part)
    ))
}
