//! Equivalent descriptions of one surface.

/// Order in which the mesher is given points and triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// That of the template.
    AsGiven,
    /// Back to front.
    Reversed,
    /// Second half first.
    FromTheMiddle,
    /// In no order, but always the same; a number for each.
    Shuffled(u64),
}

impl Order {
    /// Puts a list in this order.
    pub fn apply<T: Copy>(self, list: &mut [T]) {
        match self {
            Self::AsGiven => {}
            Self::Reversed => list.reverse(),
            Self::FromTheMiddle => list.rotate_left(list.len() / 2),
            Self::Shuffled(seed) => {
                let mut order: Vec<usize> = (0..list.len()).collect();
                order.sort_unstable_by_key(|&i| mixed(i as u64 + (seed << 32)));
                let shuffled: Vec<T> = order.into_iter().map(|i| list[i]).collect();
                list.copy_from_slice(&shuffled);
            }
        }
    }
}

/// A number that looks random, the same on every machine (splitmix64, S. Vigna, public domain).
pub fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// One of the equivalent descriptions of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
    /// Order of points and triangles.
    pub order: Order,
    /// Whether walls are made exactly coplanar; see [`super::flat`].
    pub flat: bool,
    /// How far points are moved at random, those of walls in the walls, in the mesher's unit (the diagonal is from 1 to 2).
    /// Symmetric bodies have many cospherical points, and these make TetGen lose its way.
    pub stir: Option<f64>,
    /// Points from which on TetGen inserts them in random rounds, instead of the 64 it takes; below that the
    /// order depends on where the points are alone, and is the same for all descriptions. With 0 it takes them in the
    /// order given.
    pub rounds_from: Option<u32>,
    /// Whether triangles off the walls are facets of their own unless they are exactly coplanar: nothing is
    /// uneven then, but their edges all stay.
    pub apart: bool,
}

impl Description {
    /// The surface as it is, but for walls that are made exactly coplanar.
    pub const PLAIN: Self = Self {
        order: Order::AsGiven,
        flat: true,
        stir: None,
        rounds_from: None,
        apart: false,
    };
}
