//! From a piecewise linear complex to a document.
//!
//! Facets have no orientation: they are triangulated so that they fit together along common
//! segments, and what lies on either side of a triangle follows from the cells the facets divide
//! space into, and from the hole and region points in those cells.

use crate::closure::odd_edges;
use crate::document::{Labelled, check_scale, document, dropped, largest_coordinate};
use crate::facet::{FacetError, triangulate};
use crate::place::{counted, place};
use crate::polygon::{Projection, area_vector};
use crate::segments::split_segments;
use crate::weld::Welder;
use crate::{Imported, ReadError};
use geom::cells::{Cells, Place};
use geom::contacts::contacts;
use geom::edges::Edges;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Region, Template, Triangle};

/// A piecewise linear complex as its file lists it.
#[derive(Debug, Default)]
pub struct Plc {
    /// Nodes. All finite.
    pub points: Vec<DVec3>,
    /// Facets.
    pub facets: Vec<Facet>,
    /// A point in each hole.
    pub holes: Vec<DVec3>,
    /// A point in each region.
    pub regions: Vec<Seed>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
}

/// A planar facet.
#[derive(Debug, Default)]
pub struct Facet {
    /// Closed polygons, single segments (two nodes) and single nodes.
    pub polygons: Vec<Vec<u32>>,
    /// A point in each hole of the facet.
    pub holes: Vec<DVec3>,
    /// Boundary marker.
    pub marker: i64,
}

/// A point that says which region it lies in.
#[derive(Debug)]
pub struct Seed {
    /// Where.
    pub point: DVec3,
    /// The region's attribute, as printed.
    pub attribute: String,
    /// Largest tetrahedron volume wanted in the region.
    pub max_volume: Option<f64>,
}

/// Builds the document of a piecewise linear complex.
///
/// # Errors
/// Facets that are not planar subdivisions, that cross, or that leave a region open; hole and region
/// points that contradict each other.
pub fn build(plc: Plc, format: &'static str) -> Result<Imported, ReadError> {
    check_scale(&plc.points)?;
    let mut notices = Vec::new();
    let Surface {
        points,
        triangles,
        facet_of,
    } = triangulate_facets(&plc, &mut notices)?;
    if triangles.is_empty() {
        return Err(ReadError::BadSurface(
            "it has no facets with an area".to_owned(),
        ));
    }
    check_crossing(&points, &triangles, &facet_of)?;
    let edges = Edges::new(&triangles);
    let cells = Cells::new(&points, &triangles, &edges);
    let leak = || {
        let odd = odd_edges(&edges);
        match odd.iter().find(|&&e| edges.around(e).len() == 1) {
            None => String::new(),
            Some(&e) => {
                let [a, b] = edges.ends[e].map(|v| place(points[v as usize]));
                let open = odd.iter().filter(|&&e| edges.around(e).len() == 1).count();
                format!(
                    "; {} (the first from {a} to {b})",
                    counted(open, "edge has one facet only", "edges have one facet only")
                )
            }
        }
    };
    if cells.count() == 1 {
        return Err(ReadError::BadSurface(format!(
            "the facets enclose nothing{}",
            leak()
        )));
    }
    let (content, regions) = contents(&plc, &cells, &leak, &mut notices)?;
    let (marker_ids, markers) = markers(&plc);
    let mut inner = 0;
    let mut outer = 0;
    let mut labelled = Vec::with_capacity(triangles.len());
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        let front = content[cells.front(t) as usize];
        let back = content[cells.back(t) as usize];
        if front == back {
            *(if front == OUTSIDE {
                &mut outer
            } else {
                &mut inner
            }) += 1;
            continue;
        }
        // Boundaries face outwards, interfaces towards the higher region id. OUTSIDE is the highest.
        let turned = front < back;
        labelled.push(Triangle {
            vertices: if turned { [a, c, b] } else { [a, b, c] },
            marker: marker_ids[&plc.facets[facet_of[t] as usize].marker],
            front: front.max(back),
            back: front.min(back),
        });
    }
    let (one, many) = ("triangle of a facet", "triangles of facets");
    if inner > 0 {
        notices.push(dropped(inner, one, many, "within one region"));
    }
    if outer > 0 {
        notices.push(dropped(outer, one, many, "with no region on either side"));
    }
    if labelled.is_empty() {
        return Err(ReadError::BadSurface(
            "no region is left: all cells are holes".to_owned(),
        ));
    }
    document(
        Labelled {
            template: Template {
                vertices: points,
                triangles: labelled,
                ..Template::default()
            },
            regions,
            markers,
            relative_precision: plc.relative_precision,
            notices,
        },
        format,
    )
}

