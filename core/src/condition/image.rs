//! The conditioned image.

use super::rows::{self, Rows};
use crate::garment::Area;
use core::ops::Range;

/// Pressure by taxel number.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    /// Counts above the baseline, by taxel number.
    pub values: &'a [u16],
    /// The rows, and columns of each, that may hold something; all others are 0.
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
        let groups = if row < area.rows { self.rows.groups(area.first_row.saturating_add(row)) } else { 0 };
        rows::span(area, groups)
    }
}

/// First taxel number and length of a row.
fn place(area: &Area, row: u16) -> (usize, usize) {
    let columns = usize::from(area.columns);
    (usize::from(area.base) + usize::from(row) * columns, columns)
}

/// The part of a slice by taxel number that is one row of a panel; shorter, or empty, where the slice ends.
pub(crate) fn row_of<'a, T>(values: &'a [T], area: &Area, row: u16) -> &'a [T] {
    let (start, columns) = place(area, row);
    let rest = values.get(start..).unwrap_or(&[]);
    rest.get(..columns).unwrap_or(rest)
}

/// As [`row_of`], to write.
pub(crate) fn row_mut<'a, T>(values: &'a mut [T], area: &Area, row: u16) -> &'a mut [T] {
    let (start, columns) = place(area, row);
    let rest = values.get_mut(start..).unwrap_or(&mut []);
    let length = rest.len().min(columns);
    rest.get_mut(..length).unwrap_or(&mut [])
}

/// The part of a slice by taxel number that is one panel; shorter, or empty, where the slice ends.
pub(super) fn panel_of<'a, T>(values: &'a [T], area: &Area) -> &'a [T] {
    let rest = values.get(usize::from(area.base)..).unwrap_or(&[]);
    rest.get(..usize::from(area.rows) * usize::from(area.columns)).unwrap_or(rest)
}

/// As [`panel_of`], to write.
pub(super) fn panel_mut<'a, T>(values: &'a mut [T], area: &Area) -> &'a mut [T] {
    let rest = values.get_mut(usize::from(area.base)..).unwrap_or(&mut []);
    let length = rest.len().min(usize::from(area.rows) * usize::from(area.columns));
    rest.get_mut(..length).unwrap_or(&mut [])
}
