//! The sizes that a document asks for.

use crate::across::{Thinnest, across_walls};
use crate::tree::Graded;
use glam::DVec3;
use std::fmt;
use tmesh::{Document, Region, Size, Template};

/// Sizes per region: what the region says, else the general one of the wishes; where instances make other regions of it, the least of
/// what those say. And per template sizes that change from place to place.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizes {
    /// Largest volumes, one entry per region of the document, model units cubed.
    pub of_region: Vec<Option<f64>>,
    /// Lengths of edges wanted, one entry per region of the document, model units.
    pub lengths: Vec<Option<f64>>,
    /// Of each template, what changes from place to place.
    pub local: Vec<Option<Local>>,
}

/// A size that changes from place to place.
#[derive(Clone, Debug, PartialEq)]
pub struct Local {
    /// The size.
    pub graded: Graded,
    /// Cubes of the smallest sizes that the template holds, about.
    pub cubes: f64,
}

/// Walls would take more elements than can be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooMany {
    /// Template.
    pub template: usize,
    /// Elements asked for across.
    pub layers: u32,
    /// The thinnest place of its walls that was seen, and how thick it is, model units.
    pub thinnest: Thinnest,
}

impl fmt::Display for TooMany {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            template,
            layers,
            thinnest: (thickness, near),
        } = self;
        let [x, y, z] = near.to_array();
        write!(
            f,
            "{layers} elements across all walls of template {template} are more than can be made: walls are too thin for their width, the \
             thinnest has {thickness:.3e} near ({x:.6e}, {y:.6e}, {z:.6e}); leave --layers-across out, and ask for small elements by --region"
        )
    }
}

impl std::error::Error for TooMany {}

impl Sizes {
    /// What holds for regions as a whole.
    pub fn of_regions(document: &Document) -> Self {
        let regions = &document.regions;
        let least = |id: u32, of: &dyn Fn(Size) -> Option<f64>| {
            let limit = |id: u32| {
                let known = regions.binary_search_by_key(&id, |r| r.id).ok();
                let size = known.and_then(|at| regions[at].size);
                size.or(document.wishes.size).and_then(of)
            };
            let images = document.region_maps.iter().map(|map| map.get(id));
            let limits = images.chain([id]).filter_map(limit);
            limits.reduce(f64::min)
        };
        let each = |of: &dyn Fn(Size) -> Option<f64>| -> Vec<Option<f64>> {
            regions.iter().map(|r: &Region| least(r.id, of)).collect()
        };
        Self {
            of_region: each(&|size| Some(size.max_volume())),
            lengths: each(&Size::edge_length),
            local: vec![None; document.templates.len()],
        }
    }

    /// The sizes that a document asks for, those that change from place to place too.
    ///
    /// # Errors
    /// [`TooMany`].
    pub fn new(document: &Document) -> Result<Self, TooMany> {
        let mut sizes = Self::of_regions(document);
        let asked = document.wishes.layers_across;
        let Some(layers) = asked.filter(|_| document.wishes.quality()) else {
            return Ok(sizes);
        };
        let growth = document.wishes.gradation() - 1.0;
        for (index, template) in document.templates.iter().enumerate() {
            let copies = document.instances.len();
            let across = across_walls((template, index), copies, f64::from(layers));
            let across = across.map_err(|thinnest| TooMany {
                template: index,
                layers,
                thinnest,
            })?;
            sizes.local[index] = Some(Local {
                graded: Graded::new(&across.sources, growth, f64::INFINITY, ends(template)),
                cubes: across.cubes,
            });
        }
        Ok(sizes)
    }

    /// The limit of volumes that holds everywhere: the loosest one, when every listed region has one.
    pub fn loosest(&self, used: &[usize]) -> Option<f64> {
        used.iter()
            .map(|&r| self.of_region[r])
            .try_fold(0.0_f64, |most, limit| limit.map(|v| most.max(v)))
            .filter(|_| !used.is_empty())
    }

    /// Whether the listed regions have different limits of volumes.
    pub fn differ(&self, used: &[usize]) -> bool {
        used.windows(2)
            .any(|w| self.of_region[w[0]] != self.of_region[w[1]])
    }
}

fn ends(template: &Template) -> [DVec3; 2] {
    let points = || template.vertices.iter().copied();
    [
        points().reduce(DVec3::min).unwrap_or_default(),
        points().reduce(DVec3::max).unwrap_or_default(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::RegionMap;

    #[test]
    fn sizes_of_regions_go_before_the_general_one() {
        let mut document = Document::single(Template::default());
        let sizes = [
            (3, Some(Size::MaxVolume(4.0))),
            (5, Some(Size::EdgeLength(0.5))),
            (7, None),
        ];
        for (id, size) in sizes {
            document.regions.push(Region {
                id,
                name: String::new(),
                size,
                volume: None,
            });
        }
        document.wishes.size = Some(Size::MaxVolume(1.0));
        let sizes = Sizes::of_regions(&document);
        let edges = Size::EdgeLength(0.5).max_volume();
        assert_eq!(sizes.of_region, [Some(4.0), Some(edges), Some(1.0)]);
        assert_eq!(sizes.lengths, [None, Some(0.5), None]);
        assert_eq!(sizes.loosest(&[0, 1, 2]), Some(4.0));
        assert!(sizes.differ(&[0, 1]) && !sizes.differ(&[2]));
        // Some instance has the third region where the template has the first.
        document.region_maps = vec![RegionMap {
            pairs: vec![[3, 7], [7, 3]],
        }];
        let sizes = Sizes::of_regions(&document);
        assert_eq!(sizes.of_region, [Some(1.0), Some(edges), Some(1.0)]);
        document.region_maps.clear();
        document.wishes.size = None;
        let sizes = Sizes::of_regions(&document);
        assert_eq!(sizes.loosest(&[0, 2]), None);
        assert_eq!(sizes.loosest(&[0]), Some(4.0));
    }
}
