//! From triangles in groups to a document.

use crate::soup::Soup;
use crate::{Imported, ReadError};
use geom::edges::Edges;
use geom::measure::{boundary_area, region_volume, triangle_area};
use glam::DVec3;
use tmesh::{Document, Marker, OUTSIDE, Region, Source, Template, Triangle};

/// Builds the document of a surface: welded, closed, with a region on the inside.
///
/// # Errors
/// Surfaces that do not bound a body.
pub fn build(mut soup: Soup, format: &'static str) -> Result<Imported, ReadError> {
    soup.triangles
        .retain(|t| t[0] != t[1] && t[1] != t[2] && t[0] != t[2]);
    if soup.triangles.is_empty() {
        return Err(ReadError::BadSurface("it has no triangles".to_owned()));
    }
    check_closed(&soup.points, &soup.triangles)?;
    let mut template = Template {
        triangles: soup
            .triangles
            .iter()
            .map(|&vertices| Triangle {
                vertices,
                marker: 1,
                front: OUTSIDE,
                back: 1,
            })
            .collect(),
        vertices: soup.points,
        ..Template::default()
    };
    let mut notices = soup.notices;
    if region_volume(&template, 1) < 0.0 {
        for t in &mut template.triangles {
            t.vertices.swap(1, 2);
        }
        notices.push("the surface is oriented inwards: turned over".to_owned());
    }
    let name = match soup.groups.first() {
        Some(g) if !g.name.is_empty() => g.name.clone(),
        _ => "region1".to_owned(),
    };
    let volume = region_volume(&template, 1);
    let area: f64 = template
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
            triangle_area(a, b, c)
        })
        .sum();
    let extent = largest_coordinate(&template.vertices);
    let source = Source {
        format: format.to_owned(),
        triangles: template.triangles.len() as u64,
        volume,
        boundary_area: boundary_area(&template),
        precision: soup.relative_precision * extent,
    };
    let mut document = Document::single(template);
    document.regions = vec![Region {
        id: 1,
        name: name.clone(),
        max_volume: None,
        volume: Some(volume),
    }];
    document.markers = vec![Marker {
        id: 1,
        name,
        area: Some(area),
    }];
    document.source = Some(source);
    Ok(Imported { document, notices })
}

fn largest_coordinate(points: &[DVec3]) -> f64 {
    points
        .iter()
        .fold(0.0_f64, |m, p| m.max(p.abs().max_element()))
}

fn check_closed(points: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ReadError> {
    let edges = Edges::new(triangles);
    let mut open = (0..edges.len()).filter(|&e| edges.around(e).len() % 2 == 1);
    if let Some(first) = open.next() {
        let count = 1 + open.count();
        let [a, b] = edges.ends[first].map(|v| points[v as usize]);
        return Err(ReadError::BadSurface(format!(
            "the surface is not closed: {count} open edge{}, the first from ({}, {}, {}) to ({}, \
             {}, {})",
            if count == 1 { "" } else { "s" },
            a.x,
            a.y,
            a.z,
            b.x,
            b.y,
            b.z
        )));
    }
    Ok(())
}
