//! Division by multiplication: the Cortex-M0+ has no divider, and 64 bits by software take 750 cycles.

use super::machine::WIDE;
use super::product::wide;
use super::shift::left;

/// Inverse of a divisor, by Newton's iteration. Its cost (about 100 cycles) pays off from the first quotient
/// on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inverse {
    /// The divisor, shifted so that bit 31 is set; 0 for no divisor.
    pub(super) normal: u32,
    pub(super) shift: u32,
    /// `2^63 / normal`, or one less; on a wide machine `2^64 / divisor`, rounded down, or `2^64 / divisor - 1`.
    inverse: usize,
}

/// Leading zeros with which seven divisors fit a word.
const SPARE: u32 = 3;

/// `2^63 / normal` for a `normal` with bit 31 set, or one less; tested for all of them.
const fn inverse_of(normal: u32) -> u32 {
    let (t, low) = (normal >> 16, normal & 0xffff);
    // The line 48/17 - 32/17 t is at most 1/17 off; two rounds in 16 bits leave 2^-14, with x in Q15.
    let mut x = 92_521 - ((t * 61_681) >> 16);
    x = (x * ((t * x).wrapping_neg() >> 16)) >> 15;
    x = (x * ((t * x).wrapping_neg() >> 16)) >> 15;
    let x = if x > 0xffff { 0xffff } else { x };
    // A third round leaves 2^-26, with 14 bits of the remainder.
    let rest = (1u32 << 31).wrapping_sub(t * x + ((low * x) >> 16)) as i32;
    let near = (x << 16).saturating_add_signed((x as i32 * (rest >> 4)) >> 11);
    // A fourth uses the exact remainder, rounded down.
    let rest = (1u64 << 63).wrapping_sub(wide(normal, near)) as i64;
    near.saturating_add_signed(((rest >> 24) as i32 * (near >> 16) as i32) >> 23)
}

impl Inverse {
    /// Inverse of a divisor; 0 makes every quotient `u32::MAX`.
    pub const fn of(divisor: u32) -> Inverse {
        if divisor == 0 {
            return Inverse { normal: 0, shift: 0, inverse: 0 };
        }
        let shift = divisor.leading_zeros();
        if WIDE {
            return Inverse {
                normal: divisor << shift,
                shift,
                inverse: (u64::MAX / divisor as u64) as usize,
            };
        }
        Inverse { shift, ..Inverse::of_normal(divisor << shift) }
    }

    /// Inverse of the divisor shifted so that bit 31 is set.
    pub(super) const fn unshifted(&self) -> Inverse {
        if WIDE { Inverse::of(self.normal) } else { Inverse { shift: 0, ..*self } }
    }

    /// Inverse of a divisor with bit 31 set.
    pub(super) const fn of_normal(normal: u32) -> Inverse {
        if WIDE {
            Inverse::of(normal)
        } else {
            Inverse { normal, shift: 0, inverse: inverse_of(normal) as usize }
        }
    }

    /// `value / divisor`, exactly and rounded down; `u32::MAX` if it is more.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // M0+: out of line
    pub const fn quotient(&self, value: u64) -> u32 {
        let divisor = self.normal >> self.shift;
        if (value >> 32) as u32 >= divisor {
            return u32::MAX;
        }
        if WIDE { self.wide_quotient(value) } else { self.narrow_quotient(value) }
    }

    /// Quotient of a value for which it is below 2^32, with an inverse of 64 bits. The first estimate is at
    /// most 1 too small, as its error is below 1.
    const fn wide_quotient(&self, value: u64) -> u32 {
        let divisor = (self.normal >> self.shift) as u64;
        let quotient = ((value as u128 * self.inverse as u128) >> 64) as u64;
        let rest = value - quotient * divisor;
        (quotient + (rest >= divisor) as u64) as u32
    }

