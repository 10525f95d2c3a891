//! What is kept of the taxels that fold, four at a time: how it is renewed, subtracted and corrected.

use super::corners::Quads;
use super::lanes::{LevelPairs, byte, summed, zeros};
use super::lesson::Lesson;

/// Takes over what was found of quads.
#[inline(never)] // own registers
pub(super) fn take(felt: &mut [[u32; 2]], found: &Quads, taxels: &[[u16; 4]], held: &mut [u32]) {
    for (((felt, expected), doubt), taxels) in
        felt.iter_mut().zip(&found.expected).zip(&found.doubts).zip(taxels)
    {
        let now = [*expected, *doubt];
        let [was, is] = [*felt, now].map(|[expected, doubt]| zeros(expected | doubt));
        *felt = now;
        if was != is {
            hold(held, taxels, is);
        }
    }
}

/// Takes over what is expected of quads whose doubts stay.
#[inline(never)] // own registers
pub(super) fn take_expected(felt: &mut [[u32; 2]], expected: &[u32], taxels: &[[u16; 4]], held: &mut [u32]) {
    for (([before, doubt], expected), taxels) in felt.iter_mut().zip(expected).zip(taxels) {
        let was = *before;
        *before = *expected;
        // What is in doubt is held in any case.
        if zeros(*doubt) != 0 {
            let [was, is] = [was, *expected].map(|expected| zeros(expected | *doubt));
            if was != is {
                hold(held, taxels, is);
            }
        }
    }
}

/// The doubts that are part of the levels of quads.
pub(super) fn raise(
    raised: &mut [u32],
    felt: &[[u32; 2]],
    taxels: &[[u16; 4]],
    certain: impl Fn(&[u16; 4]) -> u32,
) {
    for ((raised, [_, doubt]), taxels) in raised.iter_mut().zip(felt).zip(taxels) {
        *raised = doubt & !certain(taxels);
    }
}

/// Levels of quads: what is expected, and the doubts that are part of it.
#[inline(never)] // own registers
pub(super) fn sum_levels(felt: &[[u32; 2]], raised: &[u32], unit: u32, levels: &mut [LevelPairs]) {
    for (([expected, _], raised), levels) in felt.iter().zip(raised).zip(levels) {
        *levels = summed(*expected, *raised, unit);
    }
}

/// Changes the values of the taxels that press, four at a time, by their bytes times `unit`, which is at most
/// 128.
#[inline(always)]
pub(super) fn change<'a>(
    values: &mut [u16],
    quads: impl Iterator<Item = (&'a [u16; 4], u32)>,
    unit: u32,
    by: impl Fn(u16, u16) -> u16 + Copy,
) {
    for (taxels, mut bytes) in quads {
        if bytes == 0 {
            continue;
        }
        for taxel in taxels {
            if let Some(value) = values.get_mut(usize::from(*taxel))
                && *value > 0
            {
                *value = by(*value, ((bytes & 0xFF) * unit) as u16);
            }
            bytes >>= 8;
        }
    }
}

/// Corrections after a comparison of those of four taxels that tell.
#[inline(never)] // own registers
pub(super) fn compare(
    mut told: u32,
    felt: &[u16; 4],
    mut expected: u32,
    mut corrections: u32,
    lesson: Lesson,
) -> u32 {
    // After four turns each byte is where it was.
    for felt in felt {
        if told & 1 == 1 {
            let to = lesson.corrected(*felt, expected as u8, corrections as u8);
            corrections = corrections & !0xFF | u32::from(to);
        }
        (corrections, expected, told) = (corrections.rotate_right(8), expected >> 8, told >> 1);
    }
    corrections
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
