//! What is known of the symmetry of a body: what was found in it, what its mesh promises, and how the
//! search went. Three things, each a chunk of JSON.

use crate::{Frame, Group, Isometry, RegionMap};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A line in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// A point on the axis, model units.
    pub point: [f64; 3],
    /// Unit direction.
    pub direction: [f64; 3],
}

/// The symmetry found in a body, in the frame of the input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Symmetry {
    /// The group about the main axis.
    pub group: Group,
    /// The main axis; its point is the centre of the body, which operations that turn the axis over
    /// leave in place.
    pub axis: Axis,
    /// Unit vector orthogonal to the axis, the x axis of the canonical frame: in a mirror plane if any
    /// contain the axis, else along a half turn's axis if there are any, else a reference for angles.
    pub reference: [f64; 3],
    /// Largest deviation found over all verified operations, relative to the radius about the axis.
    pub residual: f64,
    /// Tolerance the verification used, relative to the radius about the axis.
    pub tolerance: f64,
    /// Whether every order holds within the tolerance: a body of revolution. The group's order is then
    /// the facet count.
    pub axisymmetric: bool,
    /// Largest distance of a surface point from the axis, model units.
    pub radius: f64,
    /// How each of [`Group::generators`], in their order, permutes region ids; empty if none does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionMap>,
}

impl Symmetry {
    /// The canonical frame: z along the axis, x along the reference, the origin at the centre. `None`
    /// when the directions do not span one.
    pub fn frame(&self) -> Option<Frame> {
        let [point, axis, reference] =
            [self.axis.point, self.axis.direction, self.reference].map(DVec3::from_array);
        Frame::from_axis(point, axis, reference)
    }

    /// How the rotation by one step permutes regions.
    pub fn rotation_regions(&self) -> RegionMap {
        self.region_map(self.group.rotation())
    }

    /// The part of the group that takes every region to itself.
    pub fn keeping_regions(&self) -> Group {
        match self.regions.is_empty() {
            true => self.group,
            false => (self.group).part(|element| self.region_map(element).pairs.is_empty()),
        }
    }

    /// Regions that the group takes to each other, ids increasing; those that stay where they are are not among them.
    pub fn exchanged_regions(&self) -> Vec<Vec<u32>> {
        let pairs = self.regions.iter().flat_map(|map| &map.pairs);
        let mut orbits: Vec<Vec<u32>> = Vec::new();
        for &[from, to] in pairs {
            let (of, with): (Vec<_>, Vec<_>) = std::mem::take(&mut orbits)
                .into_iter()
                .partition(|orbit| !orbit.contains(&from) && !orbit.contains(&to));
            let mut joined = with.concat();
            joined.extend([from, to]);
            joined.sort_unstable();
            joined.dedup();
            orbits = of;
            orbits.push(joined);
        }
        orbits.sort_unstable();
        orbits
    }

    /// How an element of the group renames regions; the identity for other isometries.
    pub fn region_map(&self, element: Isometry) -> RegionMap {
        let Some((k, m, f)) = self.group.exponents(element) else {
            return RegionMap::default();
        };
        if self.regions.is_empty() {
            return RegionMap::default();
        }
        let has_rotation = self.group.order > 1;
        let has_mirror = self.group.has_vertical_mirrors();
        let of = |index: usize| self.regions.get(index);
        let rotation = of(0).filter(|_| has_rotation);
        let mirror = of(usize::from(has_rotation)).filter(|_| m);
        let over = of(usize::from(has_rotation) + usize::from(has_mirror)).filter(|_| f);
        let image = |id: u32| {
            // R^k M^m F^f: the last factor comes first.
            let id = over.map_or(id, |map| map.get(id));
            let id = mirror.map_or(id, |map| map.get(id));
            rotation.map_or(id, |map| power(map, k, id))
        };
        let maps = [rotation, mirror, over].into_iter().flatten();
        let mut pairs: Vec<[u32; 2]> = maps
            .flat_map(|map| &map.pairs)
            .map(|&[id, _]| [id, image(id)])
            .filter(|[from, to]| from != to)
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        RegionMap { pairs }
    }
}

/// Where a renaming that is done `k` times takes a region.
fn power(map: &RegionMap, k: u32, id: u32) -> u32 {
    let mut cycle = vec![id];
    while cycle.len() <= k as usize {
        let next = map.get(cycle[cycle.len() - 1]);
        if next == id {
            return cycle[k as usize % cycle.len()];
        }
        cycle.push(next);
    }
    cycle[k as usize]
}

