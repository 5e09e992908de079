//! What a step is worth.

pub use crate::shape::{DETAIL, LONG};

/// Shortest edge relative to the length wanted (Botsch and Kobbelt): two edges that meet at a vertex in between, of which
/// one is shorter, are together nearer to it.
pub const SHORT: f64 = 4.0 / 5.0;
/// Quality of a triangle that is good enough to be given up for another one: between 30 and 150 degrees, those with
/// equal sides are.
pub const GOOD: f64 = 0.5;
/// What a step has to gain; among needles that are less than this, as much as there was: the way out of seven of them in one line beside a seam is by
/// others that are as good as none, but better. They stayed, and the mesher refined them to 16 times as many triangles.
pub const GAIN: f64 = 1e-3;
/// Facets narrower than this, relative to the length wanted, are finer than asked for: two of them side by side are no wider than an
/// edge may be.
pub const FINE: f64 = 0.5;
/// How near to a fold that stays an edge is split, relative to the length wanted: splitting needles goes on until they are as wide as
/// long where they are up to 64 times as long. Nearer to it than that, a needle stays one whatever is done, and its vertices only ask the
/// mesher for elements as small as the needle is narrow there.
pub const BESIDE: f64 = 1.0 / 64.0;
/// Triangles that curved patches may take at most, next to those that they take as they are drawn, where the drawing is given up for it though it is
/// exact. A choice: who draws exactly gets what was drawn, unless that costs twice what the shape does. Of 27 exact drawings from CAD kernels that
/// were meshed both ways, the elements are to each other 0.4 to 2.2 times as these triangles are, for one with sharp corners 0.2 times. Slivers that a cut
/// leaves of an exact drawing cost less (0.37 of it in a helical gear of 16 teeth), finely drawn roundings and holes more (0.03 to 0.3).
pub const WORTH: f64 = 0.5;
/// How high a step may be that is taken out, relative to how far the surface may move: what is left of that is for all that is done to it afterwards. With half of it, what is
/// curved beside it takes no more than half as many edges again around.
pub const LEVEL: f64 = 0.5;
