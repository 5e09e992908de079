//! How good a tetrahedron is, against what is asked for.

use glam::DVec3;

/// The square root of `f64::EPSILON`, half of the digits. Coordinates are near one, so a quality has an error of some
/// `EPSILON` by the length of an edge: new tetrahedra have at least this quality, and are not flat but for rounding. As a
/// difference it leaves half of the digits to a gradient.
pub const HALF_DIGITS: f64 = 1.0 / (1_u64 << (f64::MANTISSA_DIGITS / 2)) as f64;

/// The smallest quality has to grow by this part for anything to be done: what is worth the work, for moves, replacements and
/// new vertices alike. Measured on 67 wedges with `tetwedge`: 0.03 makes no difference, with 0.05 there are 1 % more elements
/// and the smallest angles are 0.3 degrees less in the mean.
pub const GAIN: f64 = 1e-2;

/// The part of the step's angle that counts in full past the bound; larger ones count ever less, and never more than the step.
/// Measured on 67 parts: next to angles that count in full up to the step and no more beyond, there are as many elements, as many
/// of them past the bound, 0.6 times as many below 15 degrees, and the smallest angles are 3 % larger. With one half there are 1 %
/// more elements; with four fifths the smallest angles are 2 % larger. Where triangles of the input are needles that stay, one
/// element in a hundred has a smaller angle than 12 degrees instead of 11.
const FULL: f64 = 0.7;

/// What every tetrahedron should reach.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Tangent of the smallest dihedral angle.
    tangent: f64,
    /// Largest ratio of circumradius to shortest edge.
    radius_edge: f64,
    /// Quality of an element just past that. Those that are worse are worth a vertex.
    step: f64,
    /// What is there instead of them has to be better than this.
    after: f64,
}

/// Quality and size of a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grade {
    /// 1 and more: good enough. Below, what the smallest dihedral angle, by its tangent, and the radius-edge ratio are
    /// worth as parts of what is asked for. Not above 0 for flat and inverted ones.
    pub quality: f64,
    /// Six times the signed volume.
    pub six_volume: f64,
}

impl Goal {
    /// A smallest dihedral angle in degrees, a largest radius-edge ratio, and the smallest dihedral angle that an element may
    /// have rather than be past that bound.
    pub fn new(angle: f64, radius_edge: f64, least: f64) -> Self {
        let tangent = libm::tan(angle.to_radians());
        Self {
            tangent,
            radius_edge,
            step: (libm::tan(least.to_radians()) / tangent).max(HALF_DIGITS),
            after: 0.0,
        }
    }

    /// The same goal, but that an element just past the bound is worth more: halfway (in the logarithm) from the smallest angle
    /// that the bound leaves to a face to the angle that every element should have. No circle around a face is larger
    /// than the sphere, so that an angle's sine is no less than half of the inverse ratio. Elements with smaller dihedral
    /// angles are slivers, which the bound lets pass; they are worth a vertex only if it leaves none.
    ///
    /// Measured on the benchmark's bodies, with that angle of a face itself, the smallest angles of vias with a bound of 2 are 3 degrees
    /// smaller; with vertices that leave slivers, there are 2 % more elements on drawings of machine parts.
    pub fn lenient(self) -> Self {
        let sine = 0.5 / self.radius_edge;
        let face = sine / (1.0 - sine * sine).sqrt() / self.tangent;
        // 1 too where no face can have such an angle.
        let step = self.step.max(face.min(1.0).sqrt());
        Self {
            step,
            after: step,
            ..self
        }
    }

    /// The same goal for another angle: an element just past the bound is worth the same angle as before, and so is a vertex.
    pub fn towards(self, angle: f64) -> Self {
        let tangent = libm::tan(angle.to_radians());
        let part = self.tangent / tangent;
        Self {
            tangent,
            step: self.step * part,
            after: self.after * part,
            ..self
        }
    }

    /// Quality of an element within the radius-edge bound with this smallest dihedral angle, degrees.
    pub fn of_angle(&self, angle: f64) -> f64 {
        libm::tan(angle.to_radians()) / self.tangent
    }

    /// Whether an element with this quality is past the radius-edge bound, or no better than one that is.
    pub fn is_worth_a_vertex(&self, quality: f64) -> bool {
        quality < self.step
    }

    /// The quality from which on an element is worth no vertex.
    pub fn worth_none(&self) -> f64 {
        self.step
    }

    /// Whether a vertex is worth it if this is the smallest quality then.
    pub fn is_worth_it(&self, quality: f64) -> bool {
        quality >= self.after
    }

