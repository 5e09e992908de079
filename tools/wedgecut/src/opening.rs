//! The planes that bound the wedge, and where points lie with respect to them.
//!
//! Side A is the half plane y = 0, x >= 0; side B is A turned by the wedge's angle. The hub's plane, where
//! there is one, crosses the wedge in front of the axis. Each point is classified once, moved onto the
//! planes it counts as lying on, and its class is kept; nothing asks again with another tolerance.

use glam::DVec3;
use tmesh::Isometry;

/// Which of the cut planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The plane y = 0.
    A,
    /// The plane at the wedge's angle.
    B,
    /// The plane between the wedge and the hub.
    Hub,
    /// The plane z = 0, where it is a mirror plane.
    Level,
}

/// Where a point lies: for each cut plane -1 beyond it, 0 on it, 1 on the wedge's side. On both
/// planes exactly when on the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// With respect to side A.
    pub a: i8,
    /// With respect to side B.
    pub b: i8,
    /// With respect to the hub's plane: -1 in the hub; 1 where there is none.
    pub hub: i8,
    /// With respect to the plane z = 0; 1 where it is no side of the wedge.
    pub level: i8,
}

impl Class {
    /// On the axis.
    pub const AXIS: Self = Self::new(0, 0);
    /// Between the planes.
    pub const INSIDE: Self = Self::new(1, 1);

    /// A class with respect to sides A and B alone.
    pub const fn new(a: i8, b: i8) -> Self {
        Self {
            a,
            b,
            hub: 1,
            level: 1,
        }
    }

    /// Whether the point is on the axis.
    pub fn is_axis(self) -> bool {
        self.a == 0 && self.b == 0
    }

    /// The class for one side.
    pub fn of(self, side: Side) -> i8 {
        match side {
            Side::A => self.a,
            Side::B => self.b,
            Side::Hub => self.hub,
            Side::Level => self.level,
        }
    }
}

/// The plane `normal . x = distance` between wedge and hub, parallel to the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HubPlane {
    /// Unit normal away from the axis.
    normal: DVec3,
    /// Distance from the axis, model units.
    distance: f64,
}

impl HubPlane {
    /// The plane at the given distance (model units) from the axis across a wedge of angle `turn`:
    /// orthogonal to side A of a mirror wedge, where it is half a side of the hub's polygon, and to
    /// the middle of a rotation wedge.
    pub fn new(distance: f64, turn: Isometry, mirror: bool) -> Self {
        let normal = if mirror {
            DVec3::X
        } else {
            let (cos, sin) = Isometry::rotation(i64::from(turn.k()), 2 * turn.n()).cos_sin();
            DVec3::new(cos, sin, 0.0)
        };
        Self { normal, distance }
    }

    /// Direction within the plane that is orthogonal to the axis.
    fn along(&self) -> DVec3 {
        DVec3::new(-self.normal.y, self.normal.x, 0.0)
    }

    fn offset(&self, p: DVec3) -> f64 {
        self.normal.x * p.x + self.normal.y * p.y - self.distance
    }
}

/// The wedge's opening: its angle in (0, pi].
#[derive(Clone, Copy, Debug)]
pub struct Opening {
    turn: Isometry,
    cos: f64,
    sin: f64,
    /// Distance up to which a point counts as on a plane, model units.
    tolerance: f64,
    /// The same of the axis.
    axis: f64,
    hub: Option<HubPlane>,
    level: bool,
}

impl Opening {
    /// The opening of a wedge of angle `turn`, at most half a turn.
    pub fn new(turn: Isometry, tolerance: f64) -> Self {
        let (cos, sin) = turn.cos_sin();
        Self {
            turn,
            cos,
            sin,
            tolerance,
            axis: tolerance,
            hub: None,
            level: false,
        }
    }

    /// The same, where points up to a larger distance count as on the axis.
    pub fn with_axis(self, axis: f64) -> Self {
        Self {
            axis: axis.max(self.tolerance),
            ..self
        }
    }

    /// The same, ending at the plane z = 0 as well if `level`.
    pub fn with_level(self, level: bool) -> Self {
        Self { level, ..self }
    }

    /// The same with a hub; the wedge's angle has to be below half a turn.
    pub fn with_hub(self, hub: Option<HubPlane>) -> Self {
        Self { hub, ..self }
    }

    /// Whether both sides lie in one plane.
    pub fn is_half(&self) -> bool {
        self.turn == Isometry::rotation(1, 2)
    }

