//! The rigid map between the canonical axis frame and the frame of the input.

use glam::{DMat3, DVec3};

/// Rigid map `world = origin + rotation * canonical`.
///
/// In the canonical frame the symmetry axis is z and the first wall of the wedge lies in the half
/// plane y = 0, x >= 0. Columns of `rotation` are the canonical axes seen in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Orthonormal, right-handed.
    pub rotation: DMat3,
    /// World position of the canonical origin, in model units.
    pub origin: DVec3,
}

impl Default for Frame {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Frame {
    /// The canonical frame is the world.
    pub const IDENTITY: Self = Self {
        rotation: DMat3::IDENTITY,
        origin: DVec3::ZERO,
    };

    /// The frame with the given axis through `origin`, whose x axis is as near to `x_hint` as a
    /// direction orthogonal to the axis can be.
    ///
    /// Returns `None` when the axis is zero or the hint is parallel to it.
    pub fn from_axis(origin: DVec3, axis: DVec3, x_hint: DVec3) -> Option<Self> {
        let z = axis.try_normalize()?;
        let x = (x_hint - z * x_hint.dot(z)).try_normalize()?;
        // Once more, so that the columns are orthogonal to working precision.
        let x = (x - z * x.dot(z)).try_normalize()?;
        Some(Self {
            rotation: DMat3::from_cols(x, z.cross(x), z),
            origin,
        })
    }

    /// World position of a canonical point.
    #[inline]
    pub fn to_world(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.origin
    }

    /// Canonical position of a world point.
    #[inline]
    pub fn to_canonical(&self, p: DVec3) -> DVec3 {
        self.rotation.transpose() * (p - self.origin)
    }

    /// Whether the map is exactly the identity.
    pub fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }
}
