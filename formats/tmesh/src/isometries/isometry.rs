//! Isometries of the axial point groups, stored as exact integers.

use glam::{DMat3, DVec3};
use std::fmt;

/// Largest denominator of a turn, and largest common denominator of all turns of a document.
pub const MAX_TURN_DENOMINATOR: u32 = 65_536;

/// Relative deviation up to which numbers that an isometry relates count as equal: coordinates of a
/// point and its image relative to the largest of the template, entries of a rotation matrix relative
/// to 1. Either side is computed with fewer than 64 roundings (cosine and sine, the products and sums
/// of a matrix, the distance from a plane), each of at most half an epsilon.
pub const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// An element of an axial point group in the canonical frame (axis = z, mirror reference = x):
/// `R(2 pi k / n) * M^mirrored * H^flipped`, where `M` maps y to -y and `H` maps z to -z.
///
/// Every element of C_n, C_nv, C_nh, D_n, D_nd and D_nh has this form. The fraction `k / n` is kept
/// reduced with `0 <= k < n`, so equality of values is equality of isometries. Products are formed
/// on the integers; a matrix is only ever computed from the final fraction, never by repeated
/// multiplication.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Isometry {
    n: u32,
    k: u32,
    mirrored: bool,
    flipped: bool,
}

impl Isometry {
    /// The identity.
    pub const IDENTITY: Self = Self {
        k: 0,
        n: 1,
        mirrored: false,
        flipped: false,
    };

    /// The reflection in the plane z = 0.
    pub const FLIP: Self = Self {
        flipped: true,
        ..Self::IDENTITY
    };

    /// The reflection in the plane y = 0.
    pub const MIRROR: Self = Self {
        mirrored: true,
        ..Self::IDENTITY
    };

    /// `R(2 pi k / n) * M^mirrored * H^flipped`; `k` may be any integer.
    ///
    /// # Panics
    /// If `n` is zero or exceeds [`MAX_TURN_DENOMINATOR`] after reduction.
    pub fn new(k: i64, n: u32, mirrored: bool, flipped: bool) -> Self {
        assert!(n > 0, "a turn needs a positive denominator");
        let k = k.rem_euclid(i64::from(n)) as u64;
        let g = gcd(k, u64::from(n));
        let (k, n) = ((k / g) as u32, (u64::from(n) / g) as u32);
        assert!(
            n <= MAX_TURN_DENOMINATOR,
            "turn denominator {n} exceeds {MAX_TURN_DENOMINATOR}"
        );
        Self {
            n,
            k,
            mirrored,
            flipped,
        }
    }

    /// Rotation by `k / n` of a full turn about the axis.
    pub fn rotation(k: i64, n: u32) -> Self {
        Self::new(k, n, false, false)
    }

    /// As [`Isometry::rotation`], and `None` if the denominator exceeds [`MAX_TURN_DENOMINATOR`].
    pub fn checked_rotation(k: i64, n: u64) -> Option<Self> {
        let k = k.rem_euclid(i64::try_from(n).ok()?) as u64;
        let common = gcd(k, n);
        let (k, n) = (k / common, n / common);
        (n <= u64::from(MAX_TURN_DENOMINATOR)).then(|| Self::rotation(k as i64, n as u32))
    }

    /// Reflection in the plane that contains the axis and makes the angle `pi k / n` with the x axis.
    pub fn reflection(k: i64, n: u32) -> Self {
        Self::new(k, n, true, false)
    }

    /// The half turn about the axis through the origin, across the main one, that makes the angle
    /// `pi k / n` with the x axis.
    pub fn half_turn(k: i64, n: u32) -> Self {
        Self::new(k, n, true, true)
    }

    /// Numerator of the turn, `0 <= k < n`.
    pub fn k(self) -> u32 {
        self.k
    }

    /// Denominator of the turn (the fraction is reduced).
    pub fn n(self) -> u32 {
        self.n
    }

    /// Whether the vertical mirror `y -> -y` is applied (before the turn).
    pub fn mirrored(self) -> bool {
        self.mirrored
    }

    /// Whether the horizontal mirror `z -> -z` is applied.
    pub fn flipped(self) -> bool {
        self.flipped
    }