    /// Grades a tetrahedron by its corners; see [`geom::tet::TetMeasures::of`] for the formulas.
    pub fn grade(&self, [a, b, c, d]: [DVec3; 4]) -> Grade {
        let (u, v, w) = (b - a, c - a, d - a);
        let (uv, vw, wu) = (u.cross(v), v.cross(w), w.cross(u));
        let six_volume = uv.dot(w);
        if six_volume.is_nan() || six_volume <= 0.0 {
            return Grade {
                quality: -1.0,
                six_volume,
            };
        }
        let opposite_a = uv + vw + wu;
        let squares = [u, v, w, v - u, w - u, w - v].map(DVec3::length_squared);
        let products = [
            -wu.dot(uv),
            -vw.dot(uv),
            -vw.dot(wu),
            opposite_a.dot(uv),
            opposite_a.dot(wu),
            opposite_a.dot(vw),
        ];
        let mut steepest = 0.0_f64;
        let mut shortest = f64::INFINITY;
        for (square, product) in squares.into_iter().zip(products) {
            steepest = steepest.max(product / square.sqrt());
            shortest = shortest.min(square);
        }
        let centre = squares[0] * vw + squares[1] * wu + squares[2] * uv;
        let angle = six_volume / (steepest * self.tangent);
        let ratio =
            self.radius_edge * 2.0 * six_volume * (shortest / centre.length_squared()).sqrt();
        let quality = self.quality(angle, ratio);
        Grade {
            // Two corners may be in one place, and rounding leave a volume: it is flat then, and has no ratio.
            quality: if quality.is_nan() { -1.0 } else { quality },
            six_volume,
        }
    }

    /// The quality by the tangent of the smallest dihedral angle and the inverse of the radius-edge ratio, both as parts of what is
    /// asked for. Past the bound both count, so that neither is given up for the other where the shape does not allow
    /// for the bound; the ratio by its root, since there it is the angle that can be mended. On 30 drawings of machine
    /// parts, the ratio itself leaves 8 % more elements below the smallest angle asked for, the smaller of both values alone 80 %
    /// more, with as many past the bound. It is a gain to get back
    /// within the bound at the angle of the step, and once more what a change has to gain: with one gain alone, a hub of
    /// order 20 keeps an element past the bound.
    fn quality(&self, angle: f64, ratio: f64) -> f64 {
        match ratio >= 1.0 {
            true => angle.min(ratio),
            false => (1.0 - 2.0 * GAIN) * self.step * saturated(angle / self.step) * ratio.sqrt(),
        }
    }
}

