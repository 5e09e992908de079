//! Neighbourhoods of a body.

use glam::DVec3;
use tmesh::Frame;

/// Where on a body a point is, roughly: points alike in this are of one neighbourhood.
pub struct Place {
    /// Angle about the axis, as a share of a full turn from 0 to 1.
    pub turn: f64,
    /// Distance from the axis, relative to the largest.
    pub radius: f64,
    /// Which way the surface faces: outwards, along the turn, along the axis, and their opposites.
    pub side: u8,
}

impl Place {
    /// Of a point of the surface with the given normal.
    pub fn new(frame: &Frame, point: DVec3, normal: DVec3, radius: f64) -> Self {
        let p = frame.to_canonical(point);
        let outward = DVec3::new(p.x, p.y, 0.0).normalize_or_zero();
        let n = frame.rotation.transpose() * normal;
        let faces = [n.dot(outward), n.dot(DVec3::Z.cross(outward)), n.z];
        let most = (1..3).fold(0, |best, i| match faces[i].abs() > faces[best].abs() {
            true => i,
            false => best,
        });
        let turn = libm::atan2(p.y, p.x) / std::f64::consts::TAU;
        Self {
            turn: turn - libm::floor(turn),
            radius: libm::hypot(p.x, p.y) / radius,
            side: 2 * most as u8 + u8::from(faces[most] > 0.0),
        }
    }

    /// Shell around the axis, out of so many.
    pub fn shell(&self, shells: f64) -> u8 {
        (self.radius * shells) as u8
    }

    /// Whether the surface faces the axis or away from it.
    pub fn faces_radially(&self) -> bool {
        self.side < 2
    }
}