    /// Whether the isometry reverses orientation (its determinant is -1).
    pub fn reverses_orientation(self) -> bool {
        self.mirrored != self.flipped
    }

    /// Whether the isometry is the reflection in a plane.
    pub fn is_reflection(self) -> bool {
        self == Self::FLIP || self.mirrored && !self.flipped
    }

    /// The product `self * other`: first `other`, then `self`.
    ///
    /// Isometries of one valid document have a common denominator in range, so their products stay
    /// within it however many factors they have.
    ///
    /// # Panics
    /// If the product's denominator exceeds [`MAX_TURN_DENOMINATOR`].
    pub fn compose(self, other: Self) -> Self {
        match self.checked_compose(other) {
            Some(product) => product,
            None => panic!("the turn of {self} times {other} exceeds {MAX_TURN_DENOMINATOR}"),
        }
    }

    /// As [`Isometry::compose`], and `None` where that panics.
    pub fn checked_compose(self, other: Self) -> Option<Self> {
        // M R(a) = R(-a) M, and H commutes with everything.
        let n = lcm(u64::from(self.n), u64::from(other.n));
        let a = u64::from(self.k) * (n / u64::from(self.n));
        let b = u64::from(other.k) * (n / u64::from(other.n));
        let k = if self.mirrored { a + n - b % n } else { a + b } % n;
        let g = gcd(k, n);
        let (k, n) = (k / g, n / g);
        (n <= u64::from(MAX_TURN_DENOMINATOR)).then_some(Self {
            n: n as u32,
            k: k as u32,
            mirrored: self.mirrored != other.mirrored,
            flipped: self.flipped != other.flipped,
        })
    }

    /// The inverse isometry.
    pub fn inverse(self) -> Self {
        // (R M)^-1 = M R^-1 = R M
        let k = if self.mirrored {
            i64::from(self.k)
        } else {
            -i64::from(self.k)
        };
        Self::new(k, self.n, self.mirrored, self.flipped)
    }

    /// Cosine and sine of the turn, computed from the reduced fraction: exact at multiples of a
    /// quarter turn and at 30 and 45 degrees, and bitwise related between angles that mirror each
    /// other in an octant. Uses a software implementation, so every machine gets the same bits.
    pub fn cos_sin(self) -> (f64, f64) {
        cos_sin(self.k, self.n)
    }

    /// Cosine and sine of half the turn: the direction in which the plane of a vertical reflection, or
    /// the axis of a half turn across the main one, leaves the z axis. As exact as
    /// [`Isometry::cos_sin`], but for the largest denominators.
    pub fn half_angle(self) -> (f64, f64) {
        match Self::checked_rotation(i64::from(self.k), 2 * u64::from(self.n)) {
            Some(half) => half.cos_sin(),
            None => {
                let angle = std::f64::consts::PI * f64::from(self.k) / f64::from(self.n);
                (libm::cos(angle), libm::sin(angle))
            }
        }
    }

    /// Image of a point given in the canonical frame.
    pub fn apply(self, p: DVec3) -> DVec3 {
        Placed::new(self).apply(p)
    }

    /// The isometry with its cosine and sine at hand, for use on many points.
    pub fn placed(self) -> Placed {
        Placed::new(self)
    }

    /// The 3 x 3 matrix of the isometry.
    pub fn matrix(self) -> DMat3 {
        DMat3::from_cols(
            self.apply(DVec3::X),
            self.apply(DVec3::Y),
            self.apply(DVec3::Z),
        )
    }
}

impl fmt::Display for Isometry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.k, self.n)?;
        if self.mirrored {
            f.write_str(" mirrored")?;
        }
        if self.flipped {
            f.write_str(" flipped")?;
        }
        Ok(())
    }
}

/// An [`Isometry`] with its cosine and sine evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    cos: f64,
    sin: f64,
    y: f64,
    z: f64,
}

impl Placed {
    fn new(isometry: Isometry) -> Self {
        let (cos, sin) = isometry.cos_sin();
        Self {
            cos,
            sin,
            y: if isometry.mirrored { -1.0 } else { 1.0 },
            z: if isometry.flipped { -1.0 } else { 1.0 },
        }
    }

