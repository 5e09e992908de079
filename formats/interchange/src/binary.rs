//! Numbers of binary files.

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// Two's complement of so many bytes: 1, 2, 4 or 8.
    Signed(usize),
    /// Of so many bytes: 1, 2, 4 or 8.
    Unsigned(usize),
    /// IEEE single precision.
    Float,
    /// IEEE double precision.
    Double,
}

/// Order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Lowest byte first.
    Little,
    /// Highest byte first.
    Big,
}

impl Scalar {
    /// Bytes that a number takes.
    pub fn size(self) -> usize {
        match self {
            Self::Signed(n) | Self::Unsigned(n) => n,
            Self::Float => 4,
            Self::Double => 8,
        }
    }

    /// The value of as many bytes as [`Scalar::size`] says; integers above 2^53 are rounded.
    #[inline]
    pub fn value(self, bytes: &[u8], order: Order) -> f64 {
        let mut wide = [0; 8];
        let raw = match order {
            Order::Little => {
                wide[..bytes.len()].copy_from_slice(bytes);
                u64::from_le_bytes(wide)
            }
            Order::Big => {
                wide[8 - bytes.len()..].copy_from_slice(bytes);
                u64::from_be_bytes(wide)
            }
        };
        match self {
            Self::Unsigned(_) => raw as f64,
            Self::Signed(n) => {
                let shift = 64 - 8 * n as u32;
                ((raw << shift) as i64 >> shift) as f64
            }
            Self::Float => f64::from(f32::from_bits(raw as u32)),
            Self::Double => f64::from_bits(raw),
        }
    }
}

/// A point or region id that came as a number; -1 becomes the largest one.
pub fn id(x: f64) -> u32 {
    if x < 0.0 { x as i64 as u32 } else { x as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_the_standard_library() {
        for order in [Order::Little, Order::Big] {
            let ordered = |mut bytes: Vec<u8>| {
                if order == Order::Big {
                    bytes.reverse();
                }
                bytes
            };
            let value = |scalar: Scalar, bytes: &[u8]| {
                assert_eq!(bytes.len(), scalar.size());
                scalar.value(&ordered(bytes.to_vec()), order)
            };
            assert_eq!(value(Scalar::Signed(1), &(-7_i8).to_le_bytes()), -7.0);
            assert_eq!(value(Scalar::Signed(2), &(-700_i16).to_le_bytes()), -700.0);
            assert_eq!(
                value(Scalar::Signed(4), &i32::MIN.to_le_bytes()),
                -2_147_483_648.0
            );
            assert_eq!(value(Scalar::Signed(8), &(-3_i64).to_le_bytes()), -3.0);
            assert_eq!(value(Scalar::Unsigned(1), &[200]), 200.0);
            assert_eq!(value(Scalar::Unsigned(8), &9_u64.to_le_bytes()), 9.0);
            assert_eq!(
                value(Scalar::Float, &0.1_f32.to_le_bytes()),
                f64::from(0.1_f32)
            );
            assert_eq!(value(Scalar::Double, &0.1_f64.to_le_bytes()), 0.1);
        }
        assert_eq!((id(-1.0), id(3.0)), (u32::MAX, 3));
    }
}
