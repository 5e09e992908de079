//! The solids of what is more than a surface: of meshes, of complexes and of documents.

use super::part::{Naming, Part};
use crate::HealError;
use crate::Solids;
use crate::document::{Imported, largest_coordinate};
use crate::mesh;
use crate::soup::{Mended, Mending, NONE, Surface};
use crate::words::unique_names;
use interchange::Format;
use interchange::text::counted;
use tmesh::{Document, OUTSIDE, Region, Size, Template};

/// The surfaces of the regions of what was read.
///
/// # Errors
/// Documents that are cut already; regions that are not closed.
pub fn surface_of(
    imported: Imported,
    format: Format,
    naming: Naming,
    solids: Solids,
) -> Result<Part, HealError> {
    let Imported {
        mut document,
        mut notices,
        repairs,
        ..
    } = imported;
    if !document.is_plain() {
        return Err(HealError::BadSurface(format!(
            "it was cut already and holds {} placed {}; only whole surfaces can be put together with other files",
            counted(document.templates.len(), "template", "templates"),
            counted(document.instances.len(), "time", "times"),
        )));
    }
    notices.extend(what_is_left_out(&document));
    let template = document.templates.swap_remove(0);
    let bounded = bounded_by_region(&template, document.regions);
    let points = template.vertices.iter();
    let surface = Surface {
        points: points.map(|&p| document.frame.to_world(p)).collect(),
        partner: vec![NONE; bounded.triangles.len()],
        source: (0..bounded.triangles.len() as u32).collect(),
        triangles: bounded.triangles,
        group: bounded.region.clone(),
        solid: bounded.region,
        groups: bounded.names.clone(),
        solids: bounded.names,
        group_word: "region",
    };
    let precision = document.source.map_or(0.0, |s| s.precision);
    let largest = largest_coordinate(&surface.points);
    let relative = if largest > 0.0 {
        precision / largest
    } else {
        0.0
    };
    let mut mending = Mending::new(surface, [relative.max(f64::EPSILON), 0.0]);
    if solids == Solids::Whole {
        mending.unite()?;
    }
    mending.check_closed()?;
    mending.repairs = repairs;
    let wishes = match solids {
        Solids::Whole => Vec::new(),
        Solids::Groups | Solids::Shells => bounded.wishes,
    };
    Ok(Part {
        mended: Mended { mending, notices },
        naming,
        wishes,
        format,
        history: document.history,
    })
}

/// What a document has that a body of several files has not, as a sentence.
fn what_is_left_out(document: &Document) -> Option<String> {
    let tets = document.templates.iter().map(|t| t.tets.len()).sum();
    let has_symmetry = document.symmetry.is_some() || document.promise.is_some();
    let has_wishes = document.wishes != tmesh::Wishes::default();
    let parts = [
        (tets > 0).then(|| counted(tets, "tetrahedron", "tetrahedra")),
        has_symmetry.then(|| "symmetry".to_owned()),
        has_wishes.then(|| "wishes for elements".to_owned()),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let list = parts.join(" and ");
    (!parts.is_empty()).then(|| format!("its {list} left out, as its surface alone is joined"))
}

/// Triangles by the region that they bound, those between regions once for each.
struct Bounded {
    triangles: Vec<[u32; 3]>,
    /// Index of the region behind each triangle.
    region: Vec<u32>,
    names: Vec<String>,
    wishes: Vec<Option<Size>>,
}

fn bounded_by_region(template: &Template, mut regions: Vec<Region>) -> Bounded {
    let skin;
    let faces = match template.triangles.is_empty() {
        true => {
            skin = mesh::surface(&template.tets, &[]).0;
            &skin
        }
        false => &template.triangles,
    };
    let (mut triangles, mut region) = (Vec::new(), Vec::new());
    for t in faces {
        let [a, b, c] = t.vertices;
        for (id, corners) in [(t.back, [a, b, c]), (t.front, [a, c, b])] {
            if id != OUTSIDE && t.front != t.back {
                triangles.push(corners);
                region.push(id);
            }
        }
    }
    let mut used = region.clone();
    used.sort_unstable();
    used.dedup();
    regions.retain(|r| used.binary_search(&r.id).is_ok());
    for id in &mut region {
        *id = regions.partition_point(|r| r.id < *id) as u32;
    }
    Bounded {
        triangles,
        region,
        names: unique_names(regions.iter().map(|r| r.name.as_str()), "region"),
        wishes: regions.iter().map(|r| r.size).collect(),
    }
}
