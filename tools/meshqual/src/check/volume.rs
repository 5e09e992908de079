//! Volumes and boundary area against those of the input body.

use super::faces::Skin;
use super::findings::{Findings, Kind};
use crate::instances::Copies;
use crate::measure::Measured;
use geom::tolerance::may_differ;
use std::collections::BTreeMap;
use tmesh::{Deviation, Document};

/// Relative differences from the input; `None` where nothing is known of it.
#[derive(Default)]
pub struct Errors {
    /// Of the volume.
    pub volume: Option<f64>,
    /// The largest of a region's volume.
    pub region_volume: Option<f64>,
    /// Of the area of the outer boundary.
    pub boundary_area: Option<f64>,
}

/// The boundary and the interfaces of the assembled mesh.
struct Extent {
    boundary: f64,
    perimeter: f64,
    /// Area around each region.
    around: BTreeMap<u32, f64>,
}

impl Extent {
    fn of(document: &Document, skins: &[Skin]) -> Self {
        let copies = Copies::of(document).of_template;
        let mut extent = Self {
            boundary: 0.0,
            perimeter: 0.0,
            around: BTreeMap::new(),
        };
        for (skin, &copies) in skins.iter().zip(&copies) {
            extent.boundary += skin.boundary_area * copies as f64;
            extent.perimeter += skin.perimeter * copies as f64;
        }
        for instance in &document.instances {
            for (&id, area) in &skins[instance.template as usize].region_area {
                let region = document.placed_region(instance, id);
                *extent.around.entry(region).or_insert(0.0) += area;
            }
        }
        extent
    }
}

/// Compares volumes and boundary area with the input's, where they are known.
///
/// A mesh of one sector's copies is exactly symmetric; the input is so only within its residual. Its
/// boundary, and the interfaces, may therefore differ by the residual times the radius, and by the
/// error of the input's coordinates: by the sum of these in the sector, by as much in the copy, and by
/// twice that near the cuts, onto which points are moved; and by the deviation, if one was asked for: otherwise the surface is
/// moved by the residual, once more. Faces that are nearly flat and were meshed as flat ones are off by what the document says.
pub fn volume_errors(
    document: &Document,
    measured: &Measured,
    skins: &[Skin],
    findings: &mut Findings,
) -> Errors {
    let Some(source) = &document.source else {
        return Errors::default();
    };
    let symmetry = document.symmetry.as_ref();
    let deviation = match document.wishes.deviation() {
        Deviation::Auto => 0.0,
        Deviation::Within(relative) => symmetry.map_or(0.0, |s| relative * s.radius),
    };
    let displacement = document.displacement() + deviation;
    let extent = Extent::of(document, skins);
    let mut compare = |kind: Kind, amount: &Amount<'_>, border: f64| {
        let allowed = may_differ(amount.expected, border, displacement);
        let difference = (amount.found - amount.expected).abs();
        if difference > allowed {
            findings.add(kind, || amount.differs(difference, allowed));
        }
        (amount.expected > 0.0).then(|| difference / amount.expected)
    };
    let volume = Amount {
        what: "the volume",
        found: measured.total.volume,
        expected: source.volume,
    };
    let mut errors = Errors {
        volume: compare(Kind::Volume, &volume, extent.boundary),
        ..Errors::default()
    };
    for r in &document.regions {
        let Some(expected) = r.volume else { continue };
        let amount = Amount {
            what: &format!("the volume of region {} '{}'", r.id, r.name),
            found: measured.regions.get(&r.id).map_or(0.0, |a| a.volume),
            expected,
        };
        let around = extent.around.get(&r.id).copied().unwrap_or(0.0);
        let error = compare(Kind::RegionVolume, &amount, around);
        let worst = errors.region_volume.unwrap_or(0.0);
        errors.region_volume = error.map(|e| e.max(worst)).or(errors.region_volume);
    }
    let area = Amount {
        what: "the area of the boundary",
        found: extent.boundary,
        expected: source.boundary_area,
    };
    errors.boundary_area = compare(Kind::BoundaryArea, &area, 0.5 * extent.perimeter);
    errors
}

/// An amount that is compared.
struct Amount<'a> {
    what: &'a str,
    found: f64,
    expected: f64,
}

impl Amount<'_> {
    fn differs(&self, difference: f64, allowed: f64) -> String {
        format!(
            "{} is {}, the input's is {}, a difference of {difference:.3e} where {allowed:.3e} is allowed",
            self.what, self.found, self.expected
        )
    }
}
