//! Which piece of the body becomes the wedge, and which copies of it make the body.

use crate::error::CutError;
use glam::DVec3;
use tmesh::{Instance, Isometry, Region, RegionMap, Symmetry};

/// Which walls the wedge gets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Domain {
    /// Mirror walls where the body has mirror planes, a seam elsewhere
    #[default]
    Auto,
    /// A wedge of angle pi/n between two mirror planes
    Mirror,
    /// A wedge of angle 2 pi/n whose sides are images of each other
    Rotation,
}

/// Whether the column around the axis is made a template of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hub {
    /// Where it pays.
    #[default]
    Auto,
    /// No.
    None,
    /// Yes, with this inscribed radius, model units.
    Radius(f64),
}

/// Least angle of the hub's wedge, degrees.
const HUB_ANGLE: u32 = 30;
/// Least order of the wedge for a hub.
pub const HUB_LEAST_ORDER: u32 = 3;

/// The largest divisor of a wedge's order for a hub whose own wedge is at least [`HUB_ANGLE`] wide.
pub fn hub_order(order: u32, mirror: bool) -> u32 {
    let full = if mirror { 180 } else { 360 };
    (1..=order.min(full / HUB_ANGLE))
        .rev()
        .find(|h| order.is_multiple_of(*h))
        .unwrap_or(1)
}

/// All divisors, increasing.
pub fn divisors(n: u32) -> Vec<u32> {
    (1..=n).filter(|d| n.is_multiple_of(*d)).collect()
}

/// What to cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// Walls.
    pub domain: Domain,
    /// Order used for meshing, a divisor of the order found; `None` chooses.
    pub order: Option<u32>,
    /// Angle of the first side from the mirror direction, radians; `None` chooses.
    pub start_angle: Option<f64>,
    /// Distance up to which points are moved onto a cut plane or the axis, relative to the radius
    /// about the axis; `None` derives it from the precision of the input and the residual of the
    /// symmetry.
    pub snap: Option<f64>,
    /// The hub.
    pub hub: Hub,
    /// Whether a mirror plane across the axis halves the wedge where it pays; false for never.
    pub level: bool,
    /// Largest volume of an element that will be asked of the mesher, model units cubed, where the
    /// document has none for the region.
    pub max_volume: Option<f64>,
    /// Bound on the ratio of circumradius to shortest edge that will be asked of the mesher.
    pub radius_edge: f64,
    /// Edges shorter than this, relative to the radius about the axis, are collapsed; 0 for none.
    pub clean: f64,
    /// Threads used at most; the result does not depend on it.
    pub threads: usize,
}

impl Params {
    /// Whether anything is left to choose once the order found is known.
    pub fn chooses(&self) -> bool {
        self.order.is_none() || self.hub == Hub::Auto || self.level
    }

    /// Largest volume of an element in a region that will be asked for, model units cubed.
    pub fn max_volume_of(&self, regions: &[Region], region: u32) -> Option<f64> {
        let at = regions.binary_search_by_key(&region, |r| r.id).ok()?;
        regions[at].max_volume.or(self.max_volume)
    }
}

/// The hub's size and symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HubPlan {
    /// Radius of the circle inscribed in the hub's polygon, model units.
    pub radius: f64,
    /// Order of the hub's rotation, a divisor of the wedge's.
    pub order: u32,
}

/// The wedge and its copies.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Order of the rotation used.
    pub order: u32,
    /// Whether the sides are mirror walls.
    pub mirror: bool,
    /// Whether the plane z = 0 is a mirror wall.
    pub level: bool,
    /// Angle of the wedge as a turn: `pi / order` or `2 pi / order`.
    pub opening: Isometry,
    /// All copies.
    pub instances: Vec<Instance>,
    /// Region renamings the copies use.
    pub region_maps: Vec<RegionMap>,
    /// Which mirror plane the first side lies in, in steps of half the angle of the order found from the
    /// mirror direction. Reflections in different ones may rename regions differently.
    pub first_plane: i64,
}

