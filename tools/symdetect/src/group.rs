//! The point group about the main axis, and its verification as a whole.

use crate::mirror::{HALF_TURN, HORIZONTAL, VERTICAL};
use crate::permutation::Permutation;
use crate::shape::{Motion, Shape};
use crate::verify::{Bound, Depth, Deviation, Operation};
use glam::DMat3;
use tmesh::{Frame, Isometry, Kind};

/// Operations that turn the axis over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flip {
    /// None.
    None,
    /// The mirror across the axis.
    Horizontal,
    /// The rotary reflection by half a step.
    Rotary,
    /// Half turns about axes across the main one; the frame's x direction is one of them.
    HalfTurn,
}

/// A group of operations in a frame: rotations by steps of a turn over `order` about z, the mirror
/// y -> -y, and a flip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// Order of the rotation, at least 1.
    pub order: u32,
    /// Whether mirrors contain the axis.
    pub mirror: bool,
    /// What turns the axis over.
    pub flip: Flip,
}

/// What verification found.
#[derive(Clone, Debug)]
pub struct Verified {
    /// Largest deviation, in the units of the shape.
    pub deviation: Deviation,
    /// Regions under one step of the rotation.
    pub rotation: Permutation,
    /// Regions under the mirror y -> -y.
    pub mirror: Permutation,
    /// Regions under the flip.
    pub flip: Permutation,
}

impl Group {
    /// The same as a document has it.
    pub fn named(&self) -> tmesh::Group {
        let kind = match (self.flip, self.mirror) {
            (Flip::None, false) => Kind::C,
            (Flip::None, true) => Kind::Cv,
            (Flip::Horizontal, false) => Kind::Ch,
            (Flip::Horizontal, true) => Kind::Dh,
            (Flip::Rotary, false) => Kind::S,
            (Flip::Rotary, true) => Kind::Dd,
            (Flip::HalfTurn, _) => Kind::D,
        };
        tmesh::Group::new(kind, self.order)
    }

    /// Schoenflies symbol with the order written out.
    pub fn symbol(&self) -> String {
        self.named().symbol()
    }

    /// How much there is beside the rotation: mirrors count most.
    pub fn rank(&self) -> u32 {
        2 * u32::from(self.mirror) + u32::from(self.flip != Flip::None)
    }

    /// Matrix of the flip in the frame.
    pub fn flip_matrix(&self) -> Option<DMat3> {
        match self.flip {
            Flip::None => None,
            Flip::Horizontal => Some(HORIZONTAL),
            Flip::Rotary => Some(Isometry::rotation(1, 2 * self.order).matrix() * HORIZONTAL),
            Flip::HalfTurn => Some(HALF_TURN),
        }
    }

    /// Verifies all operations in a frame, within the bound.
    pub fn verify(
        &self,
        shape: &Shape,
        frame: &Frame,
        bound: Bound,
        depth: Depth,
    ) -> Result<Verified, Deviation> {
        let identity = Permutation::identity(shape.regions.len());
        let mut rotation = (Deviation::NONE, identity.clone());
        if self.order > 1 {
            rotation = shape.verify_rotation(frame, self.order, bound, depth)?;
        }
        let mut worst = rotation.0;
        let (mut mirror, mut flip) = (identity.clone(), identity);
        if self.mirror {
            let found = self.verify_coset(shape, frame, VERTICAL, &rotation, bound, depth)?;
            worst = worst.max(found.0);
            mirror = found.1;
        }
        if let Some(matrix) = self.flip_matrix() {
            let found = self.verify_coset(shape, frame, matrix, &rotation, bound, depth)?;
            worst = worst.max(found.0);
            flip = found.1;
        }
        Ok(Verified {
            deviation: worst,
            rotation: rotation.1,
            mirror,
            flip,
        })
    }

    /// Verifies an operation and its products with all rotations.
    fn verify_coset(
        &self,
        shape: &Shape,
        frame: &Frame,
        matrix: DMat3,
        (turning, rotation): &(Deviation, Permutation),
        bound: Bound,
        depth: Depth,
    ) -> Result<(Deviation, Permutation), Deviation> {
        let (first, permutation) = shape.verify_one(Motion::new(frame, matrix), bound, depth)?;
        if self.order == 1 || shape.implies(self.order, *turning, first, bound) {
            return Ok((first, permutation));
        }
        let powers = rotation.powers(self.order);
        let operations: Vec<Operation> = (1..self.order)
            .map(|k| {
                let turn = Isometry::rotation(i64::from(k), self.order).matrix();
                Operation {
                    motion: Motion::new(frame, turn * matrix),
                    target: shape.target(&powers[k as usize].after(&permutation)),
                }
            })
            .collect();
        let others = shape.verify_family(&operations, bound, Depth::Quick)?;
        Ok((first.max(others), permutation))
    }
}
