//! One cutting face.

use glam::{DVec2, DVec3};
use tmesh::Isometry;

/// Where a face lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// The half plane that begins at the axis in the direction of these cosine and sine; in a cell that is half of
    /// space the whole plane.
    Radial { cos: f64, sin: f64 },
    /// The plane z = 0.
    Across,
    /// The plane `normal . x = distance`, parallel to the axis; model units.
    Chord { normal: DVec3, distance: f64 },
}

/// What a face does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It ends the cell: what is beyond goes.
    Wall,
    /// It divides the cell into the wedge and the hub in front of it.
    Hub,
    /// It divides other faces into parts that are images of each other; the body goes on beyond it.
    Fold,
}

/// A cutting face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Such as `wall-a`.
    pub name: &'static str,
    /// Where it lies.
    pub shape: Shape,
    /// Unit normal into the cell; the hub's away from the axis.
    pub inward: DVec3,
    /// What it does.
    pub role: Role,
    /// The coordinate, see [`Face::coordinates`], at whose zero the face is divided into two parts.
    pub divided: Option<usize>,
}

impl Face {
    /// The half plane at an angle, the cell's interior in the direction of increasing angles or decreasing ones.
    pub fn radial(name: &'static str, turn: Isometry, increasing: bool) -> Self {
        let (cos, sin) = turn.cos_sin();
        let inward = match increasing {
            true => DVec3::new(-sin, cos, 0.0),
            false => DVec3::new(sin, -cos, 0.0),
        };
        Self {
            name,
            shape: Shape::Radial { cos, sin },
            inward,
            role: Role::Wall,
            divided: None,
        }
    }

    /// The plane z = 0, the cell above it.
    pub fn across(name: &'static str, role: Role) -> Self {
        Self {
            name,
            shape: Shape::Across,
            inward: DVec3::Z,
            role,
            divided: None,
        }
    }

    /// The plane between wedge and hub at a distance (model units) from the axis, its normal turned by `turn` from
    /// the x axis.
    pub fn chord(name: &'static str, turn: Isometry, distance: f64) -> Self {
        let normal = turn.apply(DVec3::X);
        Self {
            name,
            shape: Shape::Chord { normal, distance },
            inward: normal,
            role: Role::Hub,
            divided: None,
        }
    }

    /// The face, divided where a coordinate is zero.
    pub fn divided_at(self, coordinate: usize) -> Self {
        Self {
            divided: Some(coordinate),
            ..self
        }
    }

    /// Whether it begins at the axis.
    pub fn is_radial(&self) -> bool {
        matches!(self.shape, Shape::Radial { .. })
    }

    /// Whether it lies across the axis.
    pub fn is_across(&self) -> bool {
        self.shape == Shape::Across
    }

    /// Signed distance of a point, positive within the cell, model units.
    pub fn distance(&self, p: DVec3) -> f64 {
        let n = self.inward;
        match self.shape {
            Shape::Radial { .. } => n.x * p.x + n.y * p.y,
            Shape::Across => p.z,
            Shape::Chord { distance, .. } => n.x * p.x + n.y * p.y - distance,
        }
    }

    /// Directions within the face of its two coordinates: away from the axis, or along a chord, and along the axis;
    /// across the axis x and y.
    pub fn directions(&self) -> [DVec3; 2] {
        match self.shape {
            Shape::Radial { cos, sin } => [DVec3::new(cos, sin, 0.0), DVec3::Z],
            Shape::Across => [DVec3::X, DVec3::Y],
            Shape::Chord { normal, .. } => [DVec3::new(-normal.y, normal.x, 0.0), DVec3::Z],
        }
    }

    /// Coordinates of a point of the face along [`Face::directions`].
    pub fn coordinates(&self, p: DVec3) -> DVec2 {
        match self.shape {
            Shape::Across => DVec2::new(p.x, p.y),
            _ => {
                let [along, _] = self.directions();
                DVec2::new(p.x * along.x + p.y * along.y, p.z)
            }
        }
    }

    /// The point of the face with these coordinates.
    pub fn at(&self, q: DVec2) -> DVec3 {
        match self.shape {
            Shape::Radial { cos, sin } => DVec3::new(q.x * cos, q.x * sin, q.y),
            Shape::Across => DVec3::new(q.x, q.y, 0.0),
            Shape::Chord { normal, distance } => {
                let [along, up] = self.directions();
                normal * distance + along * q.x + up * q.y
            }
        }
    }
}
