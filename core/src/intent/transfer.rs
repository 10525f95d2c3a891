//! Transfer functions: from the weighted sum of a concept to its activation.
//!
//! | transfer | f(z), after the threshold T was subtracted from z | range |
//! |---|---|---|
//! | bivalent | 1 if z > 0, else 0 | 0, 1 |
//! | trivalent | 1 if z > 0, -1 if z < 0, 0 in a tie | -1, 0, 1 |
//! | sigmoid | 1 / (1 + exp(-lambda z)) | 0 ..= 1 |
//! | tanh | tanh(lambda z) | -1 ..= 1 |
//! | positive | tanh(lambda z) if z > 0, else 0 | 0 ..= 1 |
//!
//! All five subtract T from the sum before the function. The trivalent function with T = 0.2 is therefore the
//! sign of z - 0.2, not a dead zone of +-0.2 (which would have no meaning for T < 0).
//!
//! Smooth functions use one table of 513 points with linear interpolation. Largest errors, asserted by the
//! tests: tanh 0.9 steps of 2^-15, sigmoid 0.75 steps.

use serde::{Deserialize, Serialize};

/// Function from the weighted sum of a concept to its next activation. Variants are only appended.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Transfer {
    /// 1 above the threshold, else 0: the rule that the source publishes.
    Bivalent,
    /// The sign of the distance from the threshold, 0 in a tie.
    Trivalent,
    /// The logistic function, 0 ..= 1.
    Sigmoid,
    /// The hyperbolic tangent, -1 ..= 1: 0 stays 0, so a quiet map is silent.
    #[default]
    Tanh,
    /// The hyperbolic tangent above 0, else 0: a concept that does not hold is 0, and its absence causes
    /// nothing.
    Positive,
}

impl Transfer {
    /// True if the output is one of two or three values; such maps run on the decimal steps of their
    /// configuration.
    pub const fn is_threshold(self) -> bool {
        matches!(self, Transfer::Bivalent | Transfer::Trivalent)
    }
}

/// tanh(k / 64) in Q23 for k = 0 ..= 512, from `build.rs`.
static TANH: [u32; 513] = include!(concat!(env!("OUT_DIR"), "/tanh.rs"));

/// Fraction bits of the argument of [`tanh`]: 8 is 2^29.
pub const ARGUMENT_BITS: u32 = 26;

/// The greatest argument of the table, 8; tanh(8) is 1 - 2.3e-7, which is 1 in Q15.
const LIMIT: i32 = 8 << ARGUMENT_BITS;

/// Returns tanh of |u| (Q26) in Q23; 1 beyond 8. Never panics.
fn tanh_q23(u: i32) -> u32 {
    const ONE: u32 = 1 << 23;
    // A step of the table is 1/64 = 2^20 units; 14 of its 20 fraction bits are used. Neighbours differ by at
    // most 2^17, so the product stays below 2^31.
    let size = u.unsigned_abs().min(LIMIT as u32);
    let (index, fraction) = ((size >> 20) as usize, (size & 0xF_FFFF) >> 6);
    let low = TANH.get(index).copied().unwrap_or(ONE);
    let high = TANH.get(index + 1).copied().unwrap_or(ONE);
    low + ((high.saturating_sub(low) * fraction) >> 14)
}

/// Returns tanh of `u` (Q26) in Q15; +-32768 beyond +-8. Exactly odd. Error: 0.9 steps. Never panics.
pub fn tanh(u: i32) -> i32 {
    let value = ((tanh_q23(u) + (1 << 7)) >> 8) as i32;
    if u < 0 { -value } else { value }
}

/// Returns the logistic function of 2 `u` (`u` in Q26) in Q15, 0 ..= 32768, from the same table as [`tanh`].
/// Error: 0.75 steps. sigmoid(-u) = 32768 - sigmoid(u) exactly.
pub fn sigmoid_of_twice(u: i32) -> i32 {
    let positive = (((1 << 23) + tanh_q23(u) + (1 << 8)) >> 9) as i32;
    if u < 0 { 32768 - positive } else { positive }
}

/// A number k 2^e that multiplies a 32-bit sum without 64-bit arithmetic, which a Cortex-M0+ does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gain {
    /// 2^15 ..= 2^16 - 1.
    factor: u16,
    /// Positive: shift left before the multiplication; negative: shift right after it.
    shift: i8,
    /// Sums are clamped to this first: beyond it, the argument is past the end of the table.
    limit: i32,
}

impl Gain {
    /// The gain of an empty map: everything becomes 0.
    pub(crate) const NONE: Gain = Gain { factor: 0, shift: 0, limit: 0 };