    /// Image of a point given in the canonical frame.
    #[inline]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        let y = self.y * p.y;
        DVec3::new(
            self.cos * p.x - self.sin * y,
            self.sin * p.x + self.cos * y,
            self.z * p.z,
        )
    }
}

pub(crate) fn cos_sin(k: u32, n: u32) -> (f64, f64) {
    // Angle = quadrant * pi/2 + (rest / n) * pi/2 with 0 <= rest < n.
    let (k, n) = (u64::from(k), u64::from(n));
    let quadrant = 4 * k / n;
    let rest = 4 * k - quadrant * n;
    let (c, s) = if rest == 0 {
        (1.0, 0.0)
    } else if 2 * rest == n {
        (
            std::f64::consts::FRAC_1_SQRT_2,
            std::f64::consts::FRAC_1_SQRT_2,
        )
    } else if 2 * rest < n {
        first_octant(rest, n)
    } else {
        let (c, s) = first_octant(n - rest, n);
        (s, c)
    };
    match quadrant {
        0 => (c, s),
        1 => (-s, c),
        2 => (-c, -s),
        _ => (s, -c),
    }
}

/// Cosine and sine of `(rest / n) * pi / 2` for `0 < 2 rest < n`.
fn first_octant(rest: u64, n: u64) -> (f64, f64) {
    if 3 * rest == n {
        return (3.0_f64.sqrt() / 2.0, 0.5);
    }
    let angle = std::f64::consts::FRAC_PI_2 * (rest as f64 / n as f64);
    (libm::cos(angle), libm::sin(angle))
}

fn gcd(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

pub(crate) fn lcm(a: u64, b: u64) -> u64 {
    a / gcd(a, b) * b
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(n: u32) -> Vec<Isometry> {
        let mut all = Vec::new();
        for k in 0..n {
            for mirrored in [false, true] {
                for flipped in [false, true] {
                    all.push(Isometry::new(i64::from(k), n, mirrored, flipped));
                }
            }
        }
        all
    }

    #[test]
    fn products_agree_with_matrices_and_stay_in_the_group() {
        let all = group(12);
        for &a in &all {
            assert_eq!(a.compose(a.inverse()), Isometry::IDENTITY);
            for &b in &all {
                let c = a.compose(b);
                assert!(all.contains(&c));
                let difference = c.matrix() - a.matrix() * b.matrix();
                let worst = difference
                    .to_cols_array()
                    .iter()
                    .fold(0.0_f64, |m, x| m.max(x.abs()));
                assert!(worst < 1e-15, "{a} * {b}: {worst}");
            }
        }
    }

    #[test]
    fn products_of_different_denominators() {
        let a = Isometry::rotation(1, 6);
        let b = Isometry::rotation(1, 10);
        assert_eq!(a.compose(b), Isometry::rotation(4, 15));
        assert_eq!(a.compose(a).compose(a), Isometry::rotation(1, 2));
    }

    #[test]
    fn reflections_fix_their_plane() {
        for n in [1, 2, 3, 7, 16] {
            let m = Isometry::reflection(1, n);
            assert_eq!(m.compose(m), Isometry::IDENTITY);
            let (c, s) = cos_sin(1, 2 * n);
            let on = DVec3::new(2.0 * c, 2.0 * s, 0.3);
            assert!((m.apply(on) - on).length() < 1e-15);
        }
    }

    #[test]
    fn special_angles_are_exact() {
        assert_eq!(cos_sin(1, 4), (0.0, 1.0));
        assert_eq!(cos_sin(1, 2), (-1.0, 0.0));
        assert_eq!(cos_sin(3, 4), (0.0, -1.0));
        assert_eq!(cos_sin(1, 12).1, 0.5);
        assert_eq!(cos_sin(1, 6).0, 0.5);
        assert_eq!(cos_sin(1, 8).0, cos_sin(1, 8).1);
        for n in 1..200_u32 {
            for k in 0..n {
                let (c, s) = cos_sin(k, n);
                let (a, b) = cos_sin(n - k, n.max(1));
                if k > 0 {
                    assert_eq!((c, s), (a, -b), "{k}/{n}");
                }
                assert!((c * c + s * s - 1.0).abs() < 4e-16);
            }
        }
    }
}
