//! Runs: the taxels of a row that belong to one label, mostly adjacent ones.

use super::bits::{WORD, widened};
use super::sums::RunSums;

/// The touched taxels of one row that belong to one label, within one word: a whole row, or [`WORD`] columns
/// of a longer one. They are one group of adjacent taxels or, if the label connects them elsewhere, several.
/// The groups are complete, except where they go on in a neighbouring word.
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
    /// Number of taxels.
    pub area: u16,
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

    /// Number of columns from the first to the last one.
    pub const fn width(&self) -> u16 {
        self.right - self.left + 1
    }

    /// True if its taxels are adjacent: there is no gap between the first and the last one.
    pub const fn is_whole(&self) -> bool {
        self.area == self.width()
    }

    /// Position of the word as one number, in the order of the runs.
    pub const fn key(&self) -> u32 {
        key(self.row, self.left)
    }

    /// True if the taxel in `column`, a column of its word, belongs to it.
    pub const fn holds(&self, column: u16) -> bool {
        self.taxels >> (column % WORD) & 1 == 1
    }

    /// Returns its taxels, with bit 0 for column `left`.
    pub const fn rebased(&self) -> u32 {
        self.taxels >> (self.left % WORD)
    }

    /// Returns its taxels in the columns `first ..= last`.
    pub const fn within(&self, first: u16, last: u16) -> u32 {
        self.taxels & columns(self.column(), first, last)
    }

    /// Taxels of the word that touch it, in the next row (corners included) or in its own.
    pub const fn reach(&self) -> u32 {
        widened(self.taxels)
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

/// The columns `first ..= last` of a row, as bits of the word that begins at `column`.
const fn columns(column: u16, first: u16, last: u16) -> u32 {
    let word = column as u32;
    let from = (first as u32).saturating_sub(word);
    let end = (last as u32 + 1).saturating_sub(word);
    // The bits below a place; all bits if the place is beyond the word.
    const fn below(place: u32) -> u32 {
        if place < WORD as u32 { (1 << place) - 1 } else { u32::MAX }
    }
    below(end) & !below(from)
}