    /// Returns the gain nearest to `numerator / denominator`, relative error below 2^-16. Both are below
    /// 2^60. A numerator of 0 counts as 1. Only `build` calls this, hence the 128-bit arithmetic.
    pub(crate) fn new(numerator: u64, denominator: u64) -> Gain {
        let (n, d) = (u128::from(numerator.max(1)), u128::from(denominator.max(1)));
        let mut shift = -31i8;
        // The factor must be in [2^15, 2^16).
        let mut factor = scaled(n, d, shift);
        while shift < 30 && factor > u128::from(u16::MAX) {
            shift += 1;
            factor = scaled(n, d, shift);
        }
        let limit = quotient(u128::from(LIMIT as u32) * d + n - 1, n);
        Gain {
            factor: factor.min(u128::from(u16::MAX)) as u16,
            shift,
            limit: limit.min(i32::MAX as u128) as i32,
        }
    }

    /// Returns `sum` times the gain, clamped to the range of the table. Never panics.
    pub fn apply(self, sum: i32) -> i32 {
        // Not `clamp`, which panics on an empty range: the compiler cannot know that `limit` is positive.
        let sum = sum.max(-self.limit).min(self.limit);
        // With shift > 0: |sum| << shift <= 2^29 * 2^16 / factor <= 2^30 by the choice of `limit`. That is
        // rounded up by less than one unit, hence wrapping instead of a proof to the last bit.
        let sum = if self.shift > 0 { sum.wrapping_shl(self.shift.unsigned_abs().into()) } else { sum };
        let factor = i32::from(self.factor);
        let high = (sum >> 16).wrapping_mul(factor);
        let low = (((sum & 0xFFFF) as u32).wrapping_mul(factor as u32) >> 16) as i32;
        let product = high.wrapping_add(low);
        if self.shift < 0 { product >> self.shift.unsigned_abs().min(31) } else { product }
    }
}

/// `n / d * 2^(16 - shift)`, rounded.
#[inline(never)] // for size
fn scaled(n: u128, d: u128, shift: i8) -> u128 {
    let up = 16 - i32::from(shift);
    let (n, d) = if up >= 0 { (n << up.min(63), d) } else { (n, d << (-up).min(63)) };
    quotient(n + d / 2, d)
}

/// The quotient of two large numbers, or the largest number. M0+: a division of 128 bits takes 600 bytes.
#[inline(never)] // for size
fn quotient(n: u128, d: u128) -> u128 {
    n.checked_div(d).unwrap_or(u128::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arguments: every 997th of the range and beyond it, and both neighbours of every point of the table.
    fn arguments() -> impl Iterator<Item = i32> {
        let steps = (-(1i64 << 30)..=1 << 30).step_by(997).map(|u| u as i32);
        steps.chain((-513..=513).flat_map(|k| [(k << 20) - 1, k << 20, (k << 20) + 1]))
    }

    fn worst(f: impl Fn(i32) -> i32, exact: impl Fn(f64) -> f64) -> f64 {
        let unit = f64::from(1u32 << ARGUMENT_BITS);
        arguments()
            .map(|u| (f64::from(f(u)) - 32768.0 * exact(f64::from(u) / unit)).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn tanh_is_within_0_9_steps() {
        extern crate std;
        let error = worst(tanh, |u| u.tanh());
        std::println!("tanh: largest error {error:.3} steps of 2^-15");
        assert!(error < 0.9, "{error}");
        assert_eq!((tanh(0), tanh(i32::MAX), tanh(i32::MIN)), (0, 32768, -32768));
    }

    #[test]
    fn sigmoid_is_within_0_75_steps() {
        extern crate std;
        let error = worst(sigmoid_of_twice, |u| 1.0 / (1.0 + (-2.0 * u).exp()));
        std::println!("sigmoid: largest error {error:.3} steps of 2^-15");
        assert!(error < 0.75, "{error}");
        assert_eq!((sigmoid_of_twice(0), sigmoid_of_twice(i32::MAX)), (16384, 32768));
        assert!(arguments().all(|u| u == i32::MIN || sigmoid_of_twice(-u) == 32768 - sigmoid_of_twice(u)));
    }

    #[test]
    fn tanh_rises() {
        let mut last = i32::MIN;
        for u in (-(9 << 26)..=9 << 26).step_by(4099) {
            assert!(tanh(u) >= last);
            last = tanh(u);
        }
    }

    #[test]
    fn gain_is_within_its_relative_error_and_never_wraps() {
        for (n, d) in [
            (1u64, 1u64),
            (65535 << 26, 1000 << 15),
            (1 << 26, (1000 * 10_000) << 15),
            (5 << 26, (2 * 100) << 15),
        ] {
            let gain = Gain::new(n, d);
            for sum in (i32::MIN..=i32::MAX).step_by(9_999_991).chain([-3, -1, 0, 1, 2, 77, 4095]) {
                let exact = (f64::from(sum) * n as f64 / d as f64).clamp(-536_870_912.0, 536_870_912.0);
                let error = (f64::from(gain.apply(sum)) - exact).abs();
                // The clamp may stop half a unit of the sum beyond the end of the table.
                let unit = n as f64 / d as f64;
                assert!(error <= exact.abs() / 32768.0 + unit.max(2.0), "{n}/{d} * {sum}: off by {error}");
            }
        }
    }
}
