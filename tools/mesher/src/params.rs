//! What is asked of the mesher, in numbers.

use std::time::Duration;
use tmesh::{Document, Wishes};

/// What is asked of the elements and of the mesher, in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// Whether elements are improved at all; false gives a plain constrained tetrahedralization.
    pub quality: bool,
    /// Largest ratio of circumradius to shortest edge, above 0.612.
    pub radius_edge: f64,
    /// Smallest dihedral angle, degrees.
    pub min_dihedral: f64,
    /// Whether these bounds are those that hold where nobody asks for others.
    pub default_bounds: bool,
    /// Largest dihedral angle that optimization leaves alone, degrees; `None` leaves elements as the mesher
    /// makes them.
    pub optimize: Option<f64>,
    /// Time limit for each template.
    pub timeout: Option<Duration>,
    /// Memory that the mesher may take for each template, bytes.
    pub max_memory: Option<u64>,
    /// Switches of the mesher's own, appended.
    pub switches: String,
}

impl Params {
    /// What a document's wishes come to, and no limit of memory.
    pub fn new(wishes: &Wishes) -> Self {
        Self {
            quality: wishes.quality(),
            radius_edge: wishes.radius_edge(),
            min_dihedral: wishes.min_dihedral(),
            default_bounds: wishes.radius_edge() == Wishes::RADIUS_EDGE
                && wishes.min_dihedral() == Wishes::MIN_DIHEDRAL,
            optimize: wishes.optimize(),
            timeout: wishes.timeout(),
            max_memory: None,
            switches: String::new(),
        }
    }
}

impl Default for Params {
    fn default() -> Self {
        Self::new(&Wishes::default())
    }
}

/// Largest volumes per region: what the region says, else the general limit of the wishes; where instances make other
/// regions of it, the least of what those say.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizes {
    /// One entry per region of the document, model units cubed.
    pub of_region: Vec<Option<f64>>,
}

impl Sizes {
    /// The sizes that a document asks for.
    pub fn new(document: &Document) -> Self {
        let general = document.wishes.max_volume();
        let regions = &document.regions;
        let limit = |id: u32| {
            let known = regions.binary_search_by_key(&id, |r| r.id).ok();
            known.and_then(|at| regions[at].max_volume).or(general)
        };
        let least = |id: u32| {
            let images = document.region_maps.iter().map(|map| map.get(id));
            let limits = images.chain([id]).filter_map(limit);
            limits.reduce(f64::min)
        };
        Self {
            of_region: regions.iter().map(|r| least(r.id)).collect(),
        }
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
    use tmesh::{Region, RegionMap, Size, Template};

    #[test]
    fn sizes_of_regions_go_before_the_general_one() {
        let mut document = Document::single(Template::default());
        for (id, max_volume) in [(3, Some(4.0)), (5, Some(0.1)), (7, None)] {
            document.regions.push(Region {
                id,
                name: String::new(),
                max_volume,
                volume: None,
            });
        }
        document.wishes.size = Some(Size::MaxVolume(1.0));
        let sizes = Sizes::new(&document);
        assert_eq!(sizes.of_region, [Some(4.0), Some(0.1), Some(1.0)]);
        assert_eq!(sizes.loosest(&[0, 1, 2]), Some(4.0));
        assert!(sizes.differ(&[0, 1]) && !sizes.differ(&[2]));
        // Some instance has the third region where the template has the first.
        document.region_maps = vec![RegionMap {
            pairs: vec![[3, 7], [7, 3]],
        }];
        let sizes = Sizes::new(&document);
        assert_eq!(sizes.of_region, [Some(1.0), Some(0.1), Some(1.0)]);
        document.region_maps.clear();
        document.wishes.size = None;
        let sizes = Sizes::new(&document);
        assert_eq!(sizes.loosest(&[0, 2]), None);
        assert_eq!(sizes.loosest(&[0]), Some(4.0));
    }
}
