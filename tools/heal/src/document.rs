//! The tables of a document: regions with volumes, markers with areas, the source.

use crate::HealError;
use crate::contacts::Joined;
use crate::repair::Repair;
use crate::soup::Undrawn;
use crate::words::short;
use geom::measure::{area_of_region, corners, tet_volume, triangle_area};
use geom::tolerance::{Extent, Tolerance};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Document, Marker, OUTSIDE, Region, Source, Template};

/// What a file holds.
#[derive(Clone, Debug)]
pub struct Imported {
    /// One template in world coordinates, unless the file is a document already.
    pub document: Document,
    /// What the user should know about the file, a sentence each.
    pub notices: Vec<String>,
    /// What was repaired.
    pub repairs: Vec<Repair>,
    /// What was done to make one body of solids that touch or overlap, where that was needed.
    pub joined: Option<Joined>,
    /// Solids that could be made one body in another way.
    pub undrawn: Option<Undrawn>,
    /// Whether it was made sure that no two triangles meet away from common corners and edges.
    pub is_apart: bool,
}

/// A surface with its labels, before volumes and areas are known.
pub struct Labelled {
    /// Vertices and triangles in world coordinates; region and marker ids are final.
    pub template: Template,
    /// Materials, increasing in id. Volumes are filled in here.
    pub regions: Vec<Region>,
    /// Names of markers by id, increasing in id.
    pub markers: Vec<(u32, String)>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// What the user should know about the file.
    pub notices: Vec<String>,
    /// What was repaired.
    pub repairs: Vec<Repair>,
}

/// Completes the tables.
///
/// # Errors
/// A region without volume.
pub fn document(labelled: Labelled, format: &str) -> Result<Imported, HealError> {
    let Labelled {
        mut template,
        mut regions,
        markers,
        relative_precision,
        notices,
        repairs,
    } = labelled;
    drop_unused_vertices(&mut template);
    let precision = relative_precision * largest_coordinate(&template.vertices);
    let (volumes, surfaces, areas) = measures(&template);
    for region in &mut regions {
        let volume = volumes.get(&region.id).copied().unwrap_or(0.0);
        // As thin as the coordinates are uncertain: there is nothing inside.
        let surface = surfaces.get(&region.id).copied().unwrap_or(0.0);
        if volume <= 0.5 * precision * surface {
            return Err(HealError::BadSurface(format!(
                "region '{}' encloses no volume: {} on a surface of {}",
                region.name,
                short(volume),
                short(surface)
            )));
        }
        region.volume = Some(volume);
    }
    let source = Source {
        sector_of: None,
        format: format.to_owned(),
        triangles: template.triangles.len() as u64,
        volume: regions.iter().filter_map(|r| r.volume).sum(),
        boundary_area: area_of_region(&template.vertices, template.faces(), OUTSIDE),
        precision,
    };
    let mut document = Document::single(template);
    document.regions = regions;
    document.markers = markers
        .into_iter()
        .filter_map(|(id, name)| {
            let area = areas.get(&id).copied()?;
            Some(Marker {
                id,
                name,
                area: Some(area),
            })
        })
        .collect();
    document.source = Some(source);
    Ok(Imported {
        document,
        notices,
        repairs,
        joined: None,
        undrawn: None,
        is_apart: false,
    })
}

type Measures = FxHashMap<u32, f64>;

/// Volume and surface per region, and area per marker.
fn measures(template: &Template) -> (Measures, Measures, Measures) {
    let mut volumes = Measures::default();
    let mut surfaces = Measures::default();
    let mut areas = Measures::default();
    let origin = template.vertices.first().copied().unwrap_or_default();
    // Long runs of equal labels: a sum per run, a look-up per run.
    let key = |t: &tmesh::Triangle| (t.front, t.back, t.marker);
    for run in template.triangles.chunk_by(|s, t| key(s) == key(t)) {
        let (mut volume, mut area) = (0.0, 0.0);
        for t in run {
            let [a, b, c] = corners(&template.vertices, t);
            volume += tet_volume(origin, a, b, c);
            area += triangle_area(a, b, c);
        }
        let (front, back, marker) = key(&run[0]);
        for (region, sign) in [(front, -1.0), (back, 1.0)] {
            if region != OUTSIDE {
                *volumes.entry(region).or_default() += sign * volume;
                *surfaces.entry(region).or_default() += area;
            }
        }
        *areas.entry(marker).or_default() += area;
    }
    (volumes, surfaces, areas)
}

/// Largest absolute coordinate.
pub fn largest_coordinate(points: &[DVec3]) -> f64 {
    points
        .iter()
        .fold(0.0_f64, |m, p| m.max(p.abs().max_element()))
}

/// What counts as equal among points whose coordinates are off by so much of the largest one.
pub fn tolerance(points: &[DVec3], relative_precision: f64) -> Tolerance {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &p in points {
        low = low.min(p);
        high = high.max(p);
    }
    let radius = if points.is_empty() {
        0.0
    } else {
        0.5 * (high - low).length()
    };
    let extent = Extent {
        radius,
        height: radius,
    };
    let precision = relative_precision * largest_coordinate(points);
    // Nothing is known of the symmetry yet.
    Tolerance::new(extent, precision, 1.0)
}

/// Refuses models so large or small that volumes, or the exact predicates, leave the range of
/// numbers: the test whether a point is in the sphere of four others has products of five coordinates,
/// more than any other.
///
/// # Errors
/// Says the largest coordinate.
pub fn check_scale(points: &[DVec3]) -> Result<(), HealError> {
    let largest = largest_coordinate(points);
    if largest == 0.0 || largest.powi(5).is_normal() {
        return Ok(());
    }
    let size = if largest < 1.0 { "small" } else { "large" };
    Err(HealError::BadSurface(format!(
        "the largest coordinate, {}, is too {size} to compute with; use another unit",
        short(largest)
    )))
}

fn drop_unused_vertices(template: &mut Template) {
    let mut used = vec![false; template.vertices.len()];
    for t in &template.triangles {
        for v in t.vertices {
            used[v as usize] = true;
        }
    }
    if used.iter().all(|&u| u) {
        return;
    }
    let mut new_id = vec![0_u32; used.len()];
    let mut next = 0;
    for (id, &u) in new_id.iter_mut().zip(&used) {
        *id = next;
        next += u32::from(u);
    }
    let mut used = used.into_iter();
    template.vertices.retain(|_| used.next() == Some(true));
    for t in &mut template.triangles {
        t.vertices = t.vertices.map(|v| new_id[v as usize]);
    }
}
