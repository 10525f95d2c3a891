//! Rhythm of a touch: the change of its total, by octaves of time.

use crate::format::log2;

/// Number of octaves: time constants of 2 to 64 frames.
pub const BANDS: usize = 6;

/// Fraction bits of a level: the total has 22 bits.
const FRACTION: u32 = 8;

/// Cascade of low-passes: each filters the output of the one before, at twice its time constant. The
/// difference of the two is an octave.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bands {
    levels: [i32; BANDS],
    /// Sums of what each low-pass removes, Q4.
    sums: [u64; BANDS],
}

impl Default for Bands {
    fn default() -> Self {
        Bands::new()
    }
}

impl Bands {
    /// State before the first frame.
    pub const fn new() -> Bands {
        Bands { levels: [0; BANDS], sums: [0; BANDS] }
    }

    /// Adds the total of a frame, less than 2^22; `frame` is its number, from 0. The first total counts as
    /// that of all frames before.
    pub fn add(&mut self, total: u32, frame: u32) {
        let mut input = (total << FRACTION) as i32;
        if frame == 0 {
            self.levels = [input; BANDS];
        }
        for ((level, sum), octave) in self.levels.iter_mut().zip(&mut self.sums).zip(1u32..) {
            *level += (input - *level) >> octave;
            *sum = sum.wrapping_add((input.abs_diff(*level) >> (FRACTION - 4)).into());
            input = *level;
        }
    }

    /// Ratio of the strongest octave to each octave, the fastest first: log2, Q8.
    pub fn features(&self) -> [u16; BANDS] {
        let logs = self.sums.map(log2);
        let most = logs.into_iter().max().unwrap_or(0);
        logs.map(|log| most.saturating_sub(log))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(frames: u32, total: impl Fn(u32) -> u32) -> [u16; BANDS] {
        let mut bands = Bands::new();
        (0..frames).for_each(|frame| bands.add(total(frame), frame));
        bands.features()
    }

    #[test]
    fn the_octave_of_a_rhythm_is_the_strongest() {
        for (period, strongest) in [(2, 0), (8, 1), (24, 2), (64, 3), (200, 4)] {
            let have = of(400, |frame| if frame % period < period / 2 { 4_000_000 } else { 1000 });
            assert_eq!(have.iter().position(|below| *below == 0), Some(strongest), "{period}: {have:?}");
        }
    }

    #[test]
    fn against_floats() {
        let total = |frame: u32| 40_000 + frame * frame * 7919 % 30_000;
        let (mut levels, mut sums) = ([40_000.0; BANDS], [0.0; BANDS]);
        for frame in 0..300 {
            let mut input = f64::from(total(frame));
            for (octave, (level, sum)) in levels.iter_mut().zip(&mut sums).enumerate() {
                *level += (input - *level) / f64::from(2 << octave);
                *sum += (input - *level).abs();
                input = *level;
            }
        }
        let most = sums.iter().copied().fold(0.0, f64::max);
        for (have, sum) in of(300, total).into_iter().zip(sums) {
            let exact = (most / sum).log2() * 256.0;
            assert!((f64::from(have) - exact).abs() < 8.0, "{have} of {exact}");
        }
    }

    #[test]
    fn a_still_total_and_the_greatest_have_no_rhythm() {
        assert_eq!(of(100, |_| 4_194_240), [0; BANDS]);
        of(1024, |frame| if frame % 2 == 0 { 4_194_240 } else { 0 });
    }
}
