//! The shape that a remeshed surface stands on, along which its vertices may be moved further.

use super::patches::UPRIGHT;
use super::{Envelope, Near};
use geom::measure::double_area_vector;
use glam::DVec3;

/// The patches of the input, with how far a surface may be from each place of them.
pub struct Ground(Envelope);

impl Ground {
    /// The ground of a surface that stays in an envelope.
    pub fn new(envelope: Envelope) -> Self {
        Self(envelope)
    }

    /// The place of a patch that is nearest to a point, and the unit normal of the shape there. log n.
    pub fn nearest(&self, patch: u32, p: DVec3) -> Option<(DVec3, DVec3)> {
        let at = self.0.nearest(Near::Patch(patch), p)?;
        Some((at, self.0.at(patch, at)?.0))
    }

    /// Whether a segment is near enough to a patch, all of it.
    pub fn spans(&self, patch: u32, ends: [DVec3; 2]) -> bool {
        self.0.holds(Near::Patch(patch), ends, 0.0)
    }

    /// Whether a triangle may stand for a part of a patch whose first corner was moved: whether it faces as that does, and the lines from its
    /// first corner to its second and to the middle of the side between the others are in the envelope. All triangles around a vertex have all
    /// sides at it together.
    pub fn holds(&self, patch: u32, [a, b, c]: [DVec3; 3]) -> bool {
        let vector = double_area_vector(a, b, c);
        let faces = |normal: DVec3| vector.dot(normal) >= UPRIGHT * vector.length();
        let normal = self.0.at(patch, (a + b + c) / 3.0);
        normal.is_some_and(|(normal, _)| faces(normal))
            && [b, 0.5 * (b + c)]
                .into_iter()
                .all(|end| self.spans(patch, [a, end]))
    }
}