/// A value up to [`FULL`], and from there on towards one, without a kink.
fn saturated(value: f64) -> f64 {
    match value <= FULL {
        true => value,
        false => 1.0 - (1.0 - FULL) * libm::exp((FULL - value) / (1.0 - FULL)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::tet::TetMeasures;

    #[test]
    fn the_bound_is_a_step() {
        let goal = Goal::new(25.0, 1.4, 10.0);
        let ratio_quality = |part: f64| goal.quality(f64::INFINITY, part);
        assert_eq!(ratio_quality(1.0), 1.0);
        assert_eq!(ratio_quality(1.3), 1.3);
        // An element just past the bound is worth less than one with two thirds of the angle.
        assert!(ratio_quality(1.0 - 1e-9) < 0.66);
        assert!(ratio_quality(0.8) < ratio_quality(0.9) && ratio_quality(0.8) > 0.0);
        // And as much as one with the angle that was asked for.
        let ten = libm::tan(10_f64.to_radians()) / libm::tan(25_f64.to_radians());
        let past = ratio_quality(1.0 - 1e-9);
        assert!((past - (1.0 - 2.0 * GAIN) * ten).abs() < 1e-8, "{past}");
        assert!(Goal::new(25.0, 1.4, 0.0).quality(1.0, 0.9) > 0.0);
    }

    #[test]
    fn past_the_bound_angles_are_not_given_up() {
        let goal = Goal::new(25.0, 1.4, 10.0);
        assert!(goal.quality(0.1, 0.9) < goal.quality(0.2, 0.9));
        assert!(goal.quality(0.1, 0.5) < goal.quality(0.1, 0.9));
        // A bound is as good as the other: what is past it or has a smaller angle than asked for is worth a vertex.
        let ten = libm::tan(10_f64.to_radians()) / libm::tan(25_f64.to_radians());
        for (angle, ratio) in [(2.0, 0.999), (0.999 * ten, 2.0), (0.999 * ten, 0.999)] {
            assert!(goal.is_worth_a_vertex(goal.quality(angle, ratio)));
        }
        assert!(!goal.is_worth_a_vertex(goal.quality(1.001 * ten, 1.001)));
    }

    #[test]
    fn lenient_goals_put_slivers_before_the_bound() {
        let goal = Goal::new(25.0, 1.4, 10.0).lenient();
        let face = libm::asin(0.5 / 1.4);
        let step = (libm::tan(face) / libm::tan(25_f64.to_radians())).sqrt();
        assert!((goal.quality(100.0, 1.0 - 1e-12) - (1.0 - 2.0 * GAIN) * step).abs() < 1e-9);
        assert!(goal.quality(2.0, 1.0 - 1e-12) < goal.quality(2.5, 1.0 - 1e-12));
        // Of a sliver, what is there instead must be none.
        assert!(goal.is_worth_a_vertex(0.5) && !goal.is_worth_it(0.6) && goal.is_worth_it(step));
        assert!(Goal::new(25.0, 1.4, 10.0).is_worth_it(0.1));
        // The bounds that were asked for are kept where they are more.
        let more = Goal::new(25.0, 1.4, 23.0);
        assert_eq!(more.lenient().step, more.step);
        // No face has such angles, and elements past the bound are still bad.
        for radius_edge in [0.4, 0.5, 0.6] {
            let goal = Goal::new(25.0, radius_edge, 10.0).lenient();
            assert!(goal.quality(2.0, 0.9) < 1.0, "{goal:?}");
        }
    }

    #[test]
    fn larger_angles_change_nothing_about_what_is_worth_a_vertex() {
        let goal = Goal::new(25.0, 1.4, 10.0).lenient();
        let further = goal.towards(30.0);
        assert!((further.of_angle(30.0) - 1.0).abs() < 1e-12);
        // The step is at 22.9 degrees; made for 30 degrees, it would be at 25.2.
        for (angle, worth) in [(5.0, true), (22.5, true), (23.5, false), (25.0, false)] {
            for goal in [goal, further] {
                let quality = goal.of_angle(angle);
                assert_eq!(goal.is_worth_a_vertex(quality), worth, "{angle}");
                assert_eq!(goal.is_worth_it(quality), !worth, "{angle}");
            }
        }
        // An element past the bound is worth the same angle.
        let angle = |goal: Goal| goal.quality(100.0, 0.9) / goal.of_angle(45.0);
        assert!((angle(goal) - angle(further)).abs() < 1e-9);
    }

    #[test]
    fn grades_agree_with_the_measures() {
        let goal = Goal::new(20.0, 1.4, 10.0);
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut signs = [0; 2];
        for _ in 0..1000 {
            let corners = [(); 4].map(|()| DVec3::new(random(), random(), random()));
            let m = TetMeasures::of(corners);
            let grade = goal.grade(corners);
            assert!((grade.six_volume - 6.0 * m.volume).abs() < 1e-14);
            signs[usize::from(m.volume > 0.0)] += 1;
            if m.volume > 0.0 {
                let angle = m.min_dihedral().tan() / 20_f64.to_radians().tan();
                let expected = goal.quality(angle, 1.4 / m.radius_edge_ratio);
                assert!(
                    (grade.quality / expected - 1.0).abs() < 1e-9,
                    "{grade:?} {expected}"
                );
            } else {
                assert!(grade.quality < 0.0);
            }
        }
        assert!(signs[0] > 100 && signs[1] > 100);
        assert!(goal.grade([DVec3::ONE; 4]).quality < 0.0);
    }

    #[test]
    fn corners_in_one_place_are_flat_whatever_rounding_leaves() {
        let goal = Goal::new(25.0, 1.4, 10.0);
        // Of a body that touches itself: a volume of 1.1e-22, and no length of the edge between the second corner and the fourth.
        let there = DVec3::new(
            0.062420532715942806,
            -0.05644064164399939,
            -0.034814499407566965,
        );
        let corners = [
            DVec3::new(
                0.07781231223484242,
                -0.060136014098438766,
                -0.034814499407566965,
            ),
            there,
            DVec3::new(
                0.05996807932762826,
                -0.050273389400962584,
                -0.018409177088635334,
            ),
            there,
        ];
        let grade = goal.grade(corners);
        assert!(grade.six_volume > 0.0 && grade.quality < 0.0, "{grade:?}");
    }
}
