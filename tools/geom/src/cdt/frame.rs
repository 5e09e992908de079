//! An orthonormal frame in a facet's plane.

use glam::{DVec2, DVec3};

/// An orthonormal frame in a facet's plane; upright and level facets keep exact coordinates.
pub struct Frame {
    u: DVec3,
    v: DVec3,
    /// Unit normal.
    pub normal: DVec3,
}

impl Frame {
    /// The frame of a plane with this unit normal.
    pub fn new(normal: DVec3) -> Self {
        // Where a normal is nearer to the axis than to the horizontal plane, its horizontal direction loses digits.
        let across = if normal.z.abs() > normal.truncate().length() {
            DVec3::X - normal * normal.x
        } else {
            DVec3::Z.cross(normal)
        };
        let u = across.normalize_or_zero();
        Self {
            u,
            v: normal.cross(u),
            normal,
        }
    }

    /// Coordinates in the plane.
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.u.dot(p), self.v.dot(p))
    }

    /// The point with these coordinates at a height along the normal.
    pub fn lift(&self, p: DVec2, height: f64) -> DVec3 {
        self.u * p.x + self.v * p.y + self.normal * height
    }
}
