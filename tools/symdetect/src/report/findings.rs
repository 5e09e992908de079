//! What to say of the symmetry found.

use crate::group::Found;
use crate::numbers::{At, short};
use crate::report::detection::Detection;
use crate::rotation::{Query, Rotation};
use tmesh::{Axis, OtherAxis, Symmetry};

impl Query<'_> {
    /// The symmetry found, with remarks.
    pub fn detection(
        &self,
        found: Found,
        rotations: &[Rotation],
        log: &mut dyn FnMut(&str),
    ) -> Detection {
        let other_axes = self.other_axes(&found, rotations);
        let rejected = if found.group.order > 1 {
            self.rejected(&found)
        } else {
            Vec::new()
        };
        log(&format!("{} orders rejected are listed", rejected.len()));
        let mut symmetry = self.symmetry(&found);
        let notes = self.notes(&found, &symmetry, &other_axes);
        symmetry.other_axes = other_axes;
        symmetry.rejected = rejected;
        Detection {
            profile: self.profile(&found.frame, found.group.order),
            symmetry,
            notes,
            asymmetric: None,
        }
    }

    /// The group found, in world coordinates.
    fn symmetry(&self, found: &Found) -> Symmetry {
        let (frame, group) = (&found.frame, found.group);
        let regions = &self.shape.interfaces.regions;
        Symmetry {
            group: group.symbol(),
            order: group.order,
            mirror: group.has_vertical_mirrors(),
            horizontal_mirror: group.has_horizontal_mirror(),
            axis: Axis {
                point: self.shape.to_world(frame.origin).to_array(),
                direction: frame.rotation.z_axis.to_array(),
            },
            mirror_direction: frame.rotation.x_axis.to_array(),
            residual: found.verified.deviation.value / found.radius,
            tolerance: self.params.tolerance,
            axisymmetric: found.axisymmetric,
            radius: found.radius * self.shape.scale,
            other_axes: Vec::new(),
            rejected: Vec::new(),
            rotation_regions: found.verified.rotation.pairs(regions),
            mirror_regions: found.verified.mirror.pairs(regions),
            horizontal_regions: if group.has_horizontal_mirror() {
                found.verified.turning.pairs(regions)
            } else {
                Vec::new()
            },
            promise: None,
        }
    }

    /// Remarks for the user, a sentence each.
    fn notes(&self, found: &Found, symmetry: &Symmetry, other_axes: &[OtherAxis]) -> Vec<String> {
        let (group, order) = (found.group.symbol(), found.group.order);
        let (residual, tolerance) = (symmetry.residual, self.params.tolerance);
        let mut notes = vec![format!(
            "{group} about {} through {}, residual {residual:.1e} of the radius {}",
            At(found.frame.rotation.z_axis),
            At(self.shape.to_world(found.frame.origin)),
            short(symmetry.radius)
        )];
        if residual > tolerance {
            notes.push(format!(
                "beyond the tolerance of {tolerance:e} only as far as the facets of smooth surfaces explain"
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
        let moved = symmetry.rotation_regions.len();
        if moved > 0 {
            notes.push(format!("the rotation maps {moved} regions onto other ones"));
        }
        notes
    }
}