    /// The planes to clip with, through the axis one for a half space, else two.
    pub fn sides(&self) -> &'static [Side] {
        match (self.level, self.is_half()) {
            (false, true) => &[Side::A],
            (false, false) => &[Side::A, Side::B],
            (true, true) => &[Side::Level, Side::A],
            (true, false) => &[Side::Level, Side::A, Side::B],
        }
    }

    /// Normal of a side's plane into the wedge, away from the hub.
    pub fn inward(&self, side: Side) -> DVec3 {
        match side {
            Side::A => DVec3::Y,
            Side::B => DVec3::new(self.sin, -self.cos, 0.0),
            Side::Hub => self.hub.map_or(DVec3::X, |h| h.normal),
            Side::Level => DVec3::Z,
        }
    }

    /// Signed distance of a point of the given class from a side's plane, model units; exactly zero
    /// for points on it.
    pub fn distance(&self, side: Side, p: DVec3, class: Class) -> f64 {
        match (class.of(side), side) {
            (0, _) => 0.0,
            (_, Side::A) => p.y,
            (_, Side::B) => p.x * self.sin - p.y * self.cos,
            (_, Side::Hub) => self.hub.map_or(f64::INFINITY, |h| h.offset(p)),
            (_, Side::Level) => p.z,
        }
    }

    /// Distance of a point on a side from the axis, measured along the side (negative beyond the
    /// axis); in the hub's plane the distance from the plane's line nearest to the axis; across the
    /// axis just the distance.
    pub fn radius_on(&self, side: Side, p: DVec3) -> f64 {
        match side {
            Side::A => p.x,
            Side::B => p.x * self.cos + p.y * self.sin,
            Side::Hub => self.hub.map_or(0.0, |h| h.along().dot(p)),
            Side::Level => p.x.hypot(p.y),
        }
    }

    /// Points where three of the planes meet: at z = 0 on the axis, and on both sides of the hub.
    pub fn corners(&self) -> Vec<(DVec3, Class)> {
        if !self.level {
            return Vec::new();
        }
        let level = |class: Class| Class { level: 0, ..class };
        let hub = if self.hub.is_some() { -1 } else { 1 };
        let mut found = vec![(DVec3::ZERO, level(Class { hub, ..Class::AXIS }))];
        if let Some(hub) = &self.hub {
            for class in [Class::new(0, 1), Class::new(1, 0)] {
                let on = hub.normal * hub.distance;
                found.push(self.put_on_hub(hub, on, level(class)));
            }
        }
        found
    }

    /// Classifies a point, of known class for the sides, against the hub's plane, and moves it onto
    /// the plane where it counts as lying on it.
    pub fn classify_hub(&self, p: DVec3, class: Class) -> (DVec3, Class) {
        let Some(hub) = &self.hub else {
            return (p, class);
        };
        let offset = hub.offset(p);
        if offset.abs() <= self.tolerance {
            self.put_on_hub(hub, p, class)
        } else {
            let hub = sign(offset);
            (p, Class { hub, ..class })
        }
    }

    fn put_on_hub(&self, hub: &HubPlane, p: DVec3, class: Class) -> (DVec3, Class) {
        let class = Class { hub: 0, ..class };
        if hub.normal == DVec3::X {
            // Exactly in the plane; on side B up to rounding, as all points there.
            let y = if class.b == 0 {
                hub.distance * (self.sin / self.cos)
            } else {
                p.y
            };
            return (DVec3::new(hub.distance, y, p.z), class);
        }
        let side = match class {
            Class { a: 0, .. } => Some(Side::A),
            Class { b: 0, .. } => Some(Side::B),
            _ => None,
        };
        // Half the angle of the wedge is between its sides and the normal.
        let p = match side {
            Some(side) => self.point_on(side, hub.distance / hub.normal.x, p.z),
            None => p - hub.normal * hub.offset(p),
        };
        (p, class)
    }

    /// Classifies a point and moves it onto the planes it counts as lying on.
    pub fn classify(&self, p: DVec3) -> (DVec3, Class) {
        let (p, class) = self.classify_sides(p);
        if !self.level {
            return (p, class);
        }
        if p.z.abs() <= self.tolerance {
            (DVec3::new(p.x, p.y, 0.0), Class { level: 0, ..class })
        } else {
            let level = sign(p.z);
            (p, Class { level, ..class })
        }
    }

    fn classify_sides(&self, p: DVec3) -> (DVec3, Class) {
        if p.x.hypot(p.y) <= self.axis {
            return (DVec3::new(0.0, 0.0, p.z), Class::AXIS);
        }
        let (a, b) = (p.y, p.x * self.sin - p.y * self.cos);
        if self.is_half() {
            if a.abs() <= self.tolerance {
                return (DVec3::new(p.x, 0.0, p.z), Class::new(0, 1));
            }
            return (p, Class::new(sign(a), 1));
        }
        if a.abs().min(b.abs()) > self.tolerance {
            return (p, Class::new(sign(a), sign(b)));
        }
        if a.abs() <= b.abs() {
            self.put(Side::A, p)
        } else {
            self.put(Side::B, p)
        }
    }

    /// The crossing of the segment `p q` with a side's plane, where the ends have opposite classes.
    ///
    /// The result does not depend on the order of the ends, and points that share x and y with
    /// others give crossings that do so, to the bit: vertical faces stay vertical.
    pub fn crossing(&self, side: Side, p: (DVec3, Class), q: (DVec3, Class)) -> (DVec3, Class) {
        let ordered = |u: DVec3, v: DVec3| {
            (u.x, u.y, u.z).partial_cmp(&(v.x, v.y, v.z)) != Some(std::cmp::Ordering::Greater)
        };
        let (p, q) = if ordered(p.0, q.0) { (p, q) } else { (q, p) };
        let (dp, dq) = (self.distance(side, p.0, p.1), self.distance(side, q.0, q.1));
        let t = dp / (dp - dq);
        let x = p.0 + (q.0 - p.0) * t;
        // On the planes where both ends are.
        let on = |side: Side| i8::from(!(p.1.of(side) == 0 && q.1.of(side) == 0));
        let (x, class) = match (side, &self.hub) {
            (Side::Level, _) => {
                let (x, class) = self.classify_sides(x);
                return (DVec3::new(x.x, x.y, 0.0), Class { level: 0, ..class });
            }
            (Side::Hub, Some(hub)) => self.put_on_hub(hub, x, Class::new(on(Side::A), on(Side::B))),
            _ => {
                let other = if side == Side::A { Side::B } else { Side::A };
                if !self.is_half() && on(other) == 0 {
                    (DVec3::new(0.0, 0.0, x.z), Class::AXIS)
                } else {
                    self.put(side, x)
                }
            }
        };
        let level = on(Side::Level);
        (x, Class { level, ..class })
    }

    /// The point where a segment within side A's plane passes the axis; its ends lie on opposite
    /// sides of it.
    pub fn axis_crossing(&self, p: (DVec3, Class), q: (DVec3, Class)) -> (DVec3, Class) {
        let level = i8::from(!(p.1.level == 0 && q.1.level == 0));
        let class = Class {
            level,
            ..Class::AXIS
        };
        let (p, q) = if p.0.x < q.0.x {
            (p.0, q.0)
        } else {
            (q.0, p.0)
        };
        let t = p.x / (p.x - q.x);
        (DVec3::new(0.0, 0.0, p.z + (q.z - p.z) * t), class)
    }

    /// The point at a distance from the axis (along the side) and a height.
    pub fn point_on(&self, side: Side, r: f64, z: f64) -> DVec3 {
        match side {
            Side::A => DVec3::new(r, 0.0, z),
            Side::B => DVec3::new(r * self.cos, r * self.sin, z),
            Side::Hub => self.hub.map_or(DVec3::ZERO, |h| {
                h.normal * h.distance + h.along() * r + DVec3::Z * z
            }),
            Side::Level => DVec3::new(r, 0.0, 0.0),
        }
    }

    fn put(&self, side: Side, p: DVec3) -> (DVec3, Class) {
        let r = self.radius_on(side, p);
        if r.abs() <= self.tolerance {
            return (DVec3::new(0.0, 0.0, p.z), Class::AXIS);
        }
        let class = match side {
            Side::A if self.is_half() => Class::new(0, 1),
            Side::A => Class::new(0, sign(r)),
            Side::B => Class::new(sign(r), 0),
            Side::Hub => Class {
                hub: 0,
                ..Class::INSIDE
            },
            Side::Level => Class {
                level: 0,
                ..Class::INSIDE
            },
        };
        (self.point_on(side, r, p.z), class)
    }
}

