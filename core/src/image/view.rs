//! The conditioned image.

use super::rows::{self, Rows};
use super::slices::row_of;
use crate::garment::Area;
use core::ops::Range;

/// Pressure image.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    /// Counts above the baseline, by taxel number.
    pub values: &'a [u16],
    /// Rows, and columns of each, that may be non-zero; all others are 0.
    pub rows: &'a Rows,
}

impl<'a> Image<'a> {
    /// Row `row` of a panel, column by column; empty if the row is zero or does not exist.
    pub fn row(&self, area: &Area, row: u16) -> &'a [u16] {
        if row < area.rows && self.rows.contains(area.first_row.saturating_add(row)) {
            row_of(self.values, area, row)
        } else {
            &[]
        }
    }

    /// Columns of a row that may be non-zero; all others are 0. Empty if the row is zero or does not exist.
    pub fn span(&self, area: &Area, row: u16) -> Range<u16> {
        let groups = if row < area.rows { self.rows.groups(area.first_row.saturating_add(row)) } else { 0 };
        rows::span(area, groups)
    }
}
