//! The binary logarithm in sixteen bits.

/// Returns log2(1 + value) in Q8, at most 16,384; 3 units off at most.
///
/// The logarithm of the mantissa 1 + f is f + 0.3465 f (1 - f): exact at f = 0 and 1, and nearly so at 1/2.
#[inline]
pub const fn log2(value: u64) -> u16 {
    // In 32-bit words, which a Cortex-M0+ shifts by any distance in one instruction.
    if value < u32::MAX as u64 { of_word(value as u32 + 1) } else { of_words(value.saturating_add(1)) }
}

/// Returns log2 in Q8 of a word that is not 0.
const fn of_word(above: u32) -> u16 {
    let zeros = above.leading_zeros();
    of(above << zeros, 31 - zeros)
}

/// Returns log2 in Q8 of a value of more than a word.
const fn of_words(above: u64) -> u16 {
    let (high, low) = ((above >> 32) as u32, above as u32);
    let zeros = high.leading_zeros();
    of(high << zeros | (low >> 1) >> (31 - zeros), 63 - zeros)
}

/// Returns log2 in Q8 of `top * 2^(exponent - 31)`, where bit 31 of `top` is set.
const fn of(top: u32, exponent: u32) -> u16 {
    let fraction = (top << 1) >> 16;
    let bend = ((fraction >> 4) * ((65_536 - fraction) >> 4)) >> 8;
    (exponent << 8) as u16 + ((fraction + ((bend * 89) >> 8)) >> 8) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_logarithm_of_one_more() {
        let values =
            (0..10_000u64).chain((13..64).flat_map(|bit| [1 << bit, 3 << (bit - 1), u64::MAX >> bit]));
        for value in values.chain([u64::MAX]) {
            let exact = (value as f64 + 1.0).log2() * 256.0;
            assert!((f64::from(log2(value)) - exact).abs() <= 3.0, "{value}: {} of {exact}", log2(value));
        }
    }
}
