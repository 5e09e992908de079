//! Verification of a whole group.

use crate::shape::{Motion, Permutation, Shape};
use crate::verify::deviation::{Bound, Depth, Deviation};
use crate::verify::operation::Operation;
use tmesh::{Frame, Group, Isometry};

/// What verification found.
#[derive(Clone, Debug)]
pub struct Verified {
    /// Largest deviation, in the units of the shape.
    pub deviation: Deviation,
    /// Regions under one step of the rotation.
    pub rotation: Permutation,
    /// Regions under the mirror y -> -y, if the group has it.
    pub mirror: Permutation,
    /// Regions under what turns the axis over, if the group has that.
    pub turning: Permutation,
}

impl Verified {
    /// Regions under one of the group's generators.
    pub fn regions(&self, generator: Isometry) -> &Permutation {
        match (generator.flipped(), generator.mirrored()) {
            (true, _) => &self.turning,
            (false, true) => &self.mirror,
            (false, false) => &self.rotation,
        }
    }
}

/// How a group is verified.
#[derive(Clone, Copy)]
pub struct Check<'a> {
    /// The body.
    pub shape: &'a Shape,
    /// The frame that the group is in.
    pub frame: &'a Frame,
    /// What deviations are allowed.
    pub bound: Bound,
    /// How thoroughly.
    pub depth: Depth,
}

impl Check<'_> {
    /// Verifies all operations of a group.
    pub fn group(&self, group: &Group) -> Result<Verified, Deviation> {
        let Self {
            shape,
            frame,
            bound,
            depth,
        } = *self;
        let identity = Permutation::identity(shape.region_count());
        let mut rotation = (Deviation::NONE, identity.clone());
        if group.order > 1 {
            rotation = shape.verify_rotation(frame, group.order, bound, depth)?;
        }
        let mut worst = rotation.0;
        let (mut mirror, mut turning) = (identity.clone(), identity);
        for generator in group.generators() {
            let regions = match (generator.flipped(), generator.mirrored()) {
                (true, _) => &mut turning,
                (false, true) => &mut mirror,
                (false, false) => continue,
            };
            let (deviation, permutation) = self.coset(group.order, generator, &rotation)?;
            worst = worst.max(deviation);
            *regions = permutation;
        }
        Ok(Verified {
            deviation: worst,
            rotation: rotation.1,
            mirror,
            turning,
        })
    }

    /// Verifies an operation and its products with all rotations.
    fn coset(
        &self,
        order: u32,
        operation: Isometry,
        (turning, rotation): &(Deviation, Permutation),
    ) -> Result<(Deviation, Permutation), Deviation> {
        let (shape, bound) = (self.shape, self.bound);
        let matrix = operation.matrix();
        let motion = Motion::new(self.frame, matrix);
        let (first, permutation) = shape.verify_one(motion, bound, self.depth)?;
        if order == 1 || shape.implies(order, *turning, first, bound) {
            return Ok((first, permutation));
        }
        let powers = rotation.powers(order);
        let operations: Vec<Operation> = (1..order)
            .map(|k| {
                let turn = Isometry::rotation(i64::from(k), order).matrix();
                Operation {
                    motion: Motion::new(self.frame, turn * matrix),
                    target: shape.target(&powers[k as usize].after(&permutation)),
                }
            })
            .collect();
        let others = shape.verify_family(&operations, bound, Depth::Quick)?;
        Ok((first.max(others), permutation))
    }
}
