//! How one number of the frames ran over a window.

use super::histogram::Histogram;
use super::log::log2;

/// The distances in time, in frames, over which change is measured. What changes fast changes over few frames already:
/// together they tell what a spectrum tells.
pub const LAGS: [u8; 12] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40, 48];

/// Features of a course.
pub const COURSE: usize = 27;

/// Of 256: the shares below the percentiles that are features.
const SHARES: [u16; 7] = [13, 26, 64, 128, 192, 230, 243];

/// Sums over the frames of a window.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    sum: u32,
    squares: u64,
    /// Sum of the value times the number of its frame, from 0.
    moment: u64,
    first: u16,
    last: u16,
    least: u16,
    most: u16,
    /// Sum of the changes over each lag.
    changes: [u32; LAGS.len()],
    /// How often the value crossed its running mean.
    crossings: u16,
    /// The running mean over 16 frames, Q4.
    mean: u32,
    above: bool,
    spread: Histogram<6>,
}

impl Default for Course {
    fn default() -> Self {
        Course::new()
    }
}

impl Course {
    /// No frame yet.
    pub const fn new() -> Course {
        Course {
            sum: 0,
            squares: 0,
            moment: 0,
            first: 0,
            last: 0,
            least: 0,
            most: 0,
            changes: [0; LAGS.len()],
            crossings: 0,
            mean: 0,
            above: false,
            spread: Histogram::new(),
        }
    }

    /// Adds the value of a frame. `frame` is its number in the window, from 0; `back` are the values as many frames before
    /// as [`LAGS`] says, of which those count that lie in the window.
    pub fn add(&mut self, value: u16, frame: u32, back: impl Iterator<Item = u16>) {
        let wide = u32::from(value);
        if frame == 0 {
            (self.first, self.least, self.most, self.mean) = (value, value, value, wide << 4);
        }
        self.last = value;
        self.least = self.least.min(value);
        self.most = self.most.max(value);
        self.sum = self.sum.wrapping_add(wide);
        self.squares = self.squares.wrapping_add((wide * wide).into());
        self.moment = self.moment.wrapping_add(u64::from(frame) * u64::from(value));
        for ((sum, lag), then) in self.changes.iter_mut().zip(LAGS).zip(back) {
            if u32::from(lag) <= frame {
                *sum = sum.wrapping_add(value.abs_diff(then).into());
            }
        }
        let above = (wide << 4) > self.mean;
        self.crossings = self.crossings.wrapping_add((above != self.above).into());
        self.above = above;
        self.mean = self.mean + wide - (self.mean >> 4);
        self.spread.add(value);
    }

    /// The features of the `frames` so far, at least one and at most [`LONGEST`](super::LONGEST): mean, log2 of the
    /// variance (Q8), first, last, least and greatest value, trend (about 4096), percentiles, log2 of the mean change over
    /// each lag (Q8), crossings of the running mean in 4096 frames.
    pub fn features(&self, frames: u32) -> [u16; COURSE] {
        let count = frames.max(1);
        let mut features = [0; COURSE];
        let mut out = features.iter_mut();
        let mut put = |feature: u32| {
            if let Some(place) = out.next() {
                *place = feature.min(u16::MAX.into()) as u16;
            }
        };
        put(self.sum / count);
        let square = u64::from(self.sum) * u64::from(self.sum);
        let variance = (u64::from(count) * self.squares).saturating_sub(square);
        put(log2(variance).saturating_sub(2 * log2(u64::from(count) - 1)).into());
        [self.first, self.last, self.least, self.most].into_iter().for_each(|value| put(value.into()));
        // The mean of value times time about the middle, of which the whole change of a straight line is six times.
        let middle = u64::from(self.sum) * u64::from(count - 1);
        let lean = ((2 * self.moment) as i64 - middle as i64) >> 8;
        let trend = lean.unsigned_abs() as u32 / ((count * count) >> 8).max(1);
        put(if lean < 0 { 4096u32.saturating_sub(trend) } else { trend.saturating_add(4096) });
        self.spread.percentiles(&SHARES, count).into_iter().for_each(|value| put(value.into()));
        for (sum, lag) in self.changes.into_iter().zip(LAGS) {
            let pairs = count.saturating_sub(lag.into());
            put(log2(u64::from(sum) << 4).saturating_sub(log2(u64::from(pairs))).into());
        }
        put((u32::from(self.crossings) << 12) / count);
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
        assert_eq!((have[0], have[2], have[3], have[4], have[5]), (2000, 1000, 3000, 1000, 3000));
        // 2000 / sqrt(12) squared; a sixth of 2000.
        assert!(have[1].abs_diff((335_000f64.log2() * 256.0) as u16) < 8, "{have:?}");
        assert!(have[6].abs_diff(4096 + 333) < 9 && have[10].abs_diff(2000) < 70, "{have:?}");
        for (change, lag) in have[14..26].iter().zip(LAGS) {
            let exact = (f64::from(lag) * 5.0 * 16.0).log2() * 256.0;
            assert!(f64::from(*change).round() - exact < 6.0, "lag {lag}: {change} of {exact}");
        }
        assert_eq!(have[26], (1u32 << 12) as u16 / 401);
    }

    #[test]
    fn a_rhythm_crosses_its_mean_and_returns_after_its_period() {
        let values: Vec<u16> = (0..320).map(|i| if i % 8 < 4 { 100 } else { 3100 }).collect();
        let have = of(&values);
        assert_eq!(have[14 + 5], 0);
        assert!(have[26].abs_diff(1024) < 60 && have[14 + 3] > 15 * 256, "{have:?}");
    }

    #[test]
    fn a_window_of_one_frame_and_the_longest() {
        assert_eq!(of(&[7])[..7], [7, 0, 7, 7, 7, 7, 4096]);
        let have = of(&[4095; super::super::LONGEST as usize]);
        assert_eq!((have[0], have[1], have[6]), (4095, 0, 4096));
    }
}
