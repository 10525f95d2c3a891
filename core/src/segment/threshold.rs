//! Thresholds a row to bits.

use bytemuck::pod_align_to;
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

/// A row of sixteen taxels in memory: pairs of values.
pub(crate) type PairedRow16 = [u32; 8];

/// Returns the rows of a panel of sixteen columns; none if its values are not aligned to pairs, or if the
/// threshold has 16 bits.
pub(crate) fn paired_rows16(values: &[u16], columns: u16, low: u16) -> &[PairedRow16] {
    match pod_align_to(values) {
        ([], pairs, []) if columns == 16 && low < 1 << 15 => pairs.as_chunks().0,
        _ => &[],
    }
}

/// Returns the bits of the values of a row that are not below a threshold of 15 bits.
#[inline(always)]
pub(crate) fn touched_of_row16([a, b, c, d, e, f, g, h]: &PairedRow16, low: u16) -> u32 {
    // Unrolled by hand: the compiler would keep a loop.
    let low = u32::from(low) << 16 | u32::from(low);
    let four = two(two(two(two(0, *a, low), *b, low), *c, low), *d, low);
    let all = two(two(two(two(four, *e, low), *f, low), *g, low), *h, low);
    all >> 16 | (all & 0xffff) >> 1
}

/// Shifts the bits of earlier pairs down by two, and sets the highest bit of each half where that value of
/// `pair` is not below `low`. After eight pairs, the upper half holds every second bit of the row, and the
/// lower half those between them, shifted up by one.
#[inline(always)]
fn two(taxels: u32, pair: u32, low: u32) -> u32 {
    const HIGHEST: u32 = 1 << 31 | 1 << 15;
    let pair = u32::from_le(pair);
    // SWAR compare: bit 15 of a half stays set if its other 15 bits are not below `low`. A value that has bit
    // 15 itself is above any threshold of 15 bits.
    let high = ((pair | HIGHEST).wrapping_sub(low) | pair) & HIGHEST;
    taxels >> 2 | high
}

#[cfg(test)]
mod tests {
    use super::super::bits::WORD;
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
            let rows = paired_rows16(values, 16, low);
            assert_eq!(rows.len(), if low == u16::MAX { 0 } else { 2 });
            for (row, values) in rows.iter().zip(values.chunks(16)) {
                assert_eq!(touched_of_row16(row, low), want(values));
            }
            assert!(
                paired_rows16(&values[1..], 16, low).is_empty() && paired_rows16(values, 8, low).is_empty()
            );
        }
    }
}
