//! Volumes and boundary area against those of the input body.

use super::Checks;
use super::conformity::Skin;
use super::findings::{Findings, Kind};
use crate::instances::Copies;
use crate::measure::Measured;
use std::collections::BTreeMap;
use tmesh::{Document, Region};

/// Relative difference of volumes that rounding of an exact input may make.
const EXACT: f64 = 1e-6;

/// Compares volumes and boundary area with the input's, where they are known.
///
/// A mesh of one sector's copies is exactly symmetric; the input is so only within its residual. Its
/// boundary, and the interfaces, may therefore differ by the residual times the radius, and by the
/// error of the input's coordinates. With `d` four times the sum of these (points near the cuts are
/// snapped to them, which adds to both), a volume may differ by `d` times the area around it, and the
/// area of a triangle by `d` times half its perimeter.
pub fn check(
    document: &Document,
    measured: &Measured,
    skins: &[Skin],
    checks: &mut Checks,
    findings: &mut Findings,
) {
    let Some(source) = &document.source else {
        return;
    };
    let residual = document
        .symmetry
        .as_ref()
        .map_or(0.0, |s| s.residual * s.radius);
    let shift = 4.0 * (residual + source.precision);
    let copies = Copies::of(document);

    let mut boundary = 0.0;
    let mut perimeter = 0.0;
    let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
    for (skin, &copies) in skins.iter().zip(&copies.of_template) {
        boundary += skin.boundary_area * copies as f64;
        perimeter += skin.perimeter * copies as f64;
    }
    for instance in &document.instances {
        for (&id, area) in &skins[instance.template as usize].region_area {
            *areas
                .entry(document.placed_region(instance, id))
                .or_insert(0.0) += area;
        }
    }

    let volume = measured.total.volume;
    let allowed = EXACT * source.volume + shift * boundary;
    checks.volume_error = compare(volume, source.volume);
    if (volume - source.volume).abs() > allowed {
        findings.add(Kind::Volume, || {
            differs("the volume", volume, source.volume, allowed)
        });
    }
    for r in &document.regions {
        let Region {
            volume: Some(expected),
            ..
        } = *r
        else {
            continue;
        };
        let found = measured.regions.get(&r.id).map_or(0.0, |a| a.volume);
        let allowed = EXACT * expected + shift * areas.get(&r.id).copied().unwrap_or(0.0);
        let error = compare(found, expected);
        if let Some(error) = error {
            let worst = checks.region_volume_error.unwrap_or(0.0);
            checks.region_volume_error = Some(worst.max(error));
        }
        if (found - expected).abs() > allowed {
            findings.add(Kind::RegionVolume, || {
                let what = format!("the volume of region {} '{}'", r.id, r.name);
                differs(&what, found, expected, allowed)
            });
        }
    }
    let allowed = EXACT * source.boundary_area + 0.5 * shift * perimeter;
    checks.boundary_area_error = compare(boundary, source.boundary_area);
    if (boundary - source.boundary_area).abs() > allowed {
        findings.add(Kind::BoundaryArea, || {
            let what = "the area of the boundary";
            differs(what, boundary, source.boundary_area, allowed)
        });
    }
}

fn compare(found: f64, expected: f64) -> Option<f64> {
    (expected > 0.0).then(|| (found - expected).abs() / expected)
}

fn differs(what: &str, found: f64, expected: f64, allowed: f64) -> String {
    format!(
        "{what} is {found}, the input's is {expected}, a difference of {:.3e} where {allowed:.3e} is allowed",
        (found - expected).abs()
    )
}
