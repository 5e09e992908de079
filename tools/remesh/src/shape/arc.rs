//! Arcs that facets and chords stand for.

use crate::input::Rules;

/// Longest edge relative to the length wanted (Botsch and Kobbelt): a longer one has halves that are nearer to it.
pub const LONG: f64 = 4.0 / 3.0;
/// Edges shorter than this, relative to the length wanted, go even where a patch is not remeshed: what a cut leaves of
/// a facet.
pub const DETAIL: f64 = 0.25;

/// An arc that is drawn by chords.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    /// The angle by which chords turn, radians.
    pub angle: f64,
    /// Curvature, one over length.
    pub curvature: f64,
}

impl Arc {
    /// Length of a chord as it is drawn.
    pub fn width(&self) -> f64 {
        self.angle / self.curvature
    }

    /// Length of chords that turn as far as is wanted, or see no detail where no lengths are asked for, and are as far from the arc as may be; at least as
    /// they are drawn, and twice what may be noise, as shorter ones may all be one point, unless shorter ones are asked for, `longest` at most. `deviation`: how
    /// far from the arc they may be, model units.
    pub fn size(&self, rules: &Rules<'_>, longest: f64, deviation: f64) -> f64 {
        let sizes = &rules.sizes;
        let turned = sizes.turn / self.curvature;
        // What is nearer together than the surface may move is detail beside edges that long, and may be joined. Where lengths are asked for, the
        // surface may move as far as these allow, which says nothing of what is detail.
        let seen = match longest.is_finite() {
            true => turned,
            false => turned.max(deviation / DETAIL),
        };
        // Chords are as far from the arc as they may be. Measured with all stages on 136 parts and assemblies, by default: with chords half as
        // far from it there are 1.13 times as many elements, and angles are the same.
        let near = (8.0 * deviation / self.curvature).sqrt();
        let drawn = self.width().max(2.0 * rules.noise);
        let asked = match sizes.turn_is_asked {
            true => turned.min(longest),
            false => longest,
        };
        seen.min(near).max(drawn).min(asked)
    }

    /// How far chords that turn as far as is wanted and those as drawn may be apart: the heights of the arc above both. Where
    /// lengths are asked for, it is that of the longest that pass for those that count, as the diameter of a triangle of
    /// such edges: without it collapsing stops at two thirds of the length, and with more triangles fold where edges are
    /// shorter than the envelope is thick. Otherwise edges have the thickness of the envelope at least, and
    /// where they have to be shorter than the turn allows, it is more than they need: with no more, steps between the
    /// input's edges and the final ones are not done. At most the deviation.
    pub fn height(&self, rules: &Rules<'_>, longest: f64, deviation: f64) -> f64 {
        let (size, old) = (self.size(rules, longest, deviation), self.width());
        let new = match rules.sizes.turn_is_asked || longest.is_finite() {
            true => size * LONG * 2.0 / 3.0_f64.sqrt(),
            false => size.max(rules.sizes.turn / self.curvature),
        };
        (0.125 * (new * new + old * old) * self.curvature).min(deviation)
    }
}
