//! Statistics of each cell of the sheet over the frames of a touch.

use super::cells::{CELLS, Cells};
use super::histogram::Histogram;
use crate::format::{log2, product, wide};

/// Number of features of a grid.
pub const GRID: usize = 4 * RANKED;

/// Number of features of one kind of sums.
const RANKED: usize = SHARES.len() + 1;

/// Percentiles of the cells that are features, in 256ths; denser towards the top.
const SHARES: [u16; 4] = [0, 172, 232, 252];

/// Sums of each cell over the frames.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid {
    cells: [Cell; CELLS],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Cell {
    squares: u64,
    sum: u32,
    change: u32,
    most: u16,
}

impl Default for Grid {
    fn default() -> Self {
        Grid::new()
    }
}

impl Grid {
    /// State before the first frame.
    pub const fn new() -> Grid {
        Grid { cells: [Cell { squares: 0, sum: 0, change: 0, most: 0 }; CELLS] }
    }

    /// Adds a frame that follows `before`; for the first frame both are the same.
    pub fn add(&mut self, now: &Cells, before: &Cells) {
        for ((cell, now), before) in self.cells.iter_mut().zip(now).zip(before) {
            let value = u32::from(*now);
            cell.sum = cell.sum.wrapping_add(value);
            cell.squares = cell.squares.wrapping_add((value * value).into());
            cell.most = cell.most.max(*now);
            cell.change = cell.change.wrapping_add(now.abs_diff(*before).into());
        }
    }

    /// Returns the features of the `frames` so far. For each of mean, variance, greatest value and change of
    /// the cells: log2 (Q8) of percentiles among the cells, and log2 (Q8) of the number of cells that share
    /// in it.
    pub fn features(&self, frames: u32) -> [u16; GRID] {
        let count = u64::from(frames.max(1));
        let log = log2(count - 1);
        // Sums have 26 bits.
        let means = self.ranked(|cell| (cell.sum << 4).into(), log);
        let spread = |cell: &Cell| product(count, cell.squares).saturating_sub(wide(cell.sum, cell.sum));
        let variances = self.ranked(spread, 2 * log);
        let peaks = self.ranked(|cell| (u32::from(cell.most) << 4).into(), 0);
        let changes = self.ranked(|cell| (cell.change << 4).into(), log);
        let mut features = [0; GRID];
        let kinds = [means, variances, peaks, changes];
        features.iter_mut().zip(kinds.iter().flatten()).for_each(|(place, feature)| *place = *feature);
        features
    }

    fn ranked(&self, value: impl Fn(&Cell) -> u64, scale: u16) -> [u16; RANKED] {
        let mut ranks = Histogram::<6>::default();
        let (mut sum, mut squares) = (0u64, 0u64);
        for cell in &self.cells {
            let value = value(cell);
            ranks.add(log2(value).saturating_sub(scale));
            // Variances have 50 bits: scaled down, so that their squares and the sum of these fit.
            let small = (value >> 8).min(u32::MAX.into()) as u32;
            sum = sum.wrapping_add(small.into());
            let square = if small >> 16 == 0 { (small * small).into() } else { wide(small, small) };
            squares = squares.wrapping_add(square >> 8);
        }
        let sharing = (2 * log2(sum)).saturating_sub(log2(squares)).saturating_sub(8 << 8);
        let mut features = [sharing; RANKED];
        let ranks = ranks.percentiles(&SHARES, CELLS as u32);
        features.iter_mut().zip(ranks).for_each(|(place, rank)| *place = rank);
        features
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_and_the_number_of_cells_that_share() {
        let mut grid = Grid::default();
        let now: Cells = core::array::from_fn(|i| if i < 16 { 1000 } else { 0 });
        (0..100).for_each(|_| grid.add(&now, &now));
        let have = grid.features(100);
        let log = 16_000f64.log2() * 256.0;
        assert!((f64::from(have[3]) - log).abs() < 64.0 && have[0] < 64, "{have:?}");
        assert!(have[4].abs_diff(4 * 256) < 8, "{have:?}");
        assert!(have[5..10].iter().all(|f| *f < 64) && have[15..20].iter().all(|f| *f < 64), "{have:?}");
    }

    #[test]
    fn nothing_overflows() {
        let mut grid = Grid::default();
        for frame in 0..super::super::LONGEST {
            let now = [if frame % 2 == 0 { u16::MAX } else { 0 }; CELLS];
            grid.add(&now, &now.map(|v| !v));
        }
        let have = grid.features(super::super::LONGEST);
        assert!(have[4].abs_diff(6 * 256) < 8 && have[19].abs_diff(6 * 256) < 8, "{have:?}");
    }
}
