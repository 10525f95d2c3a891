//! State of the taxels that fold, four at a time: how it is renewed, subtracted and corrected.

use super::fours::{consecutive, in_a_row};
use super::lanes::{LaneSums, LevelPairs, byte, summed, times, zeros};
use super::lesson::Lesson;

/// Expected pressure on four taxels, in units of the table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quad {
    pub expected: u32,
    pub doubt: u32,
    /// The doubts that are part of their levels: all but those of a touch that was there.
    pub raised: u32,
}

impl Quad {
    /// Nothing.
    pub const NONE: Quad = Quad { expected: 0, doubt: 0, raised: 0 };

    /// The highest bits of the bytes of which nothing is expected or in doubt.
    #[inline(always)]
    fn nothing(&self) -> u32 {
        zeros(self.expected | self.doubt)
    }
}

/// Takes over doubts, all of which are part of the levels. True if some taxel is in no doubt: whether it is
/// held depends on what is expected, see [`hold_all`].
#[inline(never)] // own registers
pub(super) fn take_doubts(quads: &mut [Quad], doubts: &[u32], taxels: &[[u16; 4]], held: &mut [u32]) -> bool {
    let mut certain = 0;
    for ((quad, doubt), taxels) in quads.iter_mut().zip(doubts).zip(taxels) {
        let before = *quad;
        (quad.doubt, quad.raised) = (*doubt, *doubt);
        let now_certain = zeros(*doubt);
        if now_certain | zeros(before.doubt) != 0 {
            certain |= now_certain;
            if before.nothing() != quad.nothing() {
                hold(held, taxels, quad.nothing());
            }
        }
    }
    certain != 0
}

/// Expects what lies between two knots, the second of which counts `weight`, and sums up the levels.
#[inline(never)] // own registers
pub(super) fn expect(
    quads: &mut [Quad],
    (ends, weight): (&[[LaneSums; 2]], u32),
    unit: u32,
    levels: &mut [LevelPairs],
) {
    for ((quad, [start, step]), levels) in quads.iter_mut().zip(ends).zip(levels) {
        let expected = start.toward(step, weight).lanes();
        quad.expected = expected.bytes();
        *levels = expected.levels(quad.raised, unit);
    }
}

/// The doubts that are part of the levels of quads: but for those of bytes that have all bits in `certain`.
pub(super) fn raise(quads: &mut [Quad], taxels: &[[u16; 4]], certain: impl Fn(&[u16; 4]) -> u32) {
    for (quad, taxels) in quads.iter_mut().zip(taxels) {
        quad.raised = quad.doubt & !certain(taxels);
    }
}

/// Levels of quads: what is expected, and the doubts that are part of it.
#[inline(never)] // own registers
pub(super) fn sum_levels(quads: &[Quad], unit: u32, levels: &mut [LevelPairs]) {
    for (Quad { expected, raised, .. }, levels) in quads.iter().zip(levels) {
        *levels = summed(*expected, *raised, unit);
    }
}

/// Change of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    /// They become less by what is expected, at least 0.
    Lower,
    /// They become more by the doubts of the levels, at most 65,535, where something presses: 0 stays 0.
    Raise,
}

impl Change {
    /// Returns what a value becomes by so many counts.
    #[inline(never)] // seldom
    fn one(self, value: u16, by: u16) -> u16 {
        match self {
            Change::Lower => value.saturating_sub(by),
            Change::Raise if value > 0 => value.saturating_add(by),
            Change::Raise => 0,
        }
    }

    /// Returns what the halves of a word become, which are below 2^15, as `by` is.
    #[inline(always)]
    fn two(self, values: u32, by: u32) -> u32 {
        /// All bits below those that are set, of the highest ones of halves.
        const fn below(highs: u32) -> u32 {
            highs.wrapping_sub(highs >> 15)
        }
        if self == Change::Lower {
            // The highest bit of a half stays as long as what is left is not below 0.
            let left = (values | HIGHS).wrapping_sub(by);
            left & below(left & HIGHS)
        } else {
            // 1 and more reach the highest bit of a half.
            values.wrapping_add(by & below(values.wrapping_add(!HIGHS) & HIGHS))
        }
    }
}

/// The highest bit of each half of a word.
const HIGHS: u32 = 0x8000_8000;

