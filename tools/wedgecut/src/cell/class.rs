//! Where a point lies with respect to the faces of a cell.

/// For each face of a cell -1 beyond it, 0 on it, 1 on the cell's side of it; and whether the point is on the axis.
/// Points on the axis are on every face that begins there. A cell has at most four faces: two through the axis, the
/// hub's, and one across the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    signs: [i8; 4],
    axis: bool,
}

impl Class {
    /// Within all faces.
    pub const INSIDE: Self = Self {
        signs: [1; 4],
        axis: false,
    };

    /// The sign for one face.
    pub fn of(self, face: usize) -> i8 {
        self.signs[face]
    }

    /// The same with another sign for one face.
    pub fn with(mut self, face: usize, sign: i8) -> Self {
        self.signs[face] = sign;
        self
    }

    /// The same on the axis.
    pub fn on_axis(self) -> Self {
        Self { axis: true, ..self }
    }

    /// Whether the point is on the axis.
    pub fn is_axis(self) -> bool {
        self.axis
    }

    /// What binds the point: a bit for each face that it is on, and one for the axis.
    pub fn bound(self) -> u8 {
        let faces = self.signs.iter().enumerate();
        let on = faces.filter(|(_, sign)| **sign == 0);
        on.fold(u8::from(self.axis) << self.signs.len(), |bits, (i, _)| {
            bits | 1 << i
        })
    }

    /// Whether a point on a face is bound by anything else.
    pub fn is_fixed(self) -> bool {
        self.axis || self.bound().count_ones() > 1
    }

    /// The class of a point between two others on a segment that no face separates.
    pub fn between(self, other: Self) -> Self {
        let mut class = self;
        for (sign, other) in class.signs.iter_mut().zip(other.signs) {
            if *sign == 0 {
                *sign = other;
            }
        }
        class.axis = self.axis && other.axis;
        class
    }
}

/// The sign of a number that is not zero.
pub fn sign(x: f64) -> i8 {
    if x > 0.0 { 1 } else { -1 }
}
