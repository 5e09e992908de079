//! Whether the copies of a wedge add up to the body.

use super::copies::Copies;
use crate::body::{Body, region_volumes};
use crate::error::CutError;
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Template};

/// Volume and boundary of the body.
pub struct Whole {
    regions: BTreeMap<u32, f64>,
    volume: f64,
    area: f64,
}

impl Whole {
    /// Of a surface.
    pub fn new(surface: &Template) -> Self {
        let regions = region_volumes(&surface.vertices, &surface.triangles);
        Self {
            volume: regions.values().sum(),
            area: geom::measure::area_of_region(&surface.vertices, surface.faces(), OUTSIDE),
            regions,
        }
    }

    /// The relative difference between the body and all copies of `templates`, of which `count` are wedges.
    ///
    /// # Errors
    /// A larger difference than the symmetry's residual allows, of the whole or of a region.
    pub fn compare(
        &self,
        body: &Body<'_>,
        templates: &[Template],
        copies: &Copies,
        count: usize,
    ) -> Result<f64, CutError> {
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
        for (&region, &body) in &self.regions {
            let wedge = of_copies.get(&region).copied().unwrap_or_default();
            let allowed = allowed * self.volume.abs();
            if (wedge - body).abs() > allowed {
                return Err(CutError::RegionVolumeDiffers {
                    region,
                    copies: count,
                    wedge,
                    body,
                    allowed,
                });
            }
        }
        Ok(relative)
    }
}
