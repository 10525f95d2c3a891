//! A small unsigned soft float, for the few quantities of a contact that need range as well as precision.
//!
//! | operation | relative error, at most |
//! |---|---|
//! | [`Scaled::from_u64`] | 2^-32 (0 below 2^32) |
//! | [`Scaled::times`] | 2^-32 |
//! | [`Scaled::over`], [`Scaled::inverse`] | 2^-31 |
//! | [`Scaled::sqrt`] | 2^-31 |
//!
//! The exponent saturates; beyond its range only the magnitude is wrong. The core's values stay within 2^-130
//! ..= 2^130, far from there.

use super::product::wide;
use super::shift::{left, right};
use super::{Fixed24, Inverse, Q15, root};

/// `mantissa * 2^exponent`, with bit 31 of the mantissa set, or zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scaled {
    mantissa: u32,
    exponent: i16,
}

const TOP: u32 = 1 << 31;

impl Scaled {
    /// Zero.
    pub const ZERO: Scaled = Scaled { mantissa: 0, exponent: 0 };
    /// The largest value, and the result of a division by zero.
    pub const MAX: Scaled = Scaled { mantissa: u32::MAX, exponent: i16::MAX };

    /// Mantissa: 32 bits with the highest set, or 0.
    pub(super) const fn mantissa(self) -> u32 {
        self.mantissa
    }

    /// Exponent: power of two of the mantissa's lowest bit.
    pub(super) const fn exponent(self) -> i16 {
        self.exponent
    }

    /// Converts an integer, rounded to the nearest.
    #[inline]
    pub const fn from_u64(value: u64) -> Scaled {
        if value == 0 {
            return Scaled::ZERO;
        }
        if value >> 32 == 0 {
            let up = (value as u32).leading_zeros();
            return Scaled { mantissa: (value as u32) << up, exponent: -(up as i16) };
        }
        let up = value.leading_zeros();
        let full = left(value, up);
        Scaled::carried((full >> 32) as u32, (full >> 31) as u32 & 1, 32 - up as i16)
    }

    /// Inverse of a divisor; [`Scaled::MAX`] if it is zero.
    pub const fn inverse(divisor: &Inverse) -> Scaled {
        let exponent = divisor.shift as i16 - 63;
        match divisor.normal {
            0 => Scaled::MAX,
            TOP => Scaled { mantissa: TOP, exponent: exponent + 1 },
            _ => Scaled { mantissa: divisor.unshifted().quotient(1 << 63), exponent },
        }
    }

    /// Product.
    #[inline]
    pub const fn times(self, other: Scaled) -> Scaled {
        if self.mantissa == 0 || other.mantissa == 0 {
            return Scaled::ZERO;
        }
        // Bit 63 or 62 is set.
        let product = wide(self.mantissa, other.mantissa);
        let exponent = self.exponent.saturating_add(other.exponent);
        let (product, exponent) = if product >> 63 == 0 {
            (product << 1, exponent.saturating_add(31))
        } else {
            (product, exponent.saturating_add(32))
        };
        Scaled::carried((product >> 32) as u32, (product >> 31) as u32 & 1, exponent)
    }

    /// Quotient; [`Scaled::MAX`] if `other` is zero.
    pub const fn over(self, other: Scaled) -> Scaled {
        if other.mantissa == 0 {
            return Scaled::MAX;
        }
        if self.mantissa == 0 {
            return Scaled::ZERO;
        }
        // A larger dividend mantissa is shifted one bit less, so that the quotient always has 32 bits.
        let up = if self.mantissa < other.mantissa { 32 } else { 31 };
        let mantissa = Inverse::of_normal(other.mantissa).quotient((self.mantissa as u64) << up);
        Scaled { mantissa, exponent: self.exponent.saturating_sub(other.exponent).saturating_sub(up) }
    }

