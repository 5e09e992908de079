//! The tables of a document: regions with volumes, markers with areas, the source.

use crate::place::{counted, short};
use crate::{Imported, ReadError};
use geom::measure::{boundary_area, corners, tet_volume, triangle_area};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Document, Marker, OUTSIDE, Region, Source, Template};

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
}

/// Completes the tables.
///
/// # Errors
/// A region without volume.
pub fn document(labelled: Labelled, format: &'static str) -> Result<Imported, ReadError> {
    let Labelled {
        mut template,
        mut regions,
        markers,
        relative_precision,
        notices,
    } = labelled;
    drop_unused_vertices(&mut template);
    let precision = relative_precision * largest_coordinate(&template.vertices);
    let (volumes, surfaces, areas) = measures(&template);
    for region in &mut regions {
        let volume = volumes.get(&region.id).copied().unwrap_or(0.0);
        // As thin as the coordinates are uncertain: there is nothing inside.
        let surface = surfaces.get(&region.id).copied().unwrap_or(0.0);
        if volume <= 0.5 * precision * surface {
            return Err(ReadError::BadSurface(format!(
                "region '{}' encloses no volume: {} on a surface of {}",
                region.name,
                short(volume),
                short(surface)
            )));
        }
        region.volume = Some(volume);
    }
    let source = Source {
        format: format.to_owned(),
        triangles: template.triangles.len() as u64,
        volume: regions.iter().filter_map(|r| r.volume).sum(),
        boundary_area: boundary_area(&template),
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
    Ok(Imported { document, notices })
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

/// Refuses models so large or small that volumes, or the exact predicates, leave the range of
/// numbers.
///
/// # Errors
/// Says the largest coordinate.
pub fn check_scale(points: &[DVec3]) -> Result<(), ReadError> {
    let largest = largest_coordinate(points);
    if largest == 0.0 || (1e-80..1e80).contains(&largest) {
        return Ok(());
    }
    let size = if largest < 1.0 { "small" } else { "large" };
    Err(ReadError::BadSurface(format!(
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

/// Makes names unique by numbering the repeated ones, and replaces empty ones by `word` and the
/// position, counted from 1.
pub fn unique_names<'a>(names: impl Iterator<Item = &'a str>, word: &str) -> Vec<String> {
    let mut seen: FxHashMap<String, usize> = FxHashMap::default();
    let mut unique: Vec<String> = Vec::new();
    for (i, name) in names.enumerate() {
        let mut base = plain(name);
        if base.is_empty() {
            base = format!("{word}{}", i + 1);
        }
        let mut candidate = base.clone();
        while seen.contains_key(&candidate) {
            let n = seen.entry(base.clone()).or_insert(1);
            *n += 1;
            candidate = format!("{base}-{n}");
        }
        seen.insert(candidate.clone(), 1);
        unique.push(candidate);
    }
    unique
}

/// A name without control characters, which would break lines of other formats and steer terminals.
pub fn plain(name: &str) -> String {
    name.replace(char::is_control, " ").trim().to_owned()
}

/// A notice about something dropped.
pub fn dropped(n: usize, one: &str, many: &str, why: &str) -> String {
    format!("{} {why}: dropped", counted(n, one, many))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_made_unique() {
        let names = ["a", "a", "", "a-2", "a"];
        assert_eq!(
            unique_names(names.into_iter(), "region"),
            ["a", "a-2", "region3", "a-2-2", "a-3"]
        );
        assert_eq!(unique_names(["\u{1b}[31m\t"].into_iter(), "x"), ["[31m"]);
        assert_eq!(unique_names(["\t\u{7f}"].into_iter(), "x"), ["x1"]);
    }
}
