//! Whether a filled template is as asked for, or worth another attempt.

use improve::Improved;
use mesher::{Answer, Params};

/// How much the radius-edge bound is eased for the mesher where elements are improved afterwards, which
/// brings what it left past the bound back below it. On prisms and vias (orders 4 to 128, bound 1.4) it
/// saves 2 to 15 % of the elements.
const EASED: f64 = 1.05;

/// The same for the smallest dihedral angle: on prisms and vias it saves a quarter of the elements with 15 degrees asked
/// for, a tenth with 10, next to nothing with 5, and all of them reach what was asked for.
const EASED_ANGLE: f64 = 2.0 / 3.0;

/// What the bounds are multiplied by for the mesher: the radius-edge ratio, and the smallest dihedral angle.
pub const EASING: [f64; 2] = [EASED, EASED_ANGLE];

/// Fewer elements that are not as asked for are not put down to the easing, whatever part of all they are.
const SOME: usize = 3;

/// The part of the elements past the radius-edge bound up to which a mesh is good: half of what it may be (2 %, the budget of
/// the whole pipe). With more of them it was eased for too many ...
const TOO_MANY: f64 = 0.01;

/// ... unless it is the shape: the mesher's own elements past its bounds, each of which spoils about so many.
const SPOILED: f64 = 2.0;

/// Elements that are not as asked for, as a part of all, up to which they are chance and not the shape: another mesh
/// may be without them. With more than this part that have a smaller angle than was asked for, it was eased for too many.
const FEW: f64 = 1e-3;

/// Larger meshes are not made again for single elements with a small angle: it takes seconds ...
const SMALL: usize = 50_000;

/// ... nor those above this size for single elements past the radius-edge bound, which do less harm.
const VERY_SMALL: usize = 10_000;

/// So many elements that fail are not the shape's fault in any case, where the surface may be at fault: those around one
/// unlucky edge of it.
const SINGLE: usize = 8;

/// Whether elements are improved after the mesher.
pub fn improves(params: &Params) -> bool {
    params.quality && params.optimize.is_some()
}

/// How far the elements of a filled template are from what was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    improved: Improved,
    /// Tetrahedra in all.
    count: usize,
    /// Whether more of them are not as asked for than the mesher's own elements explain.
    many: bool,
}

impl Verdict {
    /// Judges what improvement has left of the mesher's answer.
    pub fn new(improved: Option<Improved>, count: usize, answer: &Answer) -> Self {
        let improved = improved.unwrap_or_default();
        Self {
            improved,
            count,
            many: is_many(&improved, count, || answer.outside()),
        }
    }

    fn failing(&self) -> usize {
        self.improved.past + self.improved.low
    }

    fn share(&self) -> f64 {
        self.failing() as f64 / self.count.max(1) as f64
    }

    /// Why another mesh with the bounds not eased may be better; `None` if it would not.
    pub fn short_of(&self, params: &Params) -> Option<String> {
        (self.many || self.is_unlucky()).then(|| {
            format!(
                "of {} tetrahedra {} are past the radius-edge bound, {} have an angle below {} (the smallest {:.1} degrees)",
                self.count, self.improved.past, self.improved.low, params.min_dihedral, self.improved.least
            )
        })
    }

    /// Why another mesh with another surface may be better; `None` if it would not.
    pub fn may_blame_surface(&self) -> Option<String> {
        let few = SINGLE.max((FEW * self.count as f64) as usize);
        let blamed = self.count <= SMALL && (1..=few).contains(&self.failing());
        blamed.then(|| {
            format!(
                "{} tetrahedra are past the radius-edge bound, {} have a smaller angle than asked for (the smallest {:.1} \
                 degrees)",
                self.improved.past, self.improved.low, self.improved.least
            )
        })
    }

    /// Whether fewer elements fail, or as many with a larger smallest angle.
    pub fn is_better_than(&self, other: &Self) -> bool {
        let (this, that) = (self.failing(), other.failing());
        this < that || (this == that && self.improved.least > other.improved.least)
    }

    /// Whether this mesh is to be preferred to one for which the bounds were eased. One that is no better only has
    /// more elements.
    pub fn is_worth_it(&self, eased: &Self) -> bool {
        match eased.many {
            true => self.share() < eased.share(),
            false => self.is_better_than(eased),
        }
    }

    /// Whether so few elements are not as asked for that they are chance, in a mesh that is soon made again.
    fn is_unlucky(&self) -> bool {
        let few = 1..=1.max((FEW * self.count as f64) as usize);
        (self.count <= SMALL && few.contains(&self.improved.low))
            || (self.count <= VERY_SMALL && few.contains(&self.failing()))
    }
}

/// Whether more elements were left past the radius-edge bound, or with a smaller angle than was asked for, than
/// `outside` explains: the parts of the mesher's elements that are past its own bounds. They are looked at only where
/// they decide.
fn is_many(left: &Improved, count: usize, outside: impl FnOnce() -> [f64; 2]) -> bool {
    let kinds = [(left.past, TOO_MANY), (left.low, FEW)];
    let excess = kinds.map(|(some, most)| match some >= SOME {
        true => some as f64 / count.max(1) as f64 - most,
        false => 0.0,
    });
    let at_most = |of: [f64; 2]| excess.iter().zip(of).all(|(e, of)| *e <= SPOILED * of);
    !at_most([0.0; 2]) && !at_most(outside())
}