/// The symmetry a mesh promises to have exactly: that of the instances it is made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Promise {
    /// The group, in the frame below.
    pub group: Group,
    /// Rows of the rotation matrix of the canonical frame (world = origin + rotation * canonical).
    pub rotation: [[f64; 3]; 3],
    /// Origin of the canonical frame in the world.
    pub origin: [f64; 3],
    /// The higher symmetry that holds away from the axis, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside: Option<Outside>,
}

/// The symmetry of the tetrahedra that reach beyond a cylinder about the axis: those with at least one
/// vertex farther from the axis than its radius, each as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outside {
    /// The group; its order is a multiple of that of the whole.
    pub group: Group,
    /// Radius of the cylinder, model units.
    pub radius: f64,
}

/// How the search for symmetry went, beside what it found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// Further symmetry axes, strongest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub other_axes: Vec<OtherAxis>,
    /// Orders that were tried and do not hold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rejected: Vec<RejectedOrder>,
}

/// A symmetry axis beside the main one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OtherAxis {
    /// Unit direction; the axis passes through the centre of the body.
    pub direction: [f64; 3],
    /// Highest order verified about it.
    pub order: u32,
    /// Largest deviation found, relative to the radius about the main axis.
    pub residual: f64,
}

/// An order that was tried and does not hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RejectedOrder {
    /// The order.
    pub order: u32,
    /// Deviation found, relative to the radius about the axis. A lower bound: the test stops at
    /// the first sample that is clearly off.
    pub residual: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;

    fn swap(a: u32, b: u32) -> RegionMap {
        RegionMap {
            pairs: vec![[a, b], [b, a]],
        }
    }

    fn symmetry(group: Group, regions: Vec<RegionMap>) -> Symmetry {
        Symmetry {
            group,
            axis: Axis {
                point: [0.0; 3],
                direction: [0.0, 0.0, 1.0],
            },
            reference: [1.0, 0.0, 0.0],
            residual: 0.0,
            tolerance: 1e-3,
            axisymmetric: false,
            radius: 1.0,
            regions,
        }
    }

    #[test]
    fn renamings_of_products_are_products_of_renamings() {
        let cycle = RegionMap {
            pairs: vec![[1, 2], [2, 3], [3, 1]],
        };
        for kind in Kind::ALL {
            let group = Group::new(kind, 3);
            let generators = group.generators();
            // Rotations turn three regions about, what mirrors and what turns over swaps others.
            let maps = [cycle.clone(), swap(7, 8), swap(5, 6)];
            let maps: Vec<RegionMap> = generators
                .iter()
                .map(|g| match (g.flipped(), g.mirrored()) {
                    (false, false) => maps[0].clone(),
                    (false, true) => maps[1].clone(),
                    (true, _) => maps[2].clone(),
                })
                .collect();
            let symmetry = symmetry(group, maps.clone());
            for (g, map) in generators.iter().zip(&maps) {
                assert_eq!(&symmetry.region_map(*g), map, "{group}");
            }
            let turned = symmetry.region_map(Isometry::rotation(2, 3));
            assert_eq!(turned.pairs, [[1, 3], [2, 1], [3, 2]]);
            if let Some(over) = group.turning_over() {
                let both = symmetry.region_map(group.rotation().compose(over));
                assert_eq!(both.pairs, [[1, 2], [2, 3], [3, 1], [5, 6], [6, 5]]);
            }
        }
        let maps = vec![swap(1, 2), swap(2, 3), swap(7, 8)];
        let exchanging = symmetry(Group::new(Kind::Dh, 2), maps);
        assert_eq!(exchanging.exchanged_regions(), [vec![1, 2, 3], vec![7, 8]]);
        let none = symmetry(Group::new(Kind::Cv, 3), Vec::new());
        assert_eq!(none.keeping_regions(), none.group);
        assert!(none.exchanged_regions().is_empty());
        // The rotation exchanges two regions, and the mirror does: what is left are its even steps and the odd mirrors.
        let both = symmetry(Group::new(Kind::Cv, 6), vec![swap(1, 2), swap(1, 2)]);
        assert_eq!(both.keeping_regions(), Group::new(Kind::Cv, 3));
        assert_eq!(none.region_map(Isometry::MIRROR), RegionMap::default());
    }
}
