//! The part of a face that a cap closes, or that is the image of another part.

use super::class::Class;
use super::face::{Face, Role, Shape};
use glam::{DVec2, DVec3};
use tmesh::Isometry;

/// The part of a face where one of its coordinates has one sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Half {
    /// The coordinate.
    pub coordinate: usize,
    /// Whether it is positive.
    pub positive: bool,
}

/// A face or half of one, with coordinates that it shares with the part that it is the image of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// The face.
    pub face: usize,
    /// Which half of it.
    pub half: Option<Half>,
    /// The face whose coordinates are used, and what takes this part there.
    chart: usize,
    back: Isometry,
    /// Whether the part closes the hub, which is beyond the hub's face.
    pub of_hub: bool,
}

impl Part {
    /// All of a face.
    pub fn whole(face: usize) -> Self {
        Self {
            face,
            half: None,
            chart: face,
            back: Isometry::IDENTITY,
            of_hub: false,
        }
    }

    /// Half of a face.
    pub fn half(face: usize, coordinate: usize, positive: bool) -> Self {
        let half = Half {
            coordinate,
            positive,
        };
        Self {
            half: Some(half),
            ..Self::whole(face)
        }
    }

    /// The same with the coordinates of the part that it is the image of by `step`.
    pub fn image_of(self, there: &Self, step: Isometry) -> Self {
        Self {
            chart: there.chart,
            back: step.inverse(),
            ..self
        }
    }

    /// The same as the end of the hub instead of the wedge.
    pub fn of_hub(self) -> Self {
        Self {
            of_hub: true,
            ..self
        }
    }

    /// Whether a point lies on the part.
    pub fn contains(&self, faces: &[Face], p: DVec3, class: Class) -> bool {
        class.of(self.face) == 0
            && self.half.is_none_or(|half| {
                let x = faces[self.face].coordinates(p)[half.coordinate];
                if half.positive { x >= 0.0 } else { x <= 0.0 }
            })
    }

    /// Coordinates of a point of the part.
    pub fn place(&self, faces: &[Face], p: DVec3) -> DVec2 {
        faces[self.chart].coordinates(self.back.apply(p))
    }

    /// The point of the part that coordinates are of, if they are those of its own face.
    pub fn at(&self, faces: &[Face], q: DVec2) -> DVec3 {
        faces[self.chart].at(q)
    }

    /// Directions in space of the coordinates.
    fn directions(&self, faces: &[Face]) -> [DVec3; 2] {
        let forth = self.back.inverse();
        faces[self.chart].directions().map(|d| forth.apply(d))
    }

    /// Normal of the face into what the part closes.
    fn inward(&self, faces: &[Face], face: usize) -> DVec3 {
        let inward = faces[face].inward;
        match self.of_hub && faces[face].role == Role::Hub {
            true => -inward,
            false => inward,
        }
    }

    /// Whether turning from the first coordinate to the second is counter-clockwise seen from outside.
    pub fn faces_out(&self, faces: &[Face]) -> bool {
        let [u, v] = self.directions(faces);
        u.cross(v).dot(self.inward(faces, self.face)) < 0.0
    }

    /// The line where the part ends at another face, if it does.
    pub fn border(&self, faces: &[Face], other: usize) -> Option<Border> {
        let (face, end) = (&faces[self.face], &faces[other]);
        if other == self.face {
            return None;
        }
        let folded = self.half.filter(|h| h.coordinate == 1);
        let mut inward = self.inward(faces, other);
        if end.role == Role::Fold {
            inward = if folded?.positive { inward } else { -inward };
        }
        // The line runs along the axis but for faces across it.
        let line = match (face.shape, end.shape) {
            (Shape::Across, _) => Line::Along(other),
            (_, Shape::Across) => Line::Along(self.face),
            _ => Line::Up,
        };
        let on = match face.is_radial() && end.is_radial() {
            true => On::Axis,
            false => On::Face(other),
        };
        Some(self.line(faces, line, inward, on))
    }

    /// The axis, where it divides the face.
    pub fn axis_border(&self, faces: &[Face]) -> Option<Border> {
        let half = self.half.filter(|h| h.coordinate == 0)?;
        let [outward, _] = faces[self.face].directions();
        let inward = if half.positive { outward } else { -outward };
        Some(self.line(faces, Line::Up, inward, On::Axis))
    }

    fn line(&self, faces: &[Face], line: Line, inward: DVec3, on: On) -> Border {
        let direction = match line {
            Line::Up => DVec3::Z,
            Line::Along(face) => faces[face].directions()[0],
        };
        let [u, v] = self.directions(faces);
        let flat = |d: DVec3| DVec2::new(d.dot(u), d.dot(v));
        let left = flat(direction).perp_dot(flat(inward)) > 0.0;
        Border { on, line, left }
    }
}

/// Which points lie on a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum On {
    Axis,
    Face(usize),
}

/// How a border runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Line {
    /// Along the axis.
    Up,
    /// Along the first coordinate of a face.
    Along(usize),
}

/// A line where a part ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Border {
    on: On,
    line: Line,
    /// Whether the part is to the left of the line, walked upwards or away from the axis, seen as its coordinates
    /// are drawn.
    pub left: bool,
}

impl Border {
    /// Whether a point of the part lies on the line.
    pub fn contains(&self, class: Class) -> bool {
        match self.on {
            On::Axis => class.is_axis(),
            On::Face(face) => class.of(face) == 0,
        }
    }

    /// Where on the line a point is.
    pub fn along(&self, faces: &[Face], p: DVec3) -> f64 {
        match self.line {
            Line::Up => p.z,
            Line::Along(face) => faces[face].coordinates(p).x,
        }
    }
}
