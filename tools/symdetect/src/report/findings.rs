//! What to say of the symmetry found.

use crate::group::Found;
use crate::nearly::Nearly;
use crate::report::detection::Detection;
use crate::report::deviations::Deviations;
use crate::rotation::{Query, Rotation};
use kit::{number, point};
use tmesh::{Axis, Isometry, OtherAxis, RegionMap, Search, Symmetry};

impl Query<'_> {
    /// The symmetry found, with remarks.
    pub fn detection(
        &self,
        found: Found,
        rotations: &[Rotation],
        nearly: Option<Nearly>,
        log: &mut dyn FnMut(&str),
    ) -> Detection {
        let (other_axes, axes) = self.other_axes(&found, rotations);
        let rejected = if found.group.order > 1 {
            self.rejected(&found)
        } else {
            Vec::new()
        };
        log(&format!("{} orders rejected are listed", rejected.len()));
        let symmetry = self.symmetry(&found);
        let deviations = self.deviations(&found);
        Detection {
            profile: self.profile(&found.frame, found.group.order),
            notes: self.notes(&found, &symmetry, &deviations, &other_axes),
            symmetry,
            deviations,
            search: Search {
                other_axes,
                rejected,
            },
            axes,
            nearly,
            asymmetric: None,
        }
    }

    /// The group found, in world coordinates.
    fn symmetry(&self, found: &Found) -> Symmetry {
        let frame = &found.frame;
        let map = |generator: Isometry| {
            let permutation = found.verified.regions(generator);
            RegionMap {
                pairs: permutation.pairs(&self.shape.interfaces.regions),
            }
        };
        let regions: Vec<RegionMap> = found.group.generators().into_iter().map(map).collect();
        let permuted = regions.iter().any(|map| !map.pairs.is_empty());
        Symmetry {
            group: found.group,
            axis: Axis {
                point: self.shape.to_world(frame.origin).to_array(),
                direction: frame.rotation.z_axis.to_array(),
            },
            reference: frame.rotation.x_axis.to_array(),
            residual: found.verified.deviation.value / found.radius,
            tolerance: self.params.tolerance,
            axisymmetric: found.axisymmetric,
            radius: found.radius * self.shape.scale,
            regions: if permuted { regions } else { Vec::new() },
        }
    }

    /// Remarks for the user, a sentence each.
    fn notes(
        &self,
        found: &Found,
        symmetry: &Symmetry,
        deviations: &Deviations,
        other_axes: &[OtherAxis],
    ) -> Vec<String> {
        let (group, order) = (found.group.symbol(), found.group.order);
        let residual = symmetry.residual;
        let mut notes = vec![format!(
            "{group} about {} through {}, residual {residual:.1e} of the radius {}",
            point(found.frame.rotation.z_axis.to_array()),
            point(self.shape.to_world(found.frame.origin).to_array()),
            number(symmetry.radius)
        )];
        if let (Some(facets), Some(remaining)) = (deviations.facets, deviations.remaining) {
            notes.push(format!(
                "facets of smooth surfaces explain deviations of up to {:.1e} of the radius, at {}; {:.1e} at most remain",
                facets.largest,
                point(facets.at),
                remaining.largest
            ));
        }
        if found.axisymmetric && !found.distinct {
            notes.push(format!(
                "a body of revolution whose facets have no common order; order {order} stands for any"
            ));
        } else if found.axisymmetric {
            notes.push(format!(
                "a body of revolution with {order} facets around the axis"
            ));
        }
        if let Some(name) = self.polyhedral(found, other_axes) {
            notes.push(format!(
                "the whole point group is {name}, with {} axes; {group} is the part about the main axis",
                other_axes.len() + 1
            ));
        }
        notes
    }
}
