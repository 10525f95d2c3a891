//! Statistics of one signal over the frames of a touch.

use super::histogram::Histogram;
use crate::format::{log2, product, wide};

/// Lags over which change is measured, frames. A fast signal changes within short lags already.
pub const LAGS: [u8; 6] = [1, 2, 4, 8, 16, 32];

/// Number of features of a course.
pub const COURSE: usize = 6 + LAGS.len();

/// Sums over the frames of a touch, for values in 0 ..= 4095.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    squares: u64,
    sum: u32,
    /// Sum of the value times its frame number, from 0.
    moment: u32,
    least: u16,
    most: u16,
    /// Sum of the changes over each lag.
    changes: [u32; LAGS.len()],
    spread: Histogram<6>,
}

impl Default for Course {
    fn default() -> Self {
        Course::new()
    }
}

impl Course {
    /// State before the first frame. All bytes are 0.
    pub const fn new() -> Course {
        let changes = [0; LAGS.len()];
        Course { squares: 0, sum: 0, moment: 0, least: 0, most: 0, changes, spread: Histogram::new() }
    }

    /// Adds the value of a frame, at most 4095. `frame` is its number, from 0. `back` gives the values
    /// [`LAGS`] frames ago; those before the first frame are ignored.
    pub fn add(&mut self, value: u16, frame: u32, back: impl Iterator<Item = u16>) {
        let wide = u32::from(value);
        self.least = if frame == 0 { value } else { self.least.min(value) };
        self.most = self.most.max(value);
        self.sum = self.sum.wrapping_add(wide);
        self.squares = self.squares.wrapping_add((wide * wide).into());
        self.moment = self.moment.wrapping_add(frame.wrapping_mul(wide));
        for ((sum, lag), then) in self.changes.iter_mut().zip(LAGS).zip(back) {
            if u32::from(lag) <= frame {
                *sum = sum.wrapping_add(value.abs_diff(then).into());
            }
        }
        self.spread.add(value);
    }

    /// Returns the features of the `frames` so far, at least one and at most [`LONGEST`](super::LONGEST):
    /// mean, log2 of the variance (Q8), least and greatest value, trend (offset 4096), median, log2 of the
    /// mean change over each lag (Q8).
    pub fn features(&self, frames: u32) -> [u16; COURSE] {
        let count = frames.max(1);
        let variance = product(count.into(), self.squares).saturating_sub(wide(self.sum, self.sum));
        let log = log2(variance).saturating_sub(2 * log2(u64::from(count) - 1));
        // The mean of value times time about the middle: for a straight line, a sixth of its whole change.
        // Both products are below 2^32 for values below 2^12 and times of up to 2^10.
        let (twice, middle) = (self.moment.wrapping_mul(2), self.sum.wrapping_mul(count - 1));
        let lean = (twice.abs_diff(middle) >> 8) / ((count * count) >> 8).max(1);
        let trend = if twice < middle { 4096u32.saturating_sub(lean) } else { lean.saturating_add(4096) };
        let [median] = self.spread.percentiles(&[128], count);
        let mean = (self.sum / count) as u16;
        let mut features = [0; COURSE];
        let levels = [mean, log, self.least, self.most, trend.min(u16::MAX.into()) as u16, median];
        let changes = self.changes.into_iter().zip(LAGS).map(|(sum, lag)| {
            let pairs = count.saturating_sub(lag.into());
            log2(u64::from(sum) << 4).saturating_sub(log2(pairs.into()))
        });
        features.iter_mut().zip(levels.into_iter().chain(changes)).for_each(|(place, value)| *place = value);
        features
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use std::vec::Vec;

    fn of(values: &[u16]) -> [u16; COURSE] {
        let mut course = Course::default();
        for (frame, value) in values.iter().enumerate() {
            let back = LAGS.map(|lag| frame.checked_sub(lag.into()).map_or(0, |then| values[then]));
            course.add(*value, frame as u32, back.into_iter());
        }
        course.features(values.len() as u32)
    }

    #[test]
    fn a_rising_line() {
        let values: Vec<u16> = (0..401).map(|i| 1000 + 5 * i).collect();
        let have = of(&values);
        assert_eq!((have[0], have[2], have[3]), (2000, 1000, 3000));
        // 2000 / sqrt(12) squared; a sixth of 2000.
        assert!(have[1].abs_diff((335_000f64.log2() * 256.0) as u16) < 8, "{have:?}");
        assert!(have[4].abs_diff(4096 + 333) < 9 && have[5].abs_diff(2000) < 70, "{have:?}");
        for (change, lag) in have[6..].iter().zip(LAGS) {
            let exact = (f64::from(lag) * 5.0 * 16.0).log2() * 256.0;
            assert!((f64::from(*change) - exact).abs() < 6.0, "lag {lag}: {change} of {exact}");
        }
        let falling: Vec<u16> = values.into_iter().rev().collect();
        assert!(of(&falling)[4].abs_diff(4096 - 333) < 9);
    }

    #[test]
    fn a_rhythm_returns_after_its_period() {
        let values: Vec<u16> = (0..320).map(|i| if i % 8 < 4 { 100 } else { 3100 }).collect();
        let have = of(&values);
        assert!(have[6 + 3] == 0 && have[6 + 2] > 15 * 256, "{have:?}");
    }

    #[test]
    fn a_touch_of_one_frame_and_the_longest() {
        assert_eq!(of(&[7])[..5], [7, 0, 7, 7, 4096]);
        let have = of(&[4095; super::super::LONGEST as usize]);
        assert_eq!((have[0], have[1], have[4]), (4095, 0, 4096));
        let rising: Vec<u16> = (0..super::super::LONGEST as u16).map(|i| 4 * i).collect();
        assert!(of(&rising)[4].abs_diff(4096 + 682) < 9);
    }
}
