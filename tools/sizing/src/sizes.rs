//! The sizes that a document asks for.

use crate::across::{Across, across_walls};
use crate::cubes::cubes;
use crate::field::{Folded, Limited, mean_cubes};
use crate::too_many::TooMany;
use crate::tree::{Graded, cube};
use glam::DVec3;
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
    /// The largest length that a size field wants in its cube, model units.
    pub longest: Option<f64>,
}

impl Sizes {
    /// None at all, of a document.
    pub fn none(document: &Document) -> Self {
        let regions = document.regions.len();
        Self {
            of_region: vec![None; regions],
            lengths: vec![None; regions],
            local: vec![None; document.templates.len()],
        }
    }

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
        let wishes = &document.wishes;
        let is_asked = wishes.layers_across.is_some() || document.size_field.is_some();
        if !is_asked || !wishes.quality() {
            return Ok(sizes);
        }
        let growth = wishes.gradation() - 1.0;
        let field = document.size_field.as_ref();
        let field = field.map(|field| Limited::new(field, &document.frame, growth));
        for index in 0..document.templates.len() {
            let local = Local::new((document, index), field.as_ref(), growth)?;
            sizes.local[index] = Some(local);
        }
        Ok(sizes)
    }
}

impl Local {
    /// What holds in a template besides the sizes of regions: the least of what walls and a size field ask for.
    ///
    /// # Errors
    /// [`TooMany`].
    pub fn new(
        (document, index): (&Document, usize),
        field: Option<&Limited>,
        growth: f64,
    ) -> Result<Self, TooMany> {
        let template = &document.templates[index];
        let across = match document.wishes.layers_across {
            Some(layers) => {
                let copies = document.instances.len();
                let across = across_walls((template, index), copies, f64::from(layers));
                across.map_err(|thinnest| TooMany::Walls {
                    template: index,
                    layers,
                    thinnest,
                })?
            }
            None => Across::default(),
        };
        let Some(field) = field else {
            let sources = &across.sources;
            return Ok(Self {
                graded: Graded::new(sources, growth, f64::INFINITY, ends(template)),
                cubes: across.cubes,
                longest: None,
            });
        };
        let beyond = TooMany::Field { template: index };
        // Before a tree is made for what cannot be.
        if mean_cubes((document, index)).is_some_and(are_too_many) {
            return Err(beyond);
        }
        let cube = cube(ends(template));
        let folded = Folded::new(field, (document, index), cube).ok_or(beyond)?;
        let sources = &across.sources;
        let graded = Graded::with_field(sources, growth, f64::INFINITY, cube, Some(&folded));
        let graded = graded.ok_or(beyond)?;
        let leaves = graded.leaves();
        let sizes = leaves.iter().map(|leaf| leaf.2).filter(|s| s.is_finite());
        let cubes = cubes(template, &leaves);
        if are_too_many(cubes) {
            return Err(beyond);
        }
        Ok(Self {
            cubes,
            longest: sizes.reduce(f64::max),
            graded,
        })
    }
}

/// Whether elements of so many cubes are more than the mesher can count: corners of tetrahedra, in 32 bits.
fn are_too_many(cubes: f64) -> bool {
    cubes / Size::OF_CUBE > f64::from(i32::MAX) / 4.0
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
        // Some instance has the third region where the template has the first.
        document.region_maps = vec![RegionMap {
            pairs: vec![[3, 7], [7, 3]],
        }];
        let sizes = Sizes::of_regions(&document);
        assert_eq!(sizes.of_region, [Some(1.0), Some(edges), Some(1.0)]);
        document.region_maps.clear();
        document.wishes.size = None;
        let sizes = Sizes::of_regions(&document);
        assert_eq!(sizes.of_region, [Some(4.0), Some(edges), None]);
    }
}
