//! Classes of radius and of the size of elements, by which the body's volume is summed.

/// What the estimate tells apart, as a part of the section's extent: the number of classes of radius, of cells across
/// the section of which each keeps one feature, of samples of the thickness along the extent, of the smallest pieces
/// along it. Smaller features are seen by what is around them. The width of a wedge changes by a hundredth of its
/// greatest from one class to the next, a tenth of what the estimate errs by. On 425 bodies and wishes, 64 puts the
/// hubs of vias elsewhere, and 128 some of them, at no other order of the benchmark; time goes with the square.
pub const RESOLUTION: usize = 96;
/// Classes of size per factor of two: the number of elements in a class is known to a quarter octave cubed, and
/// the errors of neighbouring classes cancel.
const PER_OCTAVE: usize = 4;
/// Factors of two between the smallest size and the section's extent: those that single precision tells, in which
/// sizes are compared.
const OCTAVES: i32 = f32::MANTISSA_DIGITS as i32 - 1;
/// Classes of size.
pub const SIZES: usize = PER_OCTAVE * OCTAVES as usize;
/// Bounds of the classes within a factor of two: two to the power of a quarter, a half, three quarters.
const WITHIN_OCTAVE: [f64; PER_OCTAVE - 1] = [
    1.189_207_115_002_721,
    std::f64::consts::SQRT_2,
    1.681_792_830_507_429,
];

/// Classes of radius and size.
#[derive(Clone, Copy, Debug)]
pub struct Classes {
    /// Largest coordinate of the section, model units.
    pub extent: f64,
    /// Smallest size there is, model units.
    pub least: f64,
}

impl Classes {
    /// Classes for sizes from `least` on, or from the smallest that they reach down to.
    pub fn new(extent: f64, least: f64) -> Self {
        let least = least.max(extent * f64::from(-OCTAVES).exp2());
        Self { extent, least }
    }

    /// The class of a radius.
    pub fn of_radius(&self, r: f64) -> usize {
        ((r / self.extent * RESOLUTION as f64) as usize).min(RESOLUTION - 1)
    }

    /// The class of a size.
    pub fn of_size(&self, size: f64) -> usize {
        let ratio = size / self.least;
        if ratio < 1.0 {
            return 0;
        }
        let bits = ratio.to_bits();
        let octave = (bits >> 52) as usize - 1023;
        let mantissa = f64::from_bits(bits & (u64::MAX >> 12) | 1.0_f64.to_bits());
        let within = WITHIN_OCTAVE.iter().filter(|&&b| mantissa >= b).count();
        (PER_OCTAVE * octave + within).min(SIZES - 1)
    }

    /// Middle of a class of radius.
    pub fn radius(&self, class: usize) -> f64 {
        (class as f64 + 0.5) * self.width()
    }

    /// Width of a class of radius.
    pub fn width(&self) -> f64 {
        self.extent / RESOLUTION as f64
    }

    /// Middle of a class of size.
    pub fn size(&self, class: usize) -> f64 {
        self.least * ((class as f64 + 0.5) / PER_OCTAVE as f64).exp2()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_in_the_class_whose_middle_is_nearest() {
        let classes = Classes::new(2.0, 0.01);
        for class in 0..SIZES - 1 {
            assert_eq!(classes.of_size(classes.size(class)), class);
        }
        assert_eq!(classes.of_size(0.0), 0);
        assert_eq!(classes.of_size(0.009), 0);
        assert_eq!(classes.of_size(1e300), SIZES - 1);
        assert_eq!(classes.of_size(f64::INFINITY), SIZES - 1);
    }
}
