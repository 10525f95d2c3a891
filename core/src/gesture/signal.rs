//! Reduction of a frame to eight signals.

use super::cells::{Cells, SIDE};
use crate::format::log2;

/// Number of signals of a frame.
pub const SIGNALS: usize = 8;

/// Names of the signals, in their order.
pub const NAMES: [&str; SIGNALS] = ["total", "peak", "area", "x", "y", "spread", "anisotropy", "change"];

/// Signals of a frame, each in 0 ..= 4095: log2 of total and of peak (Q8), cells above `pressed` (Q6),
/// centroid (cells, Q9 of eight), spread about it (cells squared, Q7), anisotropy (Q11), log2 of the change
/// of all cells since the frame before (Q8).
pub type Signals = [u16; SIGNALS];

/// Returns the total and the signals of a frame whose cells have changed by `change`; a cell above `pressed`
/// counts as touched.
pub fn signals(cells: &Cells, change: u32, pressed: u16) -> (u32, Signals) {
    let (mut peak, mut area) = (0, 0);
    for cell in cells {
        peak = peak.max(*cell);
        area += u16::from(*cell > pressed);
    }
    let sums = SheetSums::of(cells);
    let [x, y, spread, anisotropy] = sums.form();
    let (total, peak, change) = (log2(sums.m.into()), log2(peak.into()), log2(change.into()));
    let all = [total, peak, area << 6, x, y, spread, anisotropy, change];
    // log2 of 22 bits in Q8, and 64 cells in Q6, are 4,096 at most.
    (sums.m, all.map(|signal| signal.min(4095)))
}

/// Sums over the cells; at most 64 x 65,535 x 49: 28 bits.
struct SheetSums {
    m: u32,
    x: u32,
    y: u32,
    xx: u32,
    yy: u32,
    xy: u32,
}

impl SheetSums {
    fn of(cells: &Cells) -> SheetSums {
        let mut sums = SheetSums { m: 0, x: 0, y: 0, xx: 0, yy: 0, xy: 0 };
        for (row, y) in cells.chunks_exact(SIDE).zip(0u32..) {
            let (mut m, mut sx) = (0, 0);
            for (value, x) in row.iter().zip(0u32..) {
                let value = u32::from(*value);
                m += value;
                sx += x * value;
                sums.xx += x * x * value;
            }
            sums.m += m;
            sums.x += sx;
            sums.y += y * m;
            sums.yy += y * y * m;
            sums.xy += y * sx;
        }
        sums
    }

    /// Returns x, y, spread, anisotropy. Sixteen counts are added in the middle of the sheet, so that the
    /// centroid of an untouched sheet does not jump.
    fn form(&self) -> [u16; 4] {
        // The sums are scaled to 17 bits of mass, so that all that follows fits in 32 bits.
        let m = self.m + REST;
        let shift = (31 - m.leading_zeros()).saturating_sub(16);
        let rest = |sum: u32, share: u32| (sum + REST * share / 4) >> shift;
        let m = (m >> shift).max(1);
        // The middle is 3.5: 14 / 4, and 3.5^2 = 49 / 4.
        let mean = |sum: u32| ((sum << 9) / m) as i32;
        let (x, y) = (mean(rest(self.x, 14)), mean(rest(self.y, 14)));
        let second = |sum: u32, a: i32, b: i32| mean(rest(sum, 49)) - ((a * b) >> 9);
        let (xx, yy, xy) = (second(self.xx, x, x), second(self.yy, y, y), second(self.xy, x, y));
        let spread = (xx + yy).max(0);
        let (lean, skew) = ((xx - yy).unsigned_abs(), 2 * xy.unsigned_abs());
        // The longer leg plus three eighths of the shorter: the hypotenuse to 7 %.
        let long = lean.max(skew) + lean.min(skew) * 3 / 8;
        let anisotropy = (long << 11) / (spread as u32 + 32);
        [x.max(0) as u16, y.max(0) as u16, (spread >> 2).min(4095) as u16, anisotropy.min(4095) as u16]
    }
}

/// Counts added in the middle of the sheet.
const REST: u32 = 16;

#[cfg(test)]
mod tests {
    use super::*;

    fn at(places: &[(usize, usize)], value: u16) -> Cells {
        let mut cells = [0; 64];
        places.iter().for_each(|(x, y)| cells[y * SIDE + x] = value);
        cells
    }

    #[test]
    fn a_press_on_one_cell() {
        let (total, have) = signals(&at(&[(2, 6)], 60_000), 60_000, 10);
        // log2(60,000) is 15.87.
        assert!(have[0].abs_diff(4063) <= 3 && have[1] == have[0] && have[2] == 64, "{have:?}");
        assert!(have[3].abs_diff(1024) < 4 && have[4].abs_diff(3072) < 4 && have[5] < 8, "{have:?}");
        assert!(have[7] == have[0] && total == 60_000, "{have:?}");
    }

    #[test]
    fn a_line_is_anisotropic_and_a_square_is_not() {
        let line: [(usize, usize); 8] = core::array::from_fn(|x| (x, 3));
        let (_, have) = signals(&at(&line, 9000), 0, 10);
        // The variance of eight places is 5.25.
        assert!(have[5].abs_diff((5.25 * 128.0) as u16) < 4 && have[6] > 1900 && have[7] == 0, "{have:?}");
        let (_, square) = signals(&at(&[(0, 0), (7, 0), (0, 7), (7, 7)], 9000), 0, 10);
        assert!(square[6] < 20, "{square:?}");
    }

    #[test]
    fn nothing_overflows() {
        for cells in [[0; 64], [u16::MAX; 64], [1; 64]] {
            let (_, have) = signals(&cells, 64 * 65_535, 0);
            assert!(have.iter().all(|signal| *signal < 4096));
            assert_eq!((have[3], have[4]), (1792, 1792));
        }
    }
}
