//! The region between a body and its outer boundary.

use super::fluid::{keep_only, name_of};
use super::outline::{Content, Enclosure, Impossible, Outline};
use super::surface::Part;
use geom::measure::{area_of_region, corners, double_area_vector, tet_volume};
use glam::DVec3;
use tmesh::{Document, Marker, OUTSIDE, Region, Symmetry, Triangle};

/// Name of the region around a body.
const AIR: &str = "air";
/// Name of the outer boundary.
const BOUNDARY: &str = "enclosure";

/// Adds what is around a body of one template as a region named `air`, up to an outer boundary that is a marker. Where there is no
/// material inside the body, there is air as well, whether or not it is connected to what is outside. The radius that deviations
/// are relative to becomes that of the outer boundary; deviations stay what they are.
///
/// # Errors
/// The enclosure cannot have the symmetry, or is too large; a region named `air`. The document is as it was then.
pub fn fill(
    document: &mut Document,
    symmetry: &mut Symmetry,
    enclosure: Enclosure,
) -> Result<String, Impossible> {
    if document.regions.iter().any(|r| r.name == AIR) {
        return Err(Impossible::Taken);
    }
    let outline = Outline::new(document, symmetry, enclosure)?;
    let (vertices, triangles) = outline.surface();
    let largest = vertices
        .iter()
        .fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
    heal::check_scale(&vertices).map_err(|_| Impossible::TooLarge(kit::number(largest)))?;

    let region = free_id(document.regions.iter().map(|r| r.id));
    let marker_of = mark(document, symmetry, enclosure.content);
    let template = &mut document.templates[0];
    for t in &mut template.triangles {
        for side in [&mut t.front, &mut t.back] {
            if *side == OUTSIDE {
                *side = region;
            }
        }
    }
    let first = template.vertices.len() as u32;
    template.vertices.extend(vertices);
    template
        .triangles
        .extend(triangles.into_iter().map(|(t, part)| Triangle {
            vertices: t.map(|v| v + first),
            marker: marker_of(part),
            front: OUTSIDE,
            back: region,
        }));
    let volume = volume_behind(&template.vertices, &template.triangles, region);
    document.regions.push(Region {
        id: region,
        name: AIR.to_owned(),
        size: None,
        volume: Some(volume),
    });
    document.regions.sort_unstable_by_key(|r| r.id);
    document.markers.sort_unstable_by_key(|m| m.id);
    if enclosure.content == Content::Fluid {
        keep_only(document, symmetry, region);
    }
    measure(document, volume, enclosure.content);
    rescale(symmetry, &document.templates[0].vertices);
    let place = match enclosure.content {
        Content::Both => "in",
        Content::Fluid => "left out of the",
    };
    Ok(format!(
        "{place} {AIR} up to {}: region '{AIR}' has the volume {}",
        outline.words(),
        kit::number(volume)
    ))
}

/// Adds the markers of the outer boundary: one, or those of its parts where flow is to enter and to leave; returns which
/// part has which.
fn mark(
    document: &mut Document,
    symmetry: &Symmetry,
    content: Content,
) -> impl Fn(Part) -> u32 + use<> {
    let parts = [Part::Below, Part::Above, Part::Side];
    let names = parts.map(|part| match content {
        Content::Both => BOUNDARY.to_owned(),
        Content::Fluid => format!("{BOUNDARY}-{}", name_of(part, symmetry.group)),
    });
    let mut ids = [0; 3];
    for i in 0..3 {
        if let Some(same) = (0..i).find(|&j| names[j] == names[i]) {
            ids[i] = ids[same];
            continue;
        }
        let id = free_id(document.markers.iter().map(|m| m.id));
        let is_taken = document.markers.iter().any(|m| m.name == names[i]);
        document.markers.push(Marker {
            id,
            name: match is_taken {
                true => format!("{}-{id}", names[i]),
                false => names[i].clone(),
            },
            area: None,
        });
        ids[i] = id;
    }
    move |part| ids[part as usize]
}

/// Writes down how much there is now of what has changed.
fn measure(document: &mut Document, air: f64, content: Content) {
    let template = &document.templates[0];
    let boundary = area_of_region(&template.vertices, template.faces(), OUTSIDE);
    if let Some(source) = &mut document.source {
        source.triangles = template.triangles.len() as u64;
        source.boundary_area = boundary;
        source.volume = match content {
            Content::Both => source.volume + air,
            Content::Fluid => air,
        };
    }
    for marker in document.markers.iter_mut().filter(|m| m.area.is_none()) {
        let own = template.triangles.iter().filter(|t| t.marker == marker.id);
        let area = own.map(|t| {
            let [a, b, c] = corners(&template.vertices, t);
            0.5 * double_area_vector(a, b, c).length()
        });
        marker.area = Some(area.sum());
    }
}

/// An id that is not in a table: the one after the last, or the first that is free where there is none.
fn free_id(ids: impl Iterator<Item = u32> + Clone) -> u32 {
    let next = ids.clone().max().map_or(1, |last| last + 1);
    let is_free = |id: &u32| *id != OUTSIDE && ids.clone().all(|known| known != *id);
    std::iter::once(next)
        .chain(1..)
        .find(is_free)
        .unwrap_or(next)
}

/// Makes deviations relative to the radius of what there is now.
fn rescale(symmetry: &mut Symmetry, vertices: &[DVec3]) {
    let Some(frame) = symmetry.frame() else {
        return;
    };
    let radius = |p: &DVec3| frame.to_canonical(*p).truncate().length();
    let largest = vertices.iter().map(radius).fold(0.0, f64::max);
    let scale = symmetry.radius / largest;
    symmetry.residual *= scale;
    symmetry.tolerance *= scale;
    symmetry.radius = largest;
}

/// Volume of a region by the divergence theorem.
fn volume_behind(vertices: &[DVec3], triangles: &[Triangle], region: u32) -> f64 {
    let origin = vertices.first().copied().unwrap_or_default();
    let signed = triangles.iter().map(|t| {
        let [a, b, c] = corners(vertices, t);
        let sign = f64::from(i8::from(t.back == region) - i8::from(t.front == region));
        sign * tet_volume(origin, a, b, c)
    });
    signed.sum()
}
