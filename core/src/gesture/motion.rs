//! Motion of a touch: whether its changes travel across the sheet or come and go in place. Measured by the
//! correlation of neighbouring cells' changes, and by the share of the changes that remains in the total.

use super::cells::{CELLS, Cells, SIDE};
use crate::format::{log2, wide};

/// Number of features of motion.
pub const MOTION: usize = 4;

/// Bound of a cell's change, so that the products of a frame sum up to 30 bits.
const MOST: i32 = 4095;

/// Counts that are added to sums before they are compared, so that the noise of a sheet at rest does not
/// show.
const REST: u64 = 20;

/// Sums over the frames of a touch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Motion {
    /// Sums of all cells' changes and of their squares.
    change: u64,
    squares: u64,
    /// Sums of the products of neighbours' changes, across and along the rows.
    across: i64,
    along: i64,
    /// Sums of the changes of the total and of their squares.
    net: u64,
    common: u64,
}

impl Default for Motion {
    fn default() -> Self {
        Motion::new()
    }
}

impl Motion {
    /// State before the first frame.
    pub const fn new() -> Motion {
        Motion { change: 0, squares: 0, across: 0, along: 0, net: 0, common: 0 }
    }

    /// Adds a frame that follows `before`; returns the change of all its cells.
    pub fn add(&mut self, now: &Cells, before: &Cells) -> u32 {
        let (mut change, mut net, mut common) = (0, 0i32, 0i32);
        let (mut squares, mut across, mut along) = (0, 0, 0);
        let mut above = [0; SIDE];
        for (now, before) in now.chunks_exact(SIDE).zip(before.chunks_exact(SIDE)) {
            let mut left = 0;
            for ((now, before), above) in now.iter().zip(before).zip(&mut above) {
                let exact = i32::from(*now) - i32::from(*before);
                let step = exact.clamp(-MOST, MOST);
                (change, net, common) = (change + exact.unsigned_abs(), net + exact, common + step);
                squares += step * step;
                across += step * *above;
                along += step * left;
                (*above, left) = (step, step);
            }
        }
        self.change += u64::from(change);
        self.net += u64::from(net.unsigned_abs());
        self.squares += squares as u64;
        self.across += i64::from(across);
        self.along += i64::from(along);
        self.common = self.common.wrapping_add(wide(common.unsigned_abs(), common.unsigned_abs()));
        change
    }

    /// Returns correlation of neighbours' changes across and along the rows (4096 is none, 8192 full), share
    /// of the changes that is common to the whole sheet (8192 is all), and ratio of the cells' change to the
    /// change of the total (log2, Q8).
    pub fn features(&self) -> [u16; MOTION] {
        let all = self.squares + REST / 2;
        // Scaled to 18 bits of the squares.
        let shift = (64 - all.leading_zeros()).saturating_sub(18);
        let scale = (all >> shift) as i32;
        let share = |sum: i64| (((sum >> shift) as i32) << 12).checked_div(scale).unwrap_or(0);
        let correlation = |sum: i64| share(sum).saturating_add(4096).clamp(0, 8192) as u16;
        let common = share((self.common / CELLS as u64) as i64).clamp(0, 4096) as u16;
        let still = log2(self.change + REST).saturating_sub(log2(self.net + REST));
        [correlation(self.across), correlation(self.along), 2 * common, still]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(frames: usize, cell: impl Fn(usize, usize, usize) -> u16) -> [u16; MOTION] {
        let mut motion = Motion::new();
        let cells = |frame| -> Cells { core::array::from_fn(|i| cell(frame, i % SIDE, i / SIDE)) };
        (1..frames).for_each(|frame| {
            motion.add(&cells(frame), &cells(frame - 1));
        });
        motion.features()
    }

    #[test]
    fn a_press_is_common_and_leaves_all_in_the_total() {
        let have = of(200, |frame, _, _| if frame % 20 < 10 { 900 } else { 100 });
        assert_eq!(have[2..], [8192, 0]);
        // Seven of eight cells have a neighbour that changes alike.
        assert!(have[..2].iter().all(|f| f.abs_diff(4096 + 3584) <= 1), "{have:?}");
    }

    #[test]
    fn a_line_that_wanders_changes_along_itself_and_little_in_the_total() {
        let have = of(200, |frame, x, _| if x == frame / 4 % SIDE { 1000 } else { 0 });
        assert!(have[0].abs_diff(4096 + 3584) <= 1, "{have:?}");
        // What one column loses, the next one gains, six times out of seven.
        assert!(have[1] < 4096 - 1700 && have[2] < 300 && have[3] > 8 * 256, "{have:?}");
    }

    #[test]
    fn neighbours_that_change_at_random_are_not_correlated() {
        let noise = |at: u32| {
            let once = (at ^ at >> 7).wrapping_mul(0x2c1b_3c6d);
            ((once ^ once >> 12).wrapping_mul(0x297a_2d39) >> 22) as u16
        };
        let have = of(400, |frame, x, y| noise((frame * 64 + y * SIDE + x) as u32));
        assert!(have[..2].iter().all(|f| f.abs_diff(4096) < 250) && have[2] < 700, "{have:?}");
    }

    #[test]
    fn nothing_overflows_and_rest_is_rest() {
        assert_eq!(of(1024, |frame, _, _| if frame % 2 == 0 { u16::MAX } else { 0 })[2..], [8192, 0]);
        let have = of(1024, |frame, x, y| if (frame + x + y) % 2 == 0 { u16::MAX } else { 0 });
        assert!(have[..2].iter().all(|f| f.abs_diff(512) <= 1) && have[2] == 0, "{have:?}");
        assert_eq!(of(100, |_, x, _| x as u16), [4096, 4096, 0, 0]);
    }
}
