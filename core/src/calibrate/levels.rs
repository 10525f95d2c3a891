//! Limits of taxels on which so much presses that is no touch: four at a time, two in a word.

use super::scale::UNITY;
use super::terms::LimitTerms;
use crate::fold::{LevelPairs, consecutive, in_a_row};
use core::ops::Range;

/// The highest bit of each half of a word.
const HIGH: u32 = 0x8000_8000;
/// Two gains of 1.
const UNITIES: u32 = UNITY as u32 * 0x0001_0001;

/// Calibration of all taxels: baselines, gains, and the limits that are set.
pub(super) struct LevelLimits<'a> {
    pub rest: &'a [u16],
    pub gain: &'a [u16],
    pub limit: &'a mut [u16],
    /// True if every gain is known to be 1.
    pub are_ones: bool,
}

impl LevelLimits<'_> {
    /// Sets the limits of taxels; other numbers than those of taxels are left out.
    #[inline(never)] // own registers
    pub fn set(&mut self, mut taxels: &[[u16; 4]], mut levels: &[LevelPairs], terms: LimitTerms) {
        while let [first, ..] = taxels {
            let row = consecutive(first).map_or(0..0, |start| start..start + 4 * in_a_row(taxels, start));
            let done = match self.set_row(row, levels, terms) {
                Ok(done) => done,
                Err(count) => {
                    self.set_each(taxels.get(..count).unwrap_or(taxels), levels, terms);
                    count
                }
            };
            (taxels, levels) = (taxels.get(done..).unwrap_or(&[]), levels.get(done..).unwrap_or(&[]));
        }
    }

    /// Sets the limits of taxels in a row, up to four one of which has another gain than 1. Returns the number
    /// of fours; an error with the number of those that are to be set by taxel, at least one.
    fn set_row(
        &mut self,
        row: Range<usize>,
        levels: &[LevelPairs],
        terms: LimitTerms,
    ) -> Result<usize, usize> {
        let margin = u32::from(terms.margin_of_unity());
        let (rest, gain) =
            (self.rest.get(row.clone()).unwrap_or(&[]), self.gain.get(row.clone()).unwrap_or(&[]));
        let limit = self.limit.get_mut(row).unwrap_or_default();
        // Aligned to words.
        let (Ok(rest), Ok(gain), Ok(limit)) = (
            bytemuck::try_cast_slice::<_, u32>(rest),
            bytemuck::try_cast_slice(gain),
            bytemuck::try_cast_slice_mut(limit),
        ) else {
            return Err(1);
        };
        let count = if self.are_ones { gain.len() } else { unities(gain) };
        let rest = rest.get(..2 * count).unwrap_or(&[]);
        if count == 0 || margin & HIGH >> 16 != 0 {
            return Err(1);
        }
        let set = if terms.is_falling() { set_pairs::<true> } else { set_pairs::<false> };
        let is_set = set(rest, levels.as_flattened(), limit, margin * 0x0001_0001);
        if is_set { Ok(count) } else { Err(count) }
    }

    /// Sets the limits of any taxels.
    #[inline(never)] // seldom
    fn set_each(&mut self, taxels: &[[u16; 4]], levels: &[LevelPairs], terms: LimitTerms) {
        let levels = levels.iter().flatten().flat_map(|pair| [*pair as u16, (*pair >> 16) as u16]);
        for (taxel, level) in taxels.as_flattened().iter().zip(levels) {
            let taxel = usize::from(*taxel);
            let calibration = self.rest.get(taxel).zip(self.gain.get(taxel)).zip(self.limit.get_mut(taxel));
            let Some(((rest, gain), limit)) = calibration else { continue };
            *limit = terms.limit_beyond(level, *rest, *gain);
        }
    }
}

/// Number of fours up to one with another gain than 1.
#[inline(never)] // own registers
fn unities(gain: &[[u32; 2]]) -> usize {
    let other = gain.iter().position(|[a, b]| *a != UNITIES || *b != UNITIES);
    other.unwrap_or(gain.len())
}

/// Sets the limits of pairs of taxels with gains of 1. False if a number is too large for that, or a limit
/// would be below 0.
#[inline(never)] // own registers
fn set_pairs<const FALLING: bool>(rest: &[u32], levels: &[u32], limit: &mut [u32], margins: u32) -> bool {
    // Halves below 2^15: no sum of two of them reaches the other half.
    let mut large = 0;
    for ((rest, level), limit) in rest.iter().zip(levels).zip(limit) {
        if FALLING {
            let margins = level.wrapping_add(margins);
            // The highest bit of a half stays as long as the limit is not below 0.
            let limits = (rest | HIGH).wrapping_sub(margins);
            large |= rest | level | margins | !limits;
            *limit = limits ^ HIGH;
        } else {
            let beyond = rest.wrapping_add(*level);
            large |= rest | level | beyond;
            *limit = beyond.wrapping_add(margins);
        }
    }
    large & HIGH == 0
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    /// Baselines, gains and limits, aligned like words.
    #[repr(C, align(4))]
    struct Aligned([[u16; 64]; 3]);

    #[test]
    fn limits_are_those_of_each_taxel() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 12) % end
        };
        let sizes = [1, 300, 4096, 0x8000, 0x1_0000];
        for round in 0..20_000 {
            let mut size = || sizes[next(5) as usize];
            let (rest_size, level_size, floor_size) = (size(), size(), size());
            let mut gain = || if next(8) == 0 { [0, 4095, 9000][next(3) as usize] } else { UNITY };
            let gain: [u16; 64] = if round % 4 == 0 { [UNITY; 64] } else { std::array::from_fn(|_| gain()) };
            let rest: [u16; 64] = std::array::from_fn(|_| next(rest_size) as u16);
            // Some in a row, from an even or odd taxel on, some apart, and one that there is not.
            let first = next(61) as u16;
            let taxels = [[0, 1, 2, 3].map(|at| first + at), [1, 5, 6, 7], [40, 41, 42, u16::MAX]];
            let levels: [[u16; 4]; 3] = [(); 3].map(|()| [(); 4].map(|()| next(level_size) as u16));
            let terms = LimitTerms::new(1 + next(floor_size.min(60_000)) as u16, round % 2 == 0);
            let mut aligned = Aligned([rest, gain, [7; 64]]);
            let [rest, gain, limit] = &mut aligned.0;
            let pairs: Vec<LevelPairs> =
                levels.iter().map(|&[a, b, c, d]| bytemuck::cast([a, b, c, d])).collect();
            let are_ones = gain.iter().all(|gain| *gain == UNITY);
            LevelLimits { rest, gain, limit, are_ones }.set(&taxels, &pairs, terms);
            let mut want = [7; 64];
            for (taxel, level) in taxels.as_flattened().iter().zip(levels.as_flattened()) {
                let Some(want) = want.get_mut(usize::from(*taxel)) else { continue };
                let (rest, gain) = (rest[usize::from(*taxel)], gain[usize::from(*taxel)]);
                let margin = i32::from(terms.margin_of_unity()) + i32::from(*level);
                *want = match gain {
                    UNITY if terms.is_falling() => (i32::from(rest) - margin).max(0) as u16,
                    UNITY => (i32::from(rest) + margin).min(0xffff) as u16,
                    gain => terms.limit(rest, terms.beyond(*level).margin(gain)),
                };
            }
            assert_eq!(*limit, want, "{terms:?} {levels:?}");
        }
    }
}
