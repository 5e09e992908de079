//! Arcs that facets and chords stand for.

use crate::input::Rules;

/// Longest edge relative to the length wanted (Botsch and Kobbelt): a longer one has halves that are nearer to it.
pub const LONG: f64 = 4.0 / 3.0;

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

    /// Length of chords that turn as far as is wanted and are as far from the arc as may be; at least as they are drawn, and
    /// twice what may be noise, as shorter ones may all be one point, unless shorter ones are asked for, `longest` at most.
    pub fn size(&self, rules: &Rules<'_>, longest: f64) -> f64 {
        let sizes = &rules.sizes;
        let turned = sizes.turn / self.curvature;
        // A quarter of the deviation: the chords that are there are as far from the arc on their part, and steps that would
        // leave the envelope are not done, which leaves bad triangles. Measured with `tetwedge` on a fan and a twisted bar
        // from a CAD kernel: with half of it the first percentile of the angles is 13.5 and 14.5 degrees, with a quarter 16.0 and
        // 19.6, for a tenth more elements at most; parts with mirror walls get up to 1.8 times as many.
        let near = (2.0 * rules.deviation / self.curvature).sqrt();
        let drawn = self.width().max(2.0 * rules.noise);
        let asked = match sizes.turn_is_asked {
            true => turned.min(longest),
            false => longest,
        };
        turned.min(near).max(drawn).min(asked)
    }

    /// How far such chords and those as drawn may be apart: the heights of the arc above both. Where lengths are asked for, it
    /// is the longest that pass for them that count, as the diameter of a triangle of such edges: without it collapsing
    /// stops at two thirds of the length.
    pub fn height(&self, rules: &Rules<'_>, longest: f64) -> f64 {
        let (size, old) = (self.size(rules, longest), self.width());
        let new = match rules.sizes.turn_is_asked || longest.is_finite() {
            true => size * LONG * 2.0 / 3.0_f64.sqrt(),
            false => size,
        };
        0.125 * (new * new + old * old) * self.curvature
    }
}
