//! The axial point groups.

use tmesh::Isometry;

/// Kinds of axial point groups, by Schoenflies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Rotations.
    C,
    /// With mirrors that contain the axis.
    Cv,
    /// With the mirror across the axis.
    Ch,
    /// With the rotary reflection by half a step.
    S,
    /// With half turns about axes across the main one.
    D,
    /// With mirrors that contain the axis and the rotary reflection by half a step.
    Dd,
    /// With mirrors that contain the axis and the one across it.
    Dh,
}

/// A group in its canonical frame: rotations by steps of a turn over `order` about z, the mirror y -> -y, and what
/// turns the axis over; for D the half turn about x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// The kind.
    pub kind: Kind,
    /// Order of the rotation, at least 1.
    pub order: u32,
}

impl Group {
    /// Schoenflies symbol with the order written out. A single mirror plane is `C1v`.
    pub fn symbol(&self) -> String {
        let n = self.order;
        match self.kind {
            Kind::C => format!("C{n}"),
            Kind::Cv => format!("C{n}v"),
            Kind::Ch => format!("C{n}h"),
            Kind::Dh if n == 1 => "C2v".to_owned(),
            Kind::Dh => format!("D{n}h"),
            Kind::S => format!("S{}", 2 * n),
            Kind::Dd => format!("D{n}d"),
            Kind::D => format!("D{n}"),
        }
    }

    /// Whether mirrors contain the axis.
    pub fn has_vertical_mirrors(&self) -> bool {
        matches!(self.kind, Kind::Cv | Kind::Dd | Kind::Dh)
    }

    /// Whether a mirror lies across the axis.
    pub fn has_horizontal_mirror(&self) -> bool {
        matches!(self.kind, Kind::Ch | Kind::Dh)
    }

    /// The operation that turns the axis over.
    pub fn turns_axis_over(&self) -> Option<Isometry> {
        match self.kind {
            Kind::C | Kind::Cv => None,
            Kind::Ch | Kind::Dh => Some(Isometry::FLIP),
            Kind::S | Kind::Dd => Some(Isometry::new(1, 2 * self.order, false, true)),
            Kind::D => Some(Isometry::new(0, 1, true, true)),
        }
    }
}
