//! The conditioned image, and which of its rows are worth a look.

use crate::garment::{Area, Layout};
use core::ops::Range;

const WORDS: usize = 32;

/// A set of rows, by their number over all panels ([`Area::first_row`]` + row`). Rows from 1023 on share one entry, so
/// that it answers "may hold something" for any garment and "holds nothing" only where that is true.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows([u32; WORDS]);

impl Rows {
    /// No row.
    pub const NONE: Rows = Rows([0; WORDS]);
    /// Every row.
    pub const ALL: Rows = Rows([u32::MAX; WORDS]);

    /// The rows of `values` (by taxel number) that hold anything but 0.
    pub fn of(layout: &Layout, values: &[u16]) -> Rows {
        let mut rows = Rows::NONE;
        for area in layout.areas() {
            for row in 0..area.rows {
                if row_of(values, area, row).iter().any(|v| *v != 0) {
                    rows.insert(area.first_row.saturating_add(row));
                }
            }
        }
        rows
    }

    /// Adds a row.
    pub const fn insert(&mut self, row: u16) {
        let (word, bit) = Rows::at(row);
        self.0[word] |= bit;
    }

    /// Whether the row, or one that shares its entry, is in the set.
    pub const fn contains(&self, row: u16) -> bool {
        let (word, bit) = Rows::at(row);
        self.0[word] & bit != 0
    }

    /// Whether no row is in the set.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }

    const fn at(row: u16) -> (usize, u32) {
        let row = if row > 1023 { 1023 } else { row };
        ((row / 32) as usize % WORDS, 1 << (row % 32))
    }
}

/// Pressure by taxel number.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    /// Counts above the baseline, by taxel number.
    pub values: &'a [u16],
    /// The rows that may hold something; all others are 0.
    pub rows: &'a Rows,
}

impl<'a> Image<'a> {
    /// Row `row` of a panel, column by column; empty if the row may not hold anything or does not exist.
    pub fn row(&self, area: &Area, row: u16) -> &'a [u16] {
        if row < area.rows && self.rows.contains(area.first_row.saturating_add(row)) {
            row_of(self.values, area, row)
        } else {
            &[]
        }
    }

    /// The columns of a row that may hold something; all others are 0. Empty if the row holds nothing or does not exist.
    pub fn span(&self, area: &Area, row: u16) -> Range<u16> {
        if row < area.rows && self.rows.contains(area.first_row.saturating_add(row)) {
            0..area.columns
        } else {
            0..0
        }
    }
}

/// First taxel number and length of a row.
fn span(area: &Area, row: u16) -> (usize, usize) {
    let columns = usize::from(area.columns);
    (usize::from(area.base) + usize::from(row) * columns, columns)
}

/// The part of a slice by taxel number that is one row of a panel; shorter, or empty, where the slice ends.
pub(crate) fn row_of<'a, T>(values: &'a [T], area: &Area, row: u16) -> &'a [T] {
    let (start, columns) = span(area, row);
    let rest = values.get(start..).unwrap_or(&[]);
    rest.get(..columns).unwrap_or(rest)
}

/// As [`row_of`], to write.
pub(crate) fn row_mut<'a, T>(values: &'a mut [T], area: &Area, row: u16) -> &'a mut [T] {
    let (start, columns) = span(area, row);
    let rest = values.get_mut(start..).unwrap_or(&mut []);
    let length = rest.len().min(columns);
    rest.get_mut(..length).unwrap_or(&mut [])
}
