//! Whether the copies of a wedge add up to the body.

use super::copies::Copies;
use crate::body::{Body, region_volumes};
use crate::error::CutError;
use geom::measure::area_of_region;
use geom::tolerance::displacement_of;
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Template};

/// Volume and boundary of the body.
pub struct Whole {
    regions: BTreeMap<u32, f64>,
    volume: f64,
    /// Around all of it.
    area: f64,
    /// Around each region.
    areas: BTreeMap<u32, f64>,
}

/// What the copies of a wedge differ from the body by.
#[derive(Clone, Copy, Debug, Default)]
pub struct Difference {
    /// Relative, of the volume.
    pub relative: f64,
    /// How far the surface would be off for the volumes of the whole and of regions to differ as they do, beyond what is known of it, model units.
    pub displacement: f64,
}

impl Whole {
    /// Of a surface.
    pub fn new(surface: &Template) -> Self {
        let regions = region_volumes(&surface.vertices, &surface.triangles);
        let area_of = |region| area_of_region(&surface.vertices, surface.faces(), region);
        Self {
            volume: regions.values().sum(),
            area: area_of(OUTSIDE),
            areas: regions.keys().map(|&id| (id, area_of(id))).collect(),
            regions,
        }
    }

    /// The difference between the body and all copies of `templates`, of which `count` are wedges.
    ///
    /// # Errors
    /// A larger difference than the symmetry's residual allows, of the whole or of a region; a region of which nothing is left.
    pub fn compare(
        &self,
        body: &Body<'_>,
        templates: &[Template],
        copies: &Copies,
        count: usize,
    ) -> Result<Difference, CutError> {
        let of_template = |t: &Template| region_volumes(&t.vertices, &t.triangles);
        let volumes: Vec<BTreeMap<u32, f64>> = templates.iter().map(of_template).collect();
        let mut of_copies: BTreeMap<u32, f64> = BTreeMap::new();
        for instance in &copies.instances {
            for (&region, volume) in &volumes[instance.template as usize] {
                let region = match instance.region_map.checked_sub(1) {
                    Some(i) => copies.region_maps[i as usize].get(region),
                    None => region,
                };
                *of_copies.entry(region).or_default() += volume;
            }
        }
        let wedge: f64 = of_copies.values().sum();
        let relative = (wedge - self.volume).abs() / self.volume.abs();
        let allowed = body.tolerance.volume(self.area, self.volume);
        if relative > allowed {
            return Err(CutError::VolumeDiffers {
                copies: count,
                wedge,
                body: self.volume,
                relative,
                allowed,
            });
        }
        let mut displacement =
            displacement_of((wedge - self.volume).abs(), self.volume.abs(), self.area);
        let known = body.document.displacement();
        for ((&region, &volume), &area) in self.regions.iter().zip(self.areas.values()) {
            let wedge = of_copies.get(&region).copied().unwrap_or_default();
            let allowed = allowed * self.volume.abs();
            if (wedge - volume).abs() > allowed {
                return Err(CutError::RegionVolumeDiffers {
                    region,
                    copies: count,
                    wedge,
                    body: volume,
                    allowed,
                });
            }
            let of_region = displacement_of((wedge - volume).abs(), volume.abs(), area);
            // What is thinner than detail is taken out.
            if wedge == 0.0 && of_region > body.tolerance.detail() {
                return Err(lost(body, region, volume));
            }
            displacement = displacement.max(of_region);
        }
        Ok(Difference {
            relative,
            displacement: (displacement - known).max(0.0),
        })
    }
}

/// The error of a region of a body, with this volume, of which nothing is left.
fn lost(body: &Body<'_>, region: u32, volume: f64) -> CutError {
    let named = body.document.regions.iter().find(|r| r.id == region);
    CutError::RegionLost {
        region,
        name: named.map_or_else(String::new, |r| r.name.clone()),
        body: volume,
        within: body.tolerance.on_axis().max(body.tolerance.on_plane()),
    }
}