/// Changes the values of a fold's taxels by what is expected or in doubt times `unit`, which is at most 128:
/// those of taxels that follow each other two at a time.
#[inline(never)] // own registers
pub(super) fn change(
    values: &mut [u16],
    (mut taxels, mut quads): (&[[u16; 4]], &[Quad]),
    unit: u32,
    change: Change,
) {
    let of = |quad: &Quad| if change == Change::Lower { quad.expected } else { quad.raised };
    while let ([first, ..], [quad, ..]) = (taxels, quads) {
        let row = consecutive(first).map_or(0..0, |start| start..start + 4 * in_a_row(taxels, start));
        let row = values.get_mut(row).unwrap_or_default();
        let done = match bytemuck::try_cast_slice_mut::<u16, LevelPairs>(row) {
            Ok(row @ [_, ..]) => {
                for (pairs, quad) in row.iter_mut().zip(quads) {
                    let ([a, b], bytes) = (*pairs, of(quad));
                    if a | b == 0 || bytes == 0 {
                        continue;
                    }
                    let by = times(bytes, unit);
                    if (a | b) & HIGHS == 0 {
                        let [by_a, by_b] = by;
                        *pairs = [change.two(a, by_a), change.two(b, by_b)];
                    } else {
                        change_each(bytemuck::cast_slice_mut(pairs), &[0, 1, 2, 3], by, change);
                    }
                }
                row.len()
            }
            _ => {
                change_each(values, first, times(of(quad), unit), change);
                1
            }
        };
        (taxels, quads) = (taxels.get(done..).unwrap_or(&[]), quads.get(done..).unwrap_or(&[]));
    }
}

/// Changes the values of four taxels, as far as there are such taxels.
#[inline(never)] // few fours are apart, or strong
fn change_each(values: &mut [u16], taxels: &[u16; 4], [a, b]: LevelPairs, change: Change) {
    for (taxel, by) in taxels.iter().zip([a, a >> 16, b, b >> 16]) {
        if let Some(value) = values.get_mut(usize::from(*taxel)) {
            *value = change.one(*value, by as u16);
        }
    }
}

/// Corrections after a comparison of those of four taxels that say what they feel.
#[inline(never)] // own registers
pub(super) fn compare(
    mut known: u32,
    felt: &[u16; 4],
    mut expected: u32,
    mut corrections: u32,
    lesson: Lesson,
) -> u32 {
    // After four turns each byte is where it was.
    for felt in felt {
        if known & 1 == 1 {
            let to = lesson.corrected(*felt, expected as u8, corrections as u8);
            corrections = corrections & !0xFF | u32::from(to);
        }
        (corrections, expected, known) = (corrections.rotate_right(8), expected >> 8, known >> 1);
    }
    corrections
}

/// Notes which taxels are held, of quads in which one is in no doubt: the others are held in any case.
#[inline(never)] // seldom
pub(super) fn hold_all(quads: &[Quad], taxels: &[[u16; 4]], held: &mut [u32]) {
    for (quad, taxels) in quads.iter().zip(taxels).filter(|(quad, _)| zeros(quad.doubt) != 0) {
        hold(held, taxels, quad.nothing());
    }
}

/// Notes of which of four taxels nothing is expected or in doubt, by the highest bits of `nothing`.
#[inline(never)] // seldom
fn hold(held: &mut [u32], taxels: &[u16; 4], nothing: u32) {
    for (lane, taxel) in taxels.iter().enumerate() {
        let Some(word) = held.get_mut(usize::from(taxel / 32)) else { continue };
        let bit = 1 << (taxel % 32);
        if byte(nothing, lane) == 0 { *word |= bit } else { *word &= !bit }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values, aligned like words.
    #[repr(C, align(4))]
    struct Aligned([u16; 64]);

    #[test]
    fn values_are_changed_taxel_by_taxel() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 12) % end
        };
        for round in 0..20_000 {
            // Weak ones, or any; some do not press.
            let most = [20, 4096, 0x8000, 0x1_0000][round % 4];
            let values = core::array::from_fn(|_| if next(4) == 0 { 0 } else { next(most) as u16 });
            let bytes: [u32; 5] =
                core::array::from_fn(|_| [0, next(1 << 20) << 8 | next(256), !0][next(3) as usize]);
            let unit = 1 + next(128);
            // Some in a row, from an even or odd taxel on, one four that is apart, and one that ends beyond
            // all.
            let first = 8 + next(9) as u16;
            let row = |at: u16| [0, 1, 2, 3].map(|taxel| first + 4 * at + taxel);
            let taxels = [[1, 2, 4, 7], row(0), row(1), row(2), [60, 61, 63, u16::MAX]];
            let quads = bytes.map(|bytes| Quad { expected: bytes, doubt: !0, raised: bytes });
            let changed = |how| {
                let mut aligned = Aligned(values);
                change(&mut aligned.0, (&taxels, &quads), unit, how);
                aligned.0
            };
            let want = |by: fn(u16, u16) -> u16| {
                let mut want = values;
                for (at, taxel) in taxels.as_flattened().iter().enumerate() {
                    let more = u32::from(byte(bytes[at / 4], at % 4)) * unit;
                    if let Some(value) = want.get_mut(usize::from(*taxel)) {
                        *value = by(*value, more as u16);
                    }
                }
                want
            };
            assert_eq!(changed(Change::Lower), want(u16::saturating_sub), "{values:?}");
            let raise = |value: u16, by| if value == 0 { 0 } else { value.saturating_add(by) };
            assert_eq!(changed(Change::Raise), want(raise), "{values:?}");
        }
    }
}