/// Triangles of all facets, fitting together along common segments.
struct Surface {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Facet each triangle comes from.
    facet_of: Vec<u32>,
}

fn triangulate_facets(plc: &Plc, notices: &mut Vec<String>) -> Result<Surface, ReadError> {
    let mut welder = Welder::new(plc.points.len());
    let id: Vec<u32> = plc.points.iter().map(|&p| welder.id(p)).collect();
    let points = welder.into_points();
    // Segments of each facet, and what they are split into by nodes that lie on them.
    let segments: Vec<Vec<[u32; 2]>> = plc.facets.iter().map(|f| segments(f, &id)).collect();
    let tolerance = plc.relative_precision.max(1e-10) * 4.0 * largest_coordinate(&points);
    let pieces = split_segments(&points, &segments, tolerance)
        .ok_or_else(|| ReadError::BadSurface("too many segments lie close to nodes".to_owned()))?;
    let mut surface = Surface {
        points,
        triangles: Vec::new(),
        facet_of: Vec::new(),
    };
    let mut seen = FxHashSet::default();
    let mut flat = 0;
    let mut repeated = 0;
    for (f, facet) in plc.facets.iter().enumerate() {
        let split: Vec<[u32; 2]> = segments[f]
            .iter()
            .flat_map(|s| match pieces.get(s) {
                Some(chain) => chain.windows(2).map(|w| [w[0], w[1]]).collect(),
                None => vec![*s],
            })
            .collect();
        let triangles = triangulate_facet(&surface.points, f, facet, &split, &id)?;
        flat += usize::from(triangles.is_empty());
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
) -> Result<Vec<[u32; 3]>, ReadError> {
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
    let triangles = triangulate(&flat, &segments, &holes).map_err(|error| {
        let at = |v: u32| place(points[nodes[v as usize] as usize]);
        let reason = match error {
            FacetError::Coincident(a, b) => format!(
                "{} and {} lie above each other, so it is not planar",
                at(a),
                at(b)
            ),
            FacetError::Crossing(a, b) => format!(
                "the segment from {} to {} crosses another one",
                at(a),
                at(b)
            ),
            FacetError::Coordinate => "its coordinates are too large or too small".to_owned(),
        };
        ReadError::BadSurface(format!("facet {} (counted from 1): {reason}", index + 1))
    })?;
    Ok(triangles
        .into_iter()
        .map(|t| t.map(|v| nodes[v as usize]))
        .collect())
}

fn check_crossing(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    facet_of: &[u32],
) -> Result<(), ReadError> {
    let mut found = None;
    contacts(
        points,
        triangles,
        |t| facet_of[t as usize],
        |contact| {
            found = Some(contact);
            false
        },
    );
    match found {
        None => Ok(()),
        Some(contact) => {
            let [a, b] = contact.triangles.map(|t| facet_of[t as usize] + 1);
            Err(ReadError::BadSurface(format!(
                "facets {} and {} (counted from 1) cross or touch at {}, away from their common \
                 nodes and segments",
                a.min(b),
                a.max(b),
                place(contact.point)
            )))
        }
    }
}

/// Region in each cell, and the regions, increasing in id.
fn contents(
    plc: &Plc,
    cells: &Cells<'_>,
    leak: &dyn Fn() -> String,
    notices: &mut Vec<String>,
) -> Result<(Vec<u32>, Vec<Region>), ReadError> {
    #[derive(Clone, Copy)]
    enum Content {
        Unknown,
        Hole(usize),
        Region(usize),
    }
    let mut content = vec![Content::Unknown; cells.count()];
    let locate = |point: DVec3, what: String| match cells.locate(point) {
        Place::Cell(cell) => Ok(cell),
        Place::Triangle(_) => Err(ReadError::BadSurface(format!(
            "{what} at {} lies on a facet",
            place(point)
        ))),
    };
    for (i, &hole) in plc.holes.iter().enumerate() {
        let cell = locate(hole, format!("hole point {}", i + 1))?;
        if cell == Cells::UNBOUNDED {
            let at = place(hole);
            notices.push(format!("hole point {} at {at} lies outside", i + 1));
        } else {
            content[cell as usize] = Content::Hole(i);
        }
    }
    let mut regions: BTreeMap<u32, Region> = BTreeMap::new();
    let ids = region_ids(&plc.regions);
    for (i, seed) in plc.regions.iter().enumerate() {
        let at = place(seed.point);
        let cell = locate(seed.point, format!("region point {}", i + 1))?;
        if cell == Cells::UNBOUNDED {
            return Err(ReadError::BadSurface(format!(
                "region point {} at {at} lies outside, or in a region that the facets leave \
                 open{}",
                i + 1,
                leak()
            )));
        }
        match content[cell as usize] {
            Content::Hole(h) => {
                return Err(ReadError::BadSurface(format!(
                    "region point {} at {at} lies in the same cell as hole point {} at {}",
                    i + 1,
                    h + 1,
                    place(plc.holes[h])
                )));
            }
            Content::Region(j) if ids[j] != ids[i] => {
                return Err(ReadError::BadSurface(format!(
                    "region points {} at {} and {} at {at} lie in the same cell, but have the \
                     attributes {} and {}",
                    j + 1,
                    place(plc.regions[j].point),
                    i + 1,
                    plc.regions[j].attribute,
                    seed.attribute
                )));
            }
            _ => content[cell as usize] = Content::Region(i),
        }
        let region = regions.entry(ids[i]).or_insert_with(|| Region {
            id: ids[i],
            name: seed.attribute.clone(),
            max_volume: None,
            volume: None,
        });
        // The stricter limit, where seeds of one region disagree.
        region.max_volume = match (region.max_volume, seed.max_volume) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
    }
    let mut next = 1;
    let mut named = Vec::new();
    let content = (0_u32..)
        .zip(content)
        .map(|(cell, content)| match content {
            _ if cell == Cells::UNBOUNDED => OUTSIDE,
            Content::Hole(_) => OUTSIDE,
            Content::Region(i) => ids[i],
            Content::Unknown => {
                while regions.contains_key(&next) || ids.contains(&next) {
                    next += 1;
                }
                let region = Region {
                    id: next,
                    name: format!("region{next}"),
                    max_volume: None,
                    volume: None,
                };
                regions.insert(next, region);
                named.push(next.to_string());
                next
            }
        })
        .collect();
    if !named.is_empty() && !plc.regions.is_empty() {
        named.truncate(10);
        notices.push(format!(
            "cells without a region point are regions of their own: {}",
            named.join(", ")
        ));
    }
    Ok((content, regions.into_values().collect()))
}

/// Region id of each seed: its attribute where that is a whole number, else a free id; the same for
/// the same attribute.
fn region_ids(seeds: &[Seed]) -> Vec<u32> {
    let whole = |seed: &Seed| {
        let value: f64 = seed.attribute.parse().ok()?;
        (value.fract() == 0.0 && (0.0..f64::from(OUTSIDE)).contains(&value)).then_some(value as u32)
    };
    let used: FxHashSet<u32> = seeds.iter().filter_map(whole).collect();
    let mut other: FxHashMap<&str, u32> = FxHashMap::default();
    let mut next = 1;
    seeds
        .iter()
        .map(|seed| {
            whole(seed).unwrap_or_else(|| {
                *other.entry(seed.attribute.as_str()).or_insert_with(|| {
                    while used.contains(&next) {
                        next += 1;
                    }
                    next += 1;
                    next - 1
                })
            })
        })
        .collect()
}

/// Id of each facet marker, and the names: the number itself where it can be an id.
fn markers(plc: &Plc) -> (FxHashMap<i64, u32>, Vec<(u32, String)>) {
    let mut values: Vec<i64> = plc.facets.iter().map(|f| f.marker).collect();
    values.sort_unstable();
    values.dedup();
    let fits = |m: i64| u32::try_from(m).ok().filter(|&id| id != OUTSIDE);
    let mut ids: FxHashMap<i64, u32> = FxHashMap::default();
    let mut next = 1;
    for &m in &values {
        let id = fits(m).unwrap_or_else(|| {
            while values.binary_search(&i64::from(next)).is_ok() {
                next += 1;
            }
            next += 1;
            next - 1
        });
        ids.insert(m, id);
    }
    let mut names: Vec<(u32, String)> = values.iter().map(|m| (ids[m], m.to_string())).collect();
    names.sort_unstable();
    (ids, names)
}
