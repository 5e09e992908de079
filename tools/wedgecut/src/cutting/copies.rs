//! The copies that make the body.

use crate::cell::hub_order;
use tmesh::{Group, Instance, Isometry, RegionMap, Symmetry};

/// The copies of wedge and hub, and how they rename regions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Copies {
    /// All copies.
    pub instances: Vec<Instance>,
    /// Region renamings the copies use.
    pub region_maps: Vec<RegionMap>,
}

impl Copies {
    /// One copy of the wedge for each element of a group, and of the hub for each element that its own symmetry has;
    /// `regions` says how an element renames regions.
    pub fn new(group: Group, hub: bool, regions: impl Fn(Isometry) -> RegionMap) -> Self {
        let mut copies = Self::default();
        for isometry in group.elements() {
            let map = regions(isometry);
            let region_map = match map.pairs.is_empty() {
                true => 0,
                false => copies.number(map),
            };
            copies.instances.push(Instance {
                template: 0,
                isometry,
                region_map,
            });
        }
        if hub {
            let order = hub_order(group);
            let of_hub = |i: &&Instance| order.is_multiple_of(i.isometry.n());
            let copies_of_hub = copies.instances.iter().filter(of_hub);
            let hubs: Vec<Instance> = copies_of_hub
                .map(|i| Instance { template: 1, ..*i })
                .collect();
            copies.instances.extend(hubs);
        }
        copies
    }

    /// One more than the index of a map among the renamings.
    fn number(&mut self, map: RegionMap) -> u32 {
        let known = self.region_maps.iter().position(|m| *m == map);
        let at = known.unwrap_or_else(|| {
            self.region_maps.push(map);
            self.region_maps.len() - 1
        });
        at as u32 + 1
    }
}

/// How an element of a group, in a frame that is turned by `start`, renames regions.
pub fn regions_in(symmetry: &Symmetry, start: Isometry, element: Isometry) -> RegionMap {
    symmetry.region_map(start.compose(element).compose(start.inverse()))
}
