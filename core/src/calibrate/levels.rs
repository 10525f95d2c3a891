//! Limits of taxels on which so much presses that is no touch: four at a time, two in a word.

use super::scale::UNITY;
use super::terms::LimitTerms;
use crate::fold::LevelPairs;

/// The highest bit of each half of a word.
const HIGH: u32 = 0x8000_8000;
/// Two gains of 1.
const UNITIES: u32 = UNITY as u32 * 0x0001_0001;

/// Number of the first of four taxels, if they follow each other; the numbers ascend.
#[inline(always)]
pub(crate) fn consecutive([first, _, _, last]: &[u16; 4]) -> Option<usize> {
    (last.wrapping_sub(*first) == 3).then_some((*first).into())
}

/// Calibration of all taxels: baselines, gains, and the limits that are set.
pub(super) struct LevelLimits<'a> {
    pub rest: &'a [u16],
    pub gain: &'a [u16],
    pub limit: &'a mut [u16],
}

impl LevelLimits<'_> {
    /// Sets the limits of taxels; other numbers than those of taxels are left out.
    #[inline(never)] // own registers
    pub fn set<const FALLING: bool>(
        &mut self,
        mut taxels: &[[u16; 4]],
        mut levels: &[LevelPairs],
        terms: LimitTerms,
    ) {
        while let [first, ..] = taxels {
            let done = consecutive(first).and_then(|first| {
                let in_a_row =
                    taxels.iter().zip((first as u16..).step_by(4)).take_while(in_its_place).count();
                self.set_row::<FALLING>(first, levels.get(..in_a_row)?, terms.margin_of_unity())
            });
            let done = done.filter(|done| *done > 0).unwrap_or_else(|| {
                self.set_each(taxels.get(..1).unwrap_or(taxels), levels, terms);
                1
            });
            (taxels, levels) = (taxels.get(done..).unwrap_or(&[]), levels.get(done..).unwrap_or(&[]));
        }
    }

    /// Sets the limits of taxels in a row, up to four one of which has another gain than 1, or a number that is
    /// large. Returns the number of fours. None if the row is not aligned to words.
    fn set_row<const FALLING: bool>(
        &mut self,
        first: usize,
        levels: &[LevelPairs],
        margin: u16,
    ) -> Option<usize> {
        let levels = levels.as_flattened();
        let row = first..first + 2 * levels.len();
        let rest = bytemuck::try_cast_slice(self.rest.get(row.clone())?).ok()?;
        let gain = bytemuck::try_cast_slice(self.gain.get(row.clone())?).ok()?;
        let limit = bytemuck::try_cast_slice_mut(self.limit.get_mut(row)?).ok()?;
        (u32::from(margin) & HIGH >> 16 == 0)
            .then(|| set_pairs::<FALLING>(rest, gain, levels, limit, u32::from(margin) * 0x0001_0001) / 2)
    }

    /// Sets the limits of any taxels.
    #[inline(never)] // seldom
    fn set_each(&mut self, taxels: &[[u16; 4]], levels: &[LevelPairs], terms: LimitTerms) {
        let levels = levels.iter().flatten().flat_map(|pair| [*pair as u16, (*pair >> 16) as u16]);
        for (taxel, level) in taxels.as_flattened().iter().zip(levels) {
            let taxel = usize::from(*taxel);
            let calibration = self.rest.get(taxel).zip(self.gain.get(taxel)).zip(self.limit.get_mut(taxel));
            let Some(((rest, gain), limit)) = calibration else { continue };
            *limit = match *gain {
                // The same, without a division.
                UNITY => {
                    let (rest, margin) =
                        (u32::from(*rest), u32::from(terms.margin_of_unity()) + u32::from(level));
                    let limit = if terms.is_falling() { rest.saturating_sub(margin) } else { rest + margin };
                    u16::try_from(limit).unwrap_or(u16::MAX)
                }
                gain => terms.limit(*rest, terms.beyond(level).margin(gain)),
            };
        }
    }
}

/// True if the numbers of four taxels that follow each other begin with this one.
fn in_its_place((taxels, first): &(&[u16; 4], u16)) -> bool {
    consecutive(taxels) == Some(usize::from(*first))
}

/// Sets the limits of pairs of taxels, up to one with another gain than 1, or with a number that is large.
/// Returns their number.
#[inline(never)] // own registers
fn set_pairs<const FALLING: bool>(
    rest: &[u32],
    gain: &[u32],
    levels: &[u32],
    limit: &mut [u32],
    margins: u32,
) -> usize {
    let mut done = 0;
    for (((rest, gain), level), limit) in rest.iter().zip(gain).zip(levels).zip(limit) {
        let Some(pair) = pair::<FALLING>(*rest, *level, margins).filter(|_| *gain == UNITIES) else { break };
        *limit = pair;
        done += 1;
    }
    done
}

/// Limits of two taxels with gains of 1; none if one of their numbers is large, or a limit would be below 0.
#[inline(always)]
fn pair<const FALLING: bool>(rest: u32, level: u32, margins: u32) -> Option<u32> {
    // Halves below 2^15: no sum of two of them reaches the other half.
    if FALLING {
        let margins = level.wrapping_add(margins);
        if (rest | level | margins) & HIGH != 0 {
            return None;
        }
        // The highest bit of a half stays as long as the limit is not below 0.
        let limits = (rest | HIGH).wrapping_sub(margins);
        (limits & HIGH == HIGH).then_some(limits ^ HIGH)
    } else {
        let beyond = rest.wrapping_add(level);
        ((rest | level | beyond) & HIGH == 0).then_some(beyond.wrapping_add(margins))
    }
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
            let gain: [u16; 64] = std::array::from_fn(|_| gain());
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
            let mut limits = LevelLimits { rest, gain, limit };
            if terms.is_falling() {
                limits.set::<true>(&taxels, &pairs, terms);
            } else {
                limits.set::<false>(&taxels, &pairs, terms);
            }
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
