//! Samples images at even times: at each the last one so far.
//!
//! If the time leaps, because the link was lost, the board restarted or its clock is invalid, nothing is
//! known about the gap: it gets no rows, and the next image is in the next row.

use std::num::NonZeroU16;

/// Longest time represented by one image, us: twice that of the slowest stream, one image per second.
const LONGEST_US: u64 = 2_000_000;
const SECOND_US: u128 = 1_000_000;

/// Assigns images to rows.
#[derive(Debug)]
pub struct Sampler {
    fps: u64,
    /// Time of the last image, and of the first since the last leap, us.
    times: Option<[u64; 2]>,
    /// Row of the first image since the last leap.
    first: u64,
    /// Next row.
    row: u64,
    leaps: u64,
}

impl Sampler {
    /// A sampler with `fps` rows per second, the first at the first image.
    pub fn new(fps: NonZeroU16) -> Sampler {
        Sampler { fps: fps.get().into(), times: None, first: 0, row: 0, leaps: 0 }
    }

    /// Number of leaps in time.
    pub fn leaps(&self) -> u64 {
        self.leaps
    }

    /// Rows whose time is before `now_us`, or equal to it if `last`; they hold the image before.
    pub fn passed(&mut self, now_us: u64, last: bool) -> std::ops::Range<u64> {
        let [before, began] = *self.times.get_or_insert([now_us; 2]);
        let leaps = now_us.checked_sub(before).is_none_or(|passed| passed > LONGEST_US);
        // The image before a leap has its last row at its own time.
        let rows = if leaps { self.rows(before, began, true) } else { self.rows(now_us, began, last) };
        self.row = rows.end;
        if leaps {
            (self.first, self.leaps) = (self.row, self.leaps + 1);
        }
        self.times = Some([now_us, if leaps { now_us } else { began }]);
        rows
    }

    /// Row n is at n / fps; the row exactly at the time of an image is this image's.
    fn rows(&self, now_us: u64, began: u64, last: bool) -> std::ops::Range<u64> {
        let passed = u128::from(now_us.saturating_sub(began)) * u128::from(self.fps);
        let end = if last { passed / SECOND_US + 1 } else { passed.div_ceil(SECOND_US) };
        let end = self.first.saturating_add(u64::try_from(end).unwrap_or(u64::MAX));
        self.row..end.max(self.row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_the_last_image_at_its_time() {
        let mut sampler = Sampler::new(NonZeroU16::new(100).unwrap());
        assert_eq!(sampler.passed(5_000, false), 0..0);
        assert_eq!(sampler.passed(5_001, false), 0..1, "the first image stands in the first row");
        assert_eq!(sampler.passed(15_000, false), 1..1, "the image of just then is its row's");
        assert_eq!(sampler.passed(36_000, false), 1..4);
        assert_eq!(sampler.passed(45_000, true), 4..5, "the last image ends the episode");
        assert_eq!(sampler.passed(3, false), 5..5, "time that went back gives nothing");
        assert_eq!((sampler.passed(10_003, false), sampler.leaps()), (5..6, 1), "and goes on from there");
    }

    #[test]
    fn a_leap_fills_no_rows() {
        let mut sampler = Sampler::new(NonZeroU16::new(u16::MAX).unwrap());
        let mut rows = 0;
        for time in [0, u64::MAX, 1, 1 << 63, u64::MAX - 1, u64::MAX, 5, 2_000_005, 4_000_006] {
            rows += sampler.passed(time, false).count();
        }
        rows += sampler.passed(4_000_006, true).count();
        // An image before each leap, and the two seconds without images.
        assert_eq!((sampler.leaps(), rows), (6, 7 + 2 * usize::from(u16::MAX)));
    }
}