    /// Square root.
    pub const fn sqrt(self) -> Scaled {
        if self.mantissa == 0 {
            return Scaled::ZERO;
        }
        // A radicand of 63 or 64 bits with an even exponent: its root has 32 bits.
        let odd = self.exponent & 1;
        let wide = self.mantissa as u64;
        let radicand = if odd == 0 { wide << 32 } else { wide << 31 };
        Scaled { mantissa: root(radicand), exponent: self.exponent.saturating_sub(32 - odd) / 2 }
    }

    /// Adds a unit to the mantissa, which may carry into the next power of two.
    const fn carried(mantissa: u32, unit: u32, exponent: i16) -> Scaled {
        match mantissa.checked_add(unit) {
            Some(mantissa) => Scaled { mantissa, exponent },
            None => Scaled { mantissa: TOP, exponent: exponent.saturating_add(1) },
        }
    }

    /// `self * 2^exponent`, exactly.
    pub const fn shifted(self, exponent: i16) -> Scaled {
        if self.mantissa == 0 {
            return self;
        }
        Scaled { exponent: self.exponent.saturating_add(exponent), ..self }
    }

    /// Truncates to a multiple of `2^-bits` and returns it in that unit; saturates at `u64::MAX`.
    pub const fn to_wide(self, bits: i16) -> u64 {
        match self.exponent.saturating_add(bits) {
            _ if self.mantissa == 0 => 0,
            up @ 0..=32 => left(self.mantissa as u64, up as u32),
            down @ -31..0 => right(self.mantissa as u64, -down as u32),
            up if up > 0 => u64::MAX,
            _ => 0,
        }
    }

    /// Rounds to a multiple of `2^-bits` and returns it in that unit; saturates at `u32::MAX`.
    pub const fn to_fixed(self, bits: i16) -> u32 {
        if self.mantissa == 0 {
            return 0;
        }
        let up = self.exponent.saturating_add(bits);
        if up > 0 {
            return u32::MAX;
        }
        let down = up.unsigned_abs() as u32;
        match down {
            0 => self.mantissa,
            1..=31 => (self.mantissa >> down) + (self.mantissa >> (down - 1) & 1),
            // At least half a step: bit 31 of the mantissa is set.
            32 => 1,
            _ => 0,
        }
    }

    /// Converts to Q8.24, rounded to the nearest; saturates just below 256.
    pub const fn to_fixed24(self) -> Fixed24 {
        Fixed24(self.to_fixed(24))
    }

    /// Converts to Q15, rounded to the nearest; saturates at `i32::MAX`.
    pub const fn to_q15(self) -> Q15 {
        let raw = self.to_fixed(15);
        Q15(if raw > i32::MAX as u32 { i32::MAX } else { raw as i32 })
    }

    /// Logarithm to base 2 in 1/1024, rounded to the nearest (at most 0.501 steps off). Zero gives
    /// `i16::MIN`, far below that of any value of the core.
    pub const fn log2(self) -> i32 {
        let (mut mantissa, exponent) = (self.mantissa(), self.exponent());
        if mantissa == 0 {
            return i16::MIN as i32;
        }
        let mut log = exponent as i32 + 31;
        // With the mantissa in [1, 2): the next bit of the logarithm is 1 if its square is at least 2.
        let mut bit = 0;
        while bit < 11 {
            let square = wide(mantissa, mantissa);
            let carry = (square >> 63) as u32;
            mantissa = (square >> (31 + carry)) as u32;
            log = (log << 1) + carry as i32;
            bit += 1;
        }
        (log + 1) >> 1
    }

