//! What to say of the symmetry found: other axes, orders that do not hold, remarks.

use crate::complete::Found;
use crate::detect::{Detection, Job};
use crate::error::{At, short};
use crate::group::Flip;
use crate::order::{Rotation, deviation_measured};
use crate::placement;
use crate::shape::Motion;
use crate::summary::OrderResidual;
use crate::verify::Depth;
use glam::{DMat3, DVec3};
use kit::in_parallel;
use tmesh::{Axis, Frame, Isometry, OtherAxis, RegionMap, RejectedOrder, Search, Symmetry};

/// Other axes listed at most.
const MOST_OTHER_AXES: usize = 64;
/// Rejected orders listed at most.
const MOST_REJECTED: usize = 16;
/// Orders in a profile at least and at most.
const FEWEST_PLOTTED: u32 = 24;
const MOST_PLOTTED: u32 = 300;
/// Tests of an order that is not among the nearest to holding, and of one that is.
const ROUGH: usize = 24;
const CLOSE: usize = 128;
/// Deviation, relative to the radius, beyond which a rejected order is not measured exactly.
const FAR_OFF: f64 = 0.05;

impl Job<'_> {
    pub(crate) fn report(
        &self,
        found: Found,
        rotations: &[Rotation],
        log: &mut dyn FnMut(&str),
    ) -> Detection {
        let shape = self.shape;
        let (frame, group) = (&found.frame, found.group);
        let residual = found.verified.deviation.value / found.radius;
        let other_axes = self.other_axes(&found, rotations);
        let rejected = if group.order > 1 {
            self.rejected(&found)
        } else {
            Vec::new()
        };
        log(&format!("{} orders rejected are listed", rejected.len()));
        let mut notes = Vec::new();
        if residual > self.params.tolerance {
            notes.push(format!(
                "beyond the tolerance of {:e} only as far as the facets of smooth surfaces explain",
                self.params.tolerance
            ));
        }
        if found.axisymmetric && !found.distinct {
            notes.push(format!(
                "a body of revolution whose facets have no common order; order {} stands for any",
                group.order
            ));
        } else if found.axisymmetric {
            notes.push(format!(
                "a body of revolution with {} facets around the axis",
                group.order
            ));
        }
        if let Some(name) = self.polyhedral(&found, &other_axes) {
            notes.push(format!(
                "the whole point group is {name}, with {} axes; {} is the part about the main axis",
                other_axes.len() + 1,
                group.symbol()
            ));
        }
        let regions = &shape.regions;
        let centre = shape.to_world(frame.origin);
        // In the order of the group's generators.
        let operations = [
            (group.order > 1, &found.verified.rotation),
            (group.mirror, &found.verified.mirror),
            (group.flip != Flip::None, &found.verified.flip),
        ];
        let maps: Vec<RegionMap> = operations
            .into_iter()
            .filter(|(there, _)| *there)
            .map(|(_, permutation)| RegionMap {
                pairs: permutation.pairs(regions),
            })
            .collect();
        let permuted = maps.iter().any(|map| !map.pairs.is_empty());
        let symmetry = Symmetry {
            group: group.named(),
            axis: Axis {
                point: centre.to_array(),
                direction: frame.rotation.z_axis.to_array(),
            },
            reference: frame.rotation.x_axis.to_array(),
            residual,
            tolerance: self.params.tolerance,
            axisymmetric: found.axisymmetric,
            radius: found.radius * shape.scale,
            regions: if permuted { maps } else { Vec::new() },
        };
        let turned = symmetry.rotation_regions().pairs.len();
        if group.order > 1 && turned > 0 {
            notes.push(format!(
                "the rotation maps {turned} regions onto other ones"
            ));
        }
        notes.insert(
            0,
            format!(
                "{} about {} through {}, residual {:.1e} of the radius {}",
                symmetry.group,
                At(frame.rotation.z_axis),
                At(centre),
                residual,
                short(symmetry.radius)
            ),
        );
        Detection {
            profile: self.profile(frame, group.order),
            symmetry,
            search: Search {
                other_axes,
                rejected,
            },
            notes,
            asymmetric: None,
        }
    }

    /// Further axes: half turns across the main one, and those of a polyhedral group.
    fn other_axes(&self, found: &Found, rotations: &[Rotation]) -> Vec<OtherAxis> {
        let z = found.frame.rotation.z_axis;
        let mut axes: Vec<OtherAxis> = Vec::new();
        let add = |axes: &mut Vec<OtherAxis>, d: DVec3, order: u32, residual: f64| {
            let new = axes
                .iter()
                .all(|a| DVec3::from_array(a.direction).cross(d).length() > 2e-3);
            if new && d.cross(z).length() > 2e-3 && axes.len() < MOST_OTHER_AXES {
                let d = placement::forward(d);
                axes.push(OtherAxis {
                    direction: d.to_array(),
                    order,
                    residual,
                });
            }
        };
        let mut others: Vec<&Rotation> = rotations.iter().filter(|r| r.distinct).collect();
        others.sort_by_key(|r| std::cmp::Reverse(r.order));
        for r in others {
            let residual = r.deviation.value / found.radius;
            add(&mut axes, r.frame.rotation.z_axis, r.order, residual);
        }
        let half_turns = match (found.group.flip, found.group.mirror) {
            (Flip::Horizontal, true) | (Flip::HalfTurn, _) => Some(0),
            (Flip::Rotary, true) => Some(1),
            _ => None,
        };
        if let Some(phase) = half_turns {
            let n = found.group.order;
            let residual = found.verified.deviation.value / found.radius;
            for k in 0..n {
                // Half turns lie along the mirrors, or between them.
                let turn = Isometry::rotation(i64::from(2 * k + phase), 4 * n);
                let d = found.frame.rotation * turn.apply(DVec3::X);
                add(&mut axes, d, 2, residual);
            }
        }
        axes
    }

    /// Name of the polyhedral group, if axes of order three or more point in several directions.
    fn polyhedral(&self, found: &Found, axes: &[OtherAxis]) -> Option<String> {
        let high: Vec<u32> = axes.iter().map(|a| a.order).filter(|&n| n >= 3).collect();
        if high.is_empty() || found.group.order < 3 || found.axisymmetric {
            return None;
        }
        let highest = high.iter().copied().max()?.max(found.group.order);
        let letter = match highest {
            3 => "T",
            4 => "O",
            5 => "I",
            _ => return None,
        };
        let bound = self.limits.bound(found.radius);
        let inversion = Motion::new(&found.frame, -DMat3::IDENTITY);
        let suffix = if self
            .shape
            .verify_one(inversion, bound, Depth::Quick)
            .is_ok()
        {
            "h"
        } else if found.group.mirror && letter == "T" {
            "d"
        } else {
            ""
        };
        Some(format!("{letter}{suffix}"))
    }

    /// Residuals of the orders up to twice the one that holds, and at least some.
    pub(crate) fn profile(&self, frame: &Frame, holds: u32) -> Vec<OrderResidual> {
        if !self.params.profile {
            return Vec::new();
        }
        let radius = self.shape.radius(frame).max(1e-12);
        let most = (2 * holds).clamp(FEWEST_PLOTTED, MOST_PLOTTED);
        let measure = |order| OrderResidual {
            order,
            residual: deviation_measured(self.shape, frame, order, 600, radius)
                .value
                .min(radius)
                / radius,
            holds: holds.is_multiple_of(order),
        };
        (2..=most).map(measure).collect()
    }

    /// Orders about the main axis that do not hold: small multiples of the one found, and the ones
    /// that come nearest to holding.
    fn rejected(&self, found: &Found) -> Vec<RejectedOrder> {
        let n = found.group.order;
        let most = self.params.max_order.max(n).min((4 * n).max(48)).min(768);
        let most_off = FAR_OFF * found.radius;
        let multiple = |m: u32| m == 2 * n || m == 3 * n;
        let measure = |order: u32, count: usize| RejectedOrder {
            order,
            residual: deviation_measured(self.shape, &found.frame, order, count, most_off).value
                / found.radius,
        };
        let nearest_first = |list: &mut Vec<RejectedOrder>| {
            list.retain(|r| r.residual > self.params.tolerance);
            list.sort_by(|a, b| {
                let by_residual = a.residual.total_cmp(&b.residual);
                by_residual.then(a.order.cmp(&b.order))
            });
        };
        // A few tests tell which ones are worth more.
        let orders: Vec<u32> = (2..=most)
            .filter(|m| !n.is_multiple_of(*m))
            // Of a body of revolution all others are alike.
            .filter(|m| !found.axisymmetric || multiple(*m))
            .collect();
        let threads = self.params.threads;
        let mut measured = in_parallel(&orders, threads, |&m| {
            let rough = measure(m, ROUGH);
            match rough.residual > self.params.tolerance {
                true => rough,
                false => measure(m, CLOSE),
            }
        });
        nearest_first(&mut measured);
        let mut place = 0;
        measured.retain(|r| {
            place += 1;
            multiple(r.order) || place <= MOST_REJECTED + MOST_REJECTED / 4
        });
        measured = in_parallel(&measured, threads, |r| measure(r.order, CLOSE));
        nearest_first(&mut measured);
        let nearest = measured.clone();
        let mut kept: Vec<RejectedOrder> = (measured.iter())
            .filter(|r| multiple(r.order))
            .cloned()
            .collect();
        for r in nearest {
            if kept.len() < MOST_REJECTED && kept.iter().all(|k| k.order != r.order) {
                kept.push(r);
            }
        }
        // So far only those near to holding are exact.
        kept = in_parallel(&kept, threads, |r| {
            let exact = || deviation_measured(self.shape, &found.frame, r.order, CLOSE, 1.0);
            let residual = match r.residual > FAR_OFF {
                true => exact().value / found.radius,
                false => r.residual,
            };
            RejectedOrder {
                residual,
                ..r.clone()
            }
        });
        kept.sort_by_key(|r| r.order);
        kept
    }
}
