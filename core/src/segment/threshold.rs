//! Thresholds a row to bits.

#[cfg(target_pointer_width = "64")]
use wide::u16x16;

/// Returns the bits of the values, at most 32, that are not below `low`, which is at least 1.
#[cfg_attr(target_pointer_width = "64", inline(always))]
#[cfg_attr(not(target_pointer_width = "64"), inline(never))] // M0+: out of line
pub(crate) fn touched(values: &[u16], low: u16) -> u32 {
    #[cfg(target_pointer_width = "64")]
    return touched_by_vectors(values, low);
    #[cfg(not(target_pointer_width = "64"))]
    touched_by_sums(values, low)
}

/// One value after the other.
#[cfg(any(test, not(target_pointer_width = "64")))]
fn touched_by_sums(values: &[u16], low: u16) -> u32 {
    // The difference is negative if the value reaches the threshold; cheaper than a comparison.
    let below = u32::from(low) - 1;
    let next = |taxels: u32, value: &u16| taxels << 1 | below.wrapping_sub(u32::from(*value)) >> 31;
    // By four, because a loop over single values takes a third of its time for itself.
    let (first, fours) = values.as_rchunks::<4>();
    let taxels = fours.iter().rev().fold(0, |taxels, four| four.iter().rev().fold(taxels, next));
    first.iter().rev().fold(taxels, next)
}

/// Sixteen values at once.
#[cfg(target_pointer_width = "64")]
#[inline(always)]
fn touched_by_vectors(values: &[u16], low: u16) -> u32 {
    let (chunks, rest) = values.as_chunks();
    let last = rest.iter().rev().fold(0, |taxels, value| taxels << 1 | u32::from(*value >= low));
    chunks.iter().rev().fold(last, |taxels, chunk| {
        let missing = u16x16::splat(low).saturating_sub(u16x16::new(*chunk));
        taxels << 16 | missing.simd_eq(u16x16::ZERO).to_bitmask()
    })
}

#[cfg(test)]
mod tests {
    use super::super::run::WORD;
    use super::*;

    #[test]
    fn touched_taxels_are_those_from_the_threshold_on() {
        let mut state = 3u32;
        let mut next = || {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            state >> 16
        };
        for round in 0..2000 {
            let length = round % (usize::from(WORD) + 1);
            let low = [1, 60, 4095, 0x7fff, u16::MAX][round % 5];
            let mut row = [0u32; WORD as usize / 2];
            row.fill_with(|| {
                let mut value = || [0, low - 1, low, u16::MAX, next() as u16][next() as usize % 5];
                u32::from(value()) << 16 | u32::from(value())
            });
            let values: &[u16] = bytemuck::must_cast_slice(&row);
            let want = |values: &[u16]| {
                (0..).zip(values).fold(0, |all, (i, value)| all | u32::from(*value >= low) << i)
            };
            let short = &values[..length];
            assert_eq!(
                (touched_by_sums(short, low), touched_by_vectors(short, low)),
                (want(short), want(short))
            );
        }
    }
}
