//! Point groups with one main axis, as permutations of a grid around that axis.

use crate::Dice;
use tmesh::Kind;

/// The kinds of groups, in the order in which the seeds of bodies choose them.
pub const KINDS: [Kind; 7] = [
    Kind::C,
    Kind::Cv,
    Kind::Ch,
    Kind::S,
    Kind::D,
    Kind::Dh,
    Kind::Dd,
];

/// Whether the groups of a kind have a rotation by half a pitch with a reflection across the axis.
pub fn halves_pitch(kind: Kind) -> bool {
    matches!(kind, Kind::S | Kind::Dd)
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

/// The elements of a group whose pitch is `pitch` sectors; even where the kind halves it. Mirror
/// planes and axes across the main one are put at random places of the grid.
pub fn motions(kind: Kind, order: usize, pitch: usize, dice: &mut Dice) -> Vec<Motion> {
    let sectors = order * pitch;
    let c = dice.below(pitch);
    let half = pitch / 2;
    let motion = |shift, mirror, flip| Motion {
        shift,
        mirror,
        flip,
    };
    let first = match kind {
        Kind::C => vec![motion(0, false, false)],
        Kind::Cv => vec![motion(0, false, false), motion(c, true, false)],
        Kind::Ch => vec![motion(0, false, false), motion(0, false, true)],
        Kind::S => vec![motion(0, false, false), motion(half, false, true)],
        Kind::D => vec![motion(0, false, false), motion(c, true, true)],
        Kind::Dh => vec![
            motion(0, false, false),
            motion(c, true, false),
            motion(0, false, true),
            motion(c, true, true),
        ],
        Kind::Dd => vec![
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
