//! Runs: adjacent touched taxels of a row.

use super::sums::RunSums;
use core::ops::RangeInclusive;

/// Columns of a word.
pub(crate) const WORD: u16 = u32::BITS as u16;

/// Adjacent touched taxels of one row, within one word of [`WORD`] columns. It is complete, except where it
/// goes on in a neighbouring word.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    /// Bit `i` stands for column `column + i`; not 0.
    pub taxels: u32,
    /// Row, counted over all panels.
    pub row: u16,
    /// Label under which it was found; the parent of that is the label that it belongs to.
    pub label: u16,
    /// First column of the run.
    pub left: u16,
    /// Last column of the run.
    pub right: u16,
    /// Greatest value, counts.
    pub peak: u16,
    /// Sums over the values, `i` counted from `left`.
    pub sums: RunSums,
}

impl Run {
    /// First column of the word.
    pub const fn column(&self) -> u16 {
        first_column(self.left)
    }

    /// Number of taxels.
    pub const fn width(&self) -> u16 {
        self.right - self.left + 1
    }

    /// Position of the word as one number, in the order of the runs.
    pub const fn key(&self) -> u32 {
        key(self.row, self.left)
    }

    /// Its columns among those of `first ..= last`; empty if there are none.
    pub fn within(&self, first: u16, last: u16) -> RangeInclusive<u16> {
        self.left.max(first)..=self.right.min(last)
    }
}

/// Position of a taxel's word as one number, in the order of the runs.
pub(crate) const fn key(row: u16, column: u16) -> u32 {
    (row as u32) << 16 | first_column(column) as u32
}

/// First column of a taxel's word.
const fn first_column(column: u16) -> u16 {
    column - column % WORD
}