fn sign(x: f64) -> i8 {
    if x > 0.0 { 1 } else { -1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_near_a_plane_are_moved_onto_it() {
        let opening = Opening::new(Isometry::rotation(1, 12), 1e-6);
        let (p, class) = opening.classify(DVec3::new(0.5, 3e-7, 1.0));
        assert_eq!((p, class), (DVec3::new(0.5, 0.0, 1.0), Class::new(0, 1)));
        let (c, s) = Isometry::rotation(1, 12).cos_sin();
        let (p, class) = opening.classify(DVec3::new(2.0 * c + 4e-7, 2.0 * s, 1.0));
        assert_eq!(class, Class::new(1, 0));
        assert_eq!(
            p,
            Isometry::rotation(1, 12).apply(DVec3::new(opening.radius_on(Side::B, p), 0.0, 1.0))
        );
        assert_eq!(
            opening.classify(DVec3::new(5e-7, -5e-7, 2.0)).1,
            Class::AXIS
        );
        // On A's plane, but beyond the axis: outside of B.
        assert_eq!(
            opening.classify(DVec3::new(-0.5, 0.0, 0.0)).1,
            Class::new(0, -1)
        );
    }

    #[test]
    fn crossings_do_not_depend_on_direction_or_height() {
        let opening = Opening::new(Isometry::rotation(1, 14), 1e-9);
        let at = |x: f64, y: f64, z: f64| opening.classify(DVec3::new(x, y, z));
        let (p, q) = (at(0.7, 0.1, 0.0), at(0.31, 0.9, 0.0));
        let low = opening.crossing(Side::B, p, q);
        assert_eq!(low, opening.crossing(Side::B, q, p));
        let (p, q) = (at(0.7, 0.1, 0.3), at(0.31, 0.9, 1.7));
        let slanted = opening.crossing(Side::B, p, q);
        assert_eq!((low.0.x, low.0.y), (slanted.0.x, slanted.0.y));
        assert_eq!(low.1, Class::new(1, 0));
    }
}