    /// Quotient of such a value with an inverse of 32 bits.
    #[inline(always)]
    const fn narrow_quotient(&self, value: u64) -> u32 {
        let divisor = self.normal >> self.shift;
        let (high, low) = ((value >> 32) as u32, value as u32);
        if self.shift < SPARE {
            return self.large_quotient(value);
        }
        // The quotient is below 2^32: the shifted value does not lose bits.
        let top = high << self.shift | low >> (32 - self.shift);
        let quotient = (wide(top, self.inverse as u32) >> 31) as u32;
        // Too small by less than 7: 4 for the inverse, 2 for the low half of the value, 1 for truncation. The
        // rest is below 7 divisors and fits a word, so its upper word is not computed.
        let rest = low.wrapping_sub(quotient.wrapping_mul(divisor));
        if rest < divisor {
            quotient
        } else if rest - divisor < divisor {
            quotient + 1
        } else {
            self.large_quotient(value) // one in twenty
        }
    }

    /// Quotient of a value for which it is below 2^32, by any divisor; corrects an estimate that is too small
    /// by any number of units.
    #[cold]
    const fn large_quotient(&self, value: u64) -> u32 {
        let value = left(value, self.shift);
        let mut quotient = (wide((value >> 32) as u32, self.inverse as u32) >> 31) as u32;
        let mut rest = value - wide(quotient, self.normal);
        while rest >= self.normal as u64 {
            rest -= self.normal as u64;
            quotient += 1;
        }
        quotient
    }

    /// `value / divisor` rounded to the nearest (halves upwards), saturating at the ends of an `i32`.
    pub const fn nearest(&self, value: i64) -> i32 {
        let divisor = self.normal >> self.shift;
        let half = divisor >> 1;
        // For negative values: floor((half - size) / d) = -ceil((size - half) / d).
        let more = if value >= 0 { half } else { divisor.saturating_sub(1) - half };
        let quotient = self.quotient(value.unsigned_abs() + more as u64);
        // -1 for negative values, whose range reaches a unit further.
        let sign = (value >> 63) as i32;
        let limit = (i32::MAX as u32).wrapping_sub(sign as u32);
        let size = if quotient < limit { quotient } else { limit };
        (size as i32 ^ sign).wrapping_sub(sign)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_exact() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state ^ (state >> 29)
        };
        let edges = [1, 2, 3, 0x7fff_ffff, 0x8000_0000, 0x8000_0001, 0xffff_ffff, 0xffff_0000, 0x1_0000];
        for round in 0..300_000 {
            let divisor = match edges.get(round % 64) {
                Some(edge) => *edge,
                None => ((next() >> 32) as u32 >> (round % 31)).max(1),
            };
            let inverse = Inverse::of(divisor);
            let narrow = inverse_of(inverse.normal);
            let ideal = (1u128 << 63) / u128::from(inverse.normal);
            let short = ideal as i128 - i128::from(narrow);
            assert!((0..=1).contains(&short), "{divisor:#x} {short}");
            let quotient = next() as u32 >> (round % 29);
            for rest in [0, divisor - 1, next() as u32 % divisor] {
                let value = u64::from(divisor) * u64::from(quotient) + u64::from(rest);
                assert_eq!(inverse.quotient(value), quotient, "{value} / {divisor}");
                let narrow = Inverse { inverse: narrow as usize, ..inverse };
                assert_eq!(narrow.narrow_quotient(value), quotient, "{value} / {divisor}");
            }
            let value = next() as i64 >> (round % 63);
            let want = (i128::from(value) + i128::from(divisor / 2)).div_euclid(divisor.into());
            let want = want.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
            assert_eq!(inverse.nearest(value), want, "{value} / {divisor}");
        }
        assert_eq!(Inverse::of(7).quotient(u64::MAX), u32::MAX);
        assert_eq!((Inverse::of(0).quotient(5), Inverse::of(0).quotient(0)), (u32::MAX, u32::MAX));
        assert_eq!((Inverse::of(0).nearest(5), Inverse::of(1).nearest(i64::MIN)), (i32::MAX, i32::MIN));
    }
}
