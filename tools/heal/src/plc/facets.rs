//! Facets, triangulated so that they fit together along common segments.

use super::loose;
use super::segments::split_segments;
use crate::HealError;
use crate::document::tolerance;
use crate::facet::{Projection, area_vector};
use crate::meeting::meetings;
use crate::welded::welded;
use crate::words::{dropped, place};
use geom::cdt::{CdtError, triangulate_enclosed};
use glam::DVec3;
use interchange::parsed::{Facet, Plc};
use rustc_hash::FxHashSet;

/// Triangles of all facets, fitting together along common segments.
pub struct Facets {
    /// Distinct points.
    pub points: Vec<DVec3>,
    /// Three points each, in any orientation.
    pub triangles: Vec<[u32; 3]>,
    /// Facet each triangle comes from.
    pub facet_of: Vec<u32>,
}

/// Triangulates all facets. Nodes that lie on segments of other facets split them.
///
/// # Errors
/// Facets that are not planar subdivisions.
pub fn triangulate_facets(plc: &Plc, notices: &mut Vec<String>) -> Result<Facets, HealError> {
    let (points, id) = welded(plc.points.iter().copied(), plc.points.len());
    // Segments of each facet, and what they are split into by nodes that lie on them.
    let segments: Vec<Vec<[u32; 2]>> = plc.facets.iter().map(|f| segments(f, &id)).collect();
    let equal = tolerance(&points, plc.relative_precision).equal();
    let pieces = split_segments(&points, &segments, equal)
        .ok_or_else(|| HealError::BadSurface("too many segments lie close to nodes".to_owned()))?;
    let mut surface = Facets {
        points,
        triangles: Vec::new(),
        facet_of: Vec::new(),
    };
    let parts = |s: &[u32; 2]| match pieces.get(s) {
        Some(chain) => chain.windows(2).map(|w| [w[0], w[1]]).collect(),
        None => vec![*s],
    };
    let segments: Vec<Vec<[u32; 2]>> = segments
        .iter()
        .map(|s| s.iter().flat_map(parts).collect())
        .collect();
    let mut seen = FxHashSet::default();
    let mut flat = 0;
    let mut repeated = 0;
    for (f, facet) in plc.facets.iter().enumerate() {
        let triangles = triangulate_facet(&surface.points, f, facet, &segments[f], &id)?;
        // A facet of single nodes and segments is not meant to have an area.
        let is_face = facet.polygons.iter().any(|p| p.len() > 2);
        flat += usize::from(triangles.is_empty() && is_face);
        for t in triangles {
            let mut key = t;
            key.sort_unstable();
            if seen.insert(key) {
                surface.triangles.push(t);
                surface.facet_of.push(f as u32);
            } else {
                repeated += 1;
            }
        }
    }
    if flat > 0 {
        notices.push(dropped(flat, "facet", "facets", "without area"));
    }
    if repeated > 0 {
        let (one, many) = ("triangle", "triangles");
        notices.push(dropped(
            repeated,
            one,
            many,
            "that two facets have in common",
        ));
    }
    let segments = segments
        .into_iter()
        .flatten()
        .map(|[a, b]| [a.min(b), a.max(b)]);
    notices.extend(loose::notices(
        &surface.points,
        segments,
        &surface.triangles,
    ));
    Ok(surface)
}

/// The facet's segments, each once, lower node first.
fn segments(facet: &Facet, id: &[u32]) -> Vec<[u32; 2]> {
    let mut list = Vec::new();
    for polygon in &facet.polygons {
        let n = polygon.len();
        let sides = if n > 2 { n } else { n.saturating_sub(1) };
        for i in 0..sides {
            let (a, b) = (id[polygon[i] as usize], id[polygon[(i + 1) % n] as usize]);
            if a != b {
                list.push([a.min(b), a.max(b)]);
            }
        }
    }
    list.sort_unstable();
    list.dedup();
    list
}

fn triangulate_facet(
    points: &[DVec3],
    index: usize,
    facet: &Facet,
    segments: &[[u32; 2]],
    id: &[u32],
) -> Result<Vec<[u32; 3]>, HealError> {
    // The largest polygon shows the plane.
    let normal = facet
        .polygons
        .iter()
        .filter(|p| p.len() > 2)
        .map(|p| {
            let welded: Vec<u32> = p.iter().map(|&v| id[v as usize]).collect();
            area_vector(points, &welded)
        })
        .fold(DVec3::ZERO, |best, n| {
            if n.length_squared() > best.length_squared() {
                n
            } else {
                best
            }
        });
    let Some(project) = Projection::along(normal) else {
        return Ok(Vec::new());
    };
    let mut nodes: Vec<u32> = segments
        .iter()
        .flatten()
        .copied()
        .chain(
            facet
                .polygons
                .iter()
                .filter(|p| p.len() == 1)
                .map(|p| id[p[0] as usize]),
        )
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    let local = |v: u32| nodes.partition_point(|&n| n < v) as u32;
    let flat: Vec<[f64; 2]> = nodes
        .iter()
        .map(|&v| project.flat(points[v as usize]))
        .collect();
    let segments: Vec<[u32; 2]> = segments.iter().map(|s| s.map(local)).collect();
    let holes: Vec<[f64; 2]> = facet.holes.iter().map(|&h| project.flat(h)).collect();
    let triangles = triangulate_enclosed(&flat, &segments, &holes).map_err(|error| {
        let at = |v: u32| place(points[nodes[v as usize] as usize]);
        let reason = match error {
            CdtError::Coincident(a, b) => format!(
                "{} and {} lie above each other, so it is not planar",
                at(a),
                at(b)
            ),
            CdtError::Crossing(a, b) => format!(
                "the segment from {} to {} crosses another one",
                at(a),
                at(b)
            ),
            _ => "its coordinates are too large or too small".to_owned(),
        };
        HealError::BadSurface(format!("facet {} (counted from 1): {reason}", index + 1))
    })?;
    Ok(triangles
        .into_iter()
        .map(|t| t.map(|v| nodes[v as usize]))
        .collect())
}

/// Refuses facets that meet where they have no common segments and nodes.
pub fn check_crossing(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    facet_of: &[u32],
) -> Result<(), HealError> {
    let facet = |t: u32| facet_of[t as usize];
    match meetings(points, triangles, facet, |_| true).lowest {
        None => Ok(()),
        Some(contact) => {
            let [a, b] = contact.triangles.map(|t| facet_of[t as usize] + 1);
            Err(HealError::BadSurface(format!(
                "facets {} and {} (counted from 1) cross or touch at {}, away from their common \
                 nodes and segments",
                a.min(b),
                a.max(b),
                place(contact.point)
            )))
        }
    }
}
