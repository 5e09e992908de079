//! What the user asks of the elements.

use crate::Error;
use std::time::Duration;
use tmesh::{Document, Region};

/// Size limit for one region.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionSize {
    /// Name or id of the region.
    pub region: String,
    /// Largest tetrahedron volume, model units cubed.
    pub max_volume: f64,
}

/// What is asked of the elements. Numbers are finite; the command line checks them.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// Whether elements are improved at all; false gives a plain constrained tetrahedralization.
    pub quality: bool,
    /// Largest ratio of circumradius to shortest edge, above 0.612.
    pub radius_edge: f64,
    /// Smallest dihedral angle, degrees.
    pub min_dihedral: f64,
    /// Largest dihedral angle that optimization leaves alone, degrees; `None` leaves elements as TetGen
    /// makes them.
    pub optimize: Option<f64>,
    /// Largest tetrahedron volume, model units cubed.
    pub max_volume: Option<f64>,
    /// Limits for single regions; they override [`Params::max_volume`] there.
    pub region_sizes: Vec<RegionSize>,
    /// TetGen switches appended to ours.
    pub switches: String,
    /// Time limit for each template.
    pub timeout: Option<Duration>,
    /// Memory that the mesher may take for each template, bytes.
    pub max_memory: Option<u64>,
}

/// Dihedral angle above which tetrahedra are optimized away unless something else is asked for,
/// degrees; see the crate `improve`.
///
/// On wedges of coated rings, vias, ratchets and prisms the first percentile of the smallest angle goes
/// from 13 degrees without to 20 at 145 and 25 at 130, the smallest from 8 to 17 and 21, for
/// 5 to 15 % of the mesher's time; elements past a radius-edge ratio of 1.4 stay below 1 %.
pub const DEFAULT_OPTIMIZE: f64 = 130.0;

impl Default for Params {
    fn default() -> Self {
        Self {
            quality: true,
            radius_edge: 1.4,
            min_dihedral: 10.0,
            optimize: Some(DEFAULT_OPTIMIZE),
            max_volume: None,
            region_sizes: Vec::new(),
            switches: String::new(),
            timeout: None,
            max_memory: None,
        }
    }
}

/// Volume of the regular tetrahedron with the given edge.
pub fn volume_of_edge(edge: f64) -> f64 {
    edge * edge * edge / (6.0 * std::f64::consts::SQRT_2)
}

/// Largest volumes per region: what the user asks for, else what the document says, else the
/// general limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizes {
    /// One entry per region of the document, model units cubed.
    pub of_region: Vec<Option<f64>>,
}

impl Sizes {
    /// Resolves names and ids.
    ///
    /// # Errors
    /// [`Error::UnknownRegion`].
    pub fn new(document: &Document, params: &Params) -> Result<Self, Error> {
        let mut of_region: Vec<Option<f64>> = document
            .regions
            .iter()
            .map(|r| r.max_volume.or(params.max_volume))
            .collect();
        for size in &params.region_sizes {
            let named = |r: &Region| r.name == size.region;
            let numbered = |r: &Region| size.region.parse() == Ok(r.id);
            let found = document
                .regions
                .iter()
                .position(named)
                .or_else(|| document.regions.iter().position(numbered));
            let Some(index) = found else {
                let known: Vec<_> = document
                    .regions
                    .iter()
                    .map(|r| format!("'{}' ({})", r.name, r.id))
                    .collect();
                return Err(Error::UnknownRegion {
                    name: size.region.clone(),
                    known: known.join(", "),
                });
            };
            of_region[index] = Some(size.max_volume);
        }
        Ok(Self { of_region })
    }

    /// The limit that holds everywhere: the loosest one, when every listed region has one.
    pub fn loosest(&self, used: &[usize]) -> Option<f64> {
        used.iter()
            .map(|&r| self.of_region[r])
            .try_fold(0.0_f64, |most, limit| limit.map(|v| most.max(v)))
            .filter(|_| !used.is_empty())
    }

    /// Whether the listed regions have different limits.
    pub fn differ(&self, used: &[usize]) -> bool {
        used.windows(2)
            .any(|w| self.of_region[w[0]] != self.of_region[w[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Template;

    fn document() -> Document {
        let mut document = Document::single(Template::default());
        for (id, name) in [(3, "core"), (5, "7"), (7, "ring")] {
            document.regions.push(Region {
                id,
                name: name.to_owned(),
                max_volume: (id == 3).then_some(2.0),
                volume: None,
            });
        }
        document
    }

    #[test]
    fn sizes_are_found_by_name_then_id() {
        let mut params = Params {
            max_volume: Some(1.0),
            ..Params::default()
        };
        let size = |region: &str, max_volume| RegionSize {
            region: region.to_owned(),
            max_volume,
        };
        params.region_sizes = vec![size("7", 0.1), size("3", 4.0)];
        let sizes = Sizes::new(&document(), &params).unwrap();
        assert_eq!(sizes.of_region, [Some(4.0), Some(0.1), Some(1.0)]);
        assert_eq!(sizes.loosest(&[0, 1, 2]), Some(4.0));
        assert!(sizes.differ(&[0, 1]) && !sizes.differ(&[2]));
        params.region_sizes = vec![size("copper", 0.1)];
        assert!(matches!(
            Sizes::new(&document(), &params),
            Err(Error::UnknownRegion { .. })
        ));
        params.region_sizes.clear();
        params.max_volume = None;
        let sizes = Sizes::new(&document(), &params).unwrap();
        assert_eq!(sizes.loosest(&[0, 1]), None);
        assert_eq!(sizes.loosest(&[0]), Some(2.0));
    }
}