impl Plan {
    /// Takes domain and order; `level` halves the wedge at the plane z = 0, a mirror plane.
    ///
    /// # Errors
    /// An order that does not divide the order found; mirror walls without mirror planes.
    pub fn new(symmetry: &Symmetry, params: &Params, level: bool) -> Result<Self, CutError> {
        let found = symmetry.group.order;
        let order = params.order.unwrap_or(found);
        if order == 0 || !found.is_multiple_of(order) {
            let divisors: Vec<_> = divisors(found).iter().map(u32::to_string).collect();
            return Err(CutError::NotADivisor {
                asked: order,
                found,
                divisors: divisors.join(", "),
                hint: match symmetry.axisymmetric {
                    true => format!(
                        "; of a body of revolution, symdetect --order {order} verifies another one"
                    ),
                    false => String::new(),
                },
            });
        }
        let mirror = match params.domain {
            Domain::Auto => symmetry.group.has_vertical_mirrors(),
            Domain::Rotation => false,
            Domain::Mirror if symmetry.group.has_vertical_mirrors() => true,
            Domain::Mirror => return Err(CutError::NoMirror(symmetry.group.symbol())),
        };
        let opening = Isometry::rotation(1, if mirror { 2 * order } else { order });
        let mut plan = Self {
            order,
            mirror,
            level,
            opening,
            instances: Vec::new(),
            region_maps: Vec::new(),
            first_plane: 0,
        };
        if let (true, Some(angle)) = (mirror, params.start_angle) {
            let step = std::f64::consts::PI / f64::from(found);
            let planes = (angle / step).round();
            if (angle - planes * step).abs() > 1e-9 {
                let (angle, step) = (angle.to_degrees(), step.to_degrees());
                return Err(CutError::NotAMirrorPlane { angle, step });
            }
            plan.first_plane = planes as i64;
        }
        plan.add_instances(symmetry);
        Ok(plan)
    }

    /// Whether the wedge is the whole body.
    pub fn is_whole(&self) -> bool {
        self.order == 1 && !self.mirror
    }

    /// Whether both sides lie in one plane: the wedge is half of space.
    pub fn is_half(&self) -> bool {
        self.opening == Isometry::rotation(1, 2)
    }

    /// A hub of the given inscribed radius, model units.
    ///
    /// # Errors
    /// A wedge that is too wide for one.
    pub fn hub(&self, radius: f64) -> Result<HubPlan, CutError> {
        // The hub's plane has to cross both sides.
        if self.order < HUB_LEAST_ORDER {
            return Err(CutError::BadHub {
                radius,
                reason: format!(
                    "the wedge of order {} is too wide for one; orders from {HUB_LEAST_ORDER} can have a hub",
                    self.order
                ),
            });
        }
        Ok(HubPlan {
            radius,
            order: hub_order(self.order, self.mirror),
        })
    }

    /// Adds the copies of the hub, template 1.
    pub fn add_hub(&mut self, hub: &HubPlan) {
        let copies: Vec<Instance> = self
            .instances
            .iter()
            .filter(|i| hub.order.is_multiple_of(i.isometry.n()))
            .map(|i| Instance { template: 1, ..*i })
            .collect();
        self.instances.extend(copies);
    }

    /// How a copy of the wedge renames regions.
    pub fn regions_of(&self, isometry: Isometry) -> Option<&RegionMap> {
        let instance = self.instances.iter().find(|i| i.isometry == isometry)?;
        let index = instance.region_map.checked_sub(1)?;
        self.region_maps.get(index as usize)
    }

