//! Directions in which a vertex may move, and what it must keep.

use glam::DVec3;
use tmesh::FixedSet;

/// Directions in which a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Freedom {
    /// Corners, walls shared with other templates.
    Fixed,
    /// Along a straight edge where facets meet.
    Line(DVec3),
    /// Inside of a facet: two unit vectors along it.
    Plane(DVec3, DVec3),
    /// Along a patch of a curved shape: two unit vectors along it where the vertex was at first.
    Along(u32, [DVec3; 2]),
    /// Not on the surface.
    Free,
}

impl Freedom {
    /// Orthogonal unit vectors, as many as there are.
    pub fn directions(&self) -> impl Iterator<Item = DVec3> + use<> {
        let (list, count) = match *self {
            Self::Fixed => ([DVec3::ZERO; 3], 0),
            Self::Line(a) => ([a, DVec3::ZERO, DVec3::ZERO], 1),
            Self::Plane(a, b) | Self::Along(_, [a, b]) => ([a, b, DVec3::ZERO], 2),
            Self::Free => ([DVec3::X, DVec3::Y, DVec3::Z], 3),
        };
        list.into_iter().take(count)
    }
}

/// What a vertex of a wall or of the axis must keep to the last bit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exact {
    /// The plane through the axis that it is on.
    pub vertical: Option<FixedSet>,
    /// Whether it is on the plane across the axis.
    pub level: bool,
    /// Whether it is on the axis.
    pub axis: bool,
}

impl Exact {
    /// The nearest place to `p` that has it.
    pub fn place(&self, p: DVec3) -> DVec3 {
        let p = if self.axis {
            DVec3::new(0.0, 0.0, p.z)
        } else {
            self.vertical.map_or(p, |plane| plane.nearest(p))
        };
        if self.level {
            DVec3::new(p.x, p.y, 0.0)
        } else {
            p
        }
    }
}
