//! Point groups with one main axis, as permutations of a grid around that axis.

use crate::Dice;

/// A family of point groups, in Schoenflies' symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    C,
    Cv,
    Ch,
    S,
    D,
    Dh,
    Dd,
}

impl Family {
    pub const ALL: [Self; 7] = [
        Self::C,
        Self::Cv,
        Self::Ch,
        Self::S,
        Self::D,
        Self::Dh,
        Self::Dd,
    ];

    /// The symbol of the group of this family and the order `n`.
    pub fn symbol(self, n: usize) -> String {
        match self {
            Self::C => format!("C{n}"),
            Self::Cv => format!("C{n}v"),
            Self::Ch => format!("C{n}h"),
            Self::S => format!("S{}", 2 * n),
            Self::D => format!("D{n}"),
            Self::Dh => format!("D{n}h"),
            Self::Dd => format!("D{n}d"),
        }
    }

    /// Highest order of rotation about any axis in the group of the order `n`.
    pub fn highest_order(self, n: usize) -> usize {
        match self {
            Self::D | Self::Dh | Self::Dd => n.max(2),
            Self::C | Self::Cv | Self::Ch | Self::S => n,
        }
    }

    /// Whether elements of the group turn the axis over.
    pub fn turns_over(self) -> bool {
        !matches!(self, Self::C | Self::Cv)
    }

    /// Whether the group has a rotation by half a pitch with a reflection across the axis.
    pub fn halves_pitch(self) -> bool {
        matches!(self, Self::S | Self::Dd)
    }
}

/// An element of a group: sector `k` goes to `shift + k`, or with `mirror` to `shift - k`, level `j`
/// to itself, or with `flip` to its opposite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motion {
    pub shift: usize,
    pub mirror: bool,
    pub flip: bool,
}

impl Motion {
    /// Whether it turns right into left hands.
    pub fn reverses(self) -> bool {
        self.mirror != self.flip
    }

    /// Image of the line of nodes `k`, of `sectors`.
    pub fn node_sector(self, k: usize, sectors: usize) -> usize {
        match self.mirror {
            false => (self.shift + k) % sectors,
            true => (self.shift + sectors - k) % sectors,
        }
    }

    /// Image of the cells between the lines of nodes `k` and `k + 1`.
    pub fn cell_sector(self, k: usize, sectors: usize) -> usize {
        match self.mirror {
            false => (self.shift + k) % sectors,
            true => (self.shift + 2 * sectors - k - 1) % sectors,
        }
    }

    /// Image of level `j` of `count`.
    pub fn level(self, j: usize, count: usize) -> usize {
        if self.flip { count - 1 - j } else { j }
    }
}

/// The elements of a group whose pitch is `pitch` sectors; even where the family halves it. Mirror
/// planes and axes across the main one are put at random places of the grid.
pub fn motions(family: Family, order: usize, pitch: usize, dice: &mut Dice) -> Vec<Motion> {
    let sectors = order * pitch;
    let c = dice.below(pitch);
    let half = pitch / 2;
    let motion = |shift, mirror, flip| Motion {
        shift,
        mirror,
        flip,
    };
    let first = match family {
        Family::C => vec![motion(0, false, false)],
        Family::Cv => vec![motion(0, false, false), motion(c, true, false)],
        Family::Ch => vec![motion(0, false, false), motion(0, false, true)],
        Family::S => vec![motion(0, false, false), motion(half, false, true)],
        Family::D => vec![motion(0, false, false), motion(c, true, true)],
        Family::Dh => vec![
            motion(0, false, false),
            motion(c, true, false),
            motion(0, false, true),
            motion(c, true, true),
        ],
        Family::Dd => vec![
            motion(0, false, false),
            motion(c, true, false),
            motion(half, false, true),
            motion(c + half, true, true),
        ],
    };
    let mut all = Vec::with_capacity(first.len() * order);
    for turn in 0..order {
        all.extend(first.iter().map(|m| Motion {
            shift: (m.shift + turn * pitch) % sectors,
            ..*m
        }));
    }
    all
}