    fn add_instances(&mut self, symmetry: &Symmetry) {
        let step = symmetry.group.order / self.order;
        let list = [(false, false), (true, false), (false, true), (true, true)];
        for k in 0..self.order {
            for (mirrored, flipped) in list {
                if (mirrored && !self.mirror) || (flipped && !self.level) {
                    continue;
                }
                // The reflection in the first side is that in the plane along x, then steps of the rotation.
                let first = match mirrored {
                    true => self.first_plane.rem_euclid(i64::from(symmetry.group.order)) as u32,
                    false => 0,
                };
                let turn = i64::from(k * step + first);
                let element = Isometry::new(turn, symmetry.group.order, mirrored, flipped);
                let map = symmetry.region_map(element);
                let region_map = if map.pairs.is_empty() {
                    0
                } else {
                    let at = self.region_maps.iter().position(|m| *m == map);
                    1 + at.unwrap_or_else(|| {
                        self.region_maps.push(map);
                        self.region_maps.len() - 1
                    }) as u32
                };
                let isometry = Isometry::new(i64::from(k), self.order, mirrored, flipped);
                self.instances.push(Instance {
                    template: 0,
                    isometry,
                    region_map,
                });
            }
        }
    }
}

/// Parts of the wedge's opening of which each has an angle to try.
const PLACES: usize = 16;

/// Gaps narrower than this part of the largest are places next to a vertex.
const LEAST_GAP: f64 = 1e-3;

/// Angles for the first side of a rotation wedge, radians, best first: the middle of the largest gap
/// between the angles of the vertices modulo the wedge's opening, so that the sides cut edges cleanly
/// between vertices, the smallest such angle when several gaps are equal; then the same about a
/// part of the opening further on each.
pub fn clear_angles(vertices: &[DVec3], order: u32, axis_tolerance: f64) -> Vec<f64> {
    let opening = std::f64::consts::TAU / f64::from(order);
    let mut angles: Vec<f64> = vertices
        .iter()
        .filter(|p| p.x.hypot(p.y) > axis_tolerance)
        .map(|p| libm::atan2(p.y, p.x).rem_euclid(opening))
        .collect();
    angles.sort_unstable_by(f64::total_cmp);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else {
        return vec![0.0];
    };
    let wrap = (last - opening, *first);
    let gaps = || std::iter::once(wrap).chain(angles.windows(2).map(|w| (w[0], w[1])));
    // Gaps equal up to rounding count as equal, so that noise does not choose.
    let largest = |gaps: &mut dyn Iterator<Item = (f64, f64)>| {
        gaps.reduce(
            |best, gap| match gap.1 - gap.0 > (best.1 - best.0) * (1.0 + 1e-6) {
                true => gap,
                false => best,
            },
        )
    };
    let middle = |gap: (f64, f64)| (0.5 * (gap.0 + gap.1)).rem_euclid(opening);
    let widest = largest(&mut gaps());
    let best = widest.map_or(0.0, middle);
    let least = LEAST_GAP * widest.map_or(0.0, |gap| gap.1 - gap.0);
    let part = opening / PLACES as f64;
    let others = (1..PLACES).filter_map(|k| {
        let around = best + part * k as f64;
        let off = |gap: (f64, f64)| (middle(gap) - around + 0.5 * opening).rem_euclid(opening);
        let is_near = |gap: &(f64, f64)| (off(*gap) - 0.5 * opening).abs() <= 0.5 * part;
        let is_open = |gap: &(f64, f64)| gap.1 - gap.0 > least;
        largest(&mut gaps().filter(is_open).filter(is_near)).map(middle)
    });
    std::iter::once(best).chain(others).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clear_angle_avoids_vertices() {
        let at = |degrees: f64| {
            let a = degrees.to_radians();
            DVec3::new(a.cos(), a.sin(), 0.0)
        };
        let vertices = [at(0.0), at(10.0), at(90.0), at(100.0), at(200.0)];
        // Modulo 90: 0, 10, 0, 10, 20; the largest gap is 20 to 90.
        let angles = clear_angles(&vertices, 4, 1e-9);
        assert!((angles[0].to_degrees() - 55.0).abs() < 1e-9, "{angles:?}");
        // Further on, one for each part with a gap: between 0 and 10, and between 10 and 20.
        let others: Vec<f64> = angles[1..].iter().map(|a| a.to_degrees().round()).collect();
        assert_eq!(others, [5.0, 15.0]);
    }
}