    /// Converts to a float, exactly (within the range of an `f64`).
    pub fn to_f64(self) -> f64 {
        let step = if self.exponent < 0 { 0.5 } else { 2.0 };
        (0..self.exponent.unsigned_abs()).fold(f64::from(self.mantissa), |value, _| value * step)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    /// Wide values of all magnitudes, from a small random generator.
    fn values() -> impl Iterator<Item = u64> {
        let edges = [1, 2, 3, (1 << 32) - 1, 1 << 32, (1 << 32) + 1, u64::MAX, u64::MAX - 1, 1 << 63];
        let mut state = 1u64;
        edges.into_iter().chain((0..3000u32).map(move |i| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state ^ state >> 29).max(1) >> (i % 64)
        }))
    }

    fn close(have: Scaled, want: f64, bits: i32) {
        let error = (have.to_f64() / want - 1.0).abs();
        // 2^-52 for the reference itself.
        assert!(error <= 2f64.powi(bits) + 4.0 * 2f64.powi(-52), "{have:?} {want} {error:e}");
    }

    #[test]
    fn errors_are_as_documented() {
        let mut last = 1u64;
        for value in values().filter(|v| *v > 0) {
            let (a, b) = (Scaled::from_u64(value), Scaled::from_u64(last));
            close(a, value as f64, -32);
            if value < 1 << 32 {
                assert_eq!(a.to_f64(), value as f64);
            }
            close(a.times(b), a.to_f64() * b.to_f64(), -32);
            close(a.over(b), a.to_f64() / b.to_f64(), -31);
            close(a.sqrt(), a.to_f64().sqrt(), -31);
            close(a.over(b).sqrt(), a.over(b).to_f64().sqrt(), -31);
            last = value;
        }
        assert_eq!(Scaled::from_u64(3).over(Scaled::ZERO), Scaled::MAX);
        assert_eq!(Scaled::from_u64(0), Scaled::ZERO);
        assert_eq!(Scaled::ZERO.sqrt(), Scaled::ZERO);
    }

    #[test]
    fn fixed_point_is_rounded_to_nearest_and_saturates() {
        let third = Scaled::from_u64(1).over(Scaled::from_u64(3));
        assert_eq!(third.to_q15(), Q15(10923));
        assert_eq!(third.to_fixed24(), Fixed24(5_592_405));
        assert_eq!(Scaled::from_u64(256).to_fixed24(), Fixed24(u32::MAX));
        assert_eq!(Scaled::from_u64(255).to_fixed24(), Fixed24(255 << 24));
        assert_eq!(Scaled::from_u64(u64::MAX).to_q15(), Q15(i32::MAX));
        assert_eq!(Scaled::from_u64(0xffff_ffff).to_fixed(0), u32::MAX);
        // 2^-25 is half a step of Q8.24 and rounds up; anything less does not.
        assert_eq!(Scaled::from_u64(1).over(Scaled::from_u64(1 << 25)).to_fixed24(), Fixed24(1));
        assert_eq!(Scaled::from_u64(1).over(Scaled::from_u64((1 << 25) + 1)).to_fixed24(), Fixed24(0));
        assert_eq!(Scaled::from_u64(3).shifted(62).to_wide(1), u64::MAX);
        assert_eq!(Scaled::from_u64(3).shifted(-1).to_wide(0), 1);
        assert_eq!(Scaled::from_u64(3).shifted(60).to_wide(2), 3 << 62);
        assert_eq!(Scaled::from_u64(3).shifted(-40).to_wide(2), 0);
        for value in values() {
            let scaled = Scaled::from_u64(value).over(Scaled::from_u64(1 << 40));
            let error = f64::from(scaled.to_fixed(8)) - (scaled.to_f64() * 256.0).min(u32::MAX.into());
            assert!(error.abs() <= 0.5);
        }
    }

    #[test]
    fn the_logarithm_is_rounded_to_the_nearest() {
        let mut state = 1u64;
        for round in 0..200_000u32 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let value = Scaled::from_u64((state >> (round % 64)).max(1)).shifted((round % 17) as i16 - 24);
            let want = value.to_f64().log2() * 1024.0;
            assert!((f64::from(value.log2()) - want).abs() <= 0.501, "{value:?}");
        }
        assert_eq!(Scaled::from_u64(1).log2(), 0);
        assert_eq!(Scaled::from_u64(8).log2(), 3 << 10);
        assert_eq!((Scaled::ZERO.log2(), Scaled::from_u64(1).shifted(40).log2()), (-32768, 40 << 10));
    }
}
