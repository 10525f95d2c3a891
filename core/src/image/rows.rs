//! Parts of an image that may be non-zero.

use super::row_set::{ENTRIES, RowSet, SHARED, entry};
use super::slices::row_of;
use crate::garment::{Area, Layout};
use core::ops::Range;

/// Bits of an entry.
const GROUPS: u32 = 16;

/// The columns of each row, by its number over all panels ([`Area::first_row`]` + row`), that may be
/// non-zero. All others are 0.
///
/// A row has one bit for each of 16 groups of columns: with up to 16 columns each has its own. Rows from 255
/// on share one entry, so that any garment is covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    groups: [u16; ENTRIES],
    /// Rows with at least one group.
    held: RowSet,
}

impl Rows {
    /// No row.
    pub const NONE: Rows = Rows { groups: [0; ENTRIES], held: RowSet::NONE };
    /// Every column of every row.
    pub const ALL: Rows = Rows { groups: [u16::MAX; ENTRIES], held: RowSet::ALL };

    /// The places where `values` (by taxel number) are not 0.
    pub fn of(layout: &Layout, values: &[u16]) -> Rows {
        let mut rows = Rows::NONE;
        for area in layout.areas() {
            let grain = grain(area);
            for row in 0..area.rows {
                let held = row_of(values, area, row).iter().enumerate().filter(|(_, value)| **value != 0);
                let groups = held.fold(0, |all, (column, _)| all | 1u16 << (column >> grain));
                rows.add(area.first_row.saturating_add(row), groups);
            }
        }
        rows
    }

    /// True if the row, or one that shares its entry, may be non-zero.
    pub const fn contains(&self, row: u16) -> bool {
        self.groups(row) != 0
    }

    /// True if the whole image is zero.
    pub fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// First row of the range that may be non-zero.
    pub const fn next(&self, rows: Range<u16>) -> Option<u16> {
        self.held.next(rows)
    }

    /// Rows that may be non-zero.
    pub(crate) const fn held(&self) -> &RowSet {
        &self.held
    }

    /// Groups of columns of a row that may be non-zero.
    pub(crate) const fn groups(&self, row: u16) -> u16 {
        self.groups[entry(row)]
    }

    pub(crate) const fn add(&mut self, row: u16, groups: u16) {
        let entry = entry(row);
        self.groups[entry] |= groups;
        if groups != 0 {
            self.held.add(entry);
        }
    }

    /// Groups of some rows, if none of them shares an entry. Rows whose groups are set must be
    /// [held](Rows::hold).
    pub(crate) fn places(&mut self, rows: Range<u16>) -> Option<&mut [u16]> {
        self.groups.get_mut(..SHARED)?.get_mut(usize::from(rows.start)..usize::from(rows.end))
    }

    /// Holds some rows, none of which shares an entry.
    pub(crate) fn hold(&mut self, rows: Range<usize>) {
        self.held.add_run(rows);
    }

    /// Releases and returns all rows; their groups stay.
    pub(crate) fn release(&mut self) -> RowSet {
        core::mem::replace(&mut self.held, RowSet::NONE)
    }

    /// Adds groups to a row that has some.
    pub(crate) const fn widen(&mut self, row: u16, groups: u16) {
        self.groups[entry(row)] |= groups;
    }

    /// Replaces the groups of a row, or adds to them if others share its entry.
    pub(crate) const fn set(&mut self, row: u16, groups: u16) {
        if entry(row) != SHARED {
            self.forget(entry(row));
        }
        self.add(row, groups);
    }

    /// Clears the entry that many rows share.
    pub(crate) const fn forget_shared(&mut self) {
        self.forget(SHARED);
    }

    const fn forget(&mut self, entry: usize) {
        self.groups[entry] = 0;
        self.held.remove(entry);
    }
}

/// Columns per group, log2.
pub(crate) fn grain(area: &Area) -> u32 {
    let mut grain = 0;
    while area.columns.saturating_sub(1) >> grain >= GROUPS as u16 {
        grain += 1;
    }
    grain
}

/// Groups of a non-empty range of columns.
pub(crate) const fn columns_as_groups(columns: Range<usize>, grain: u32) -> u16 {
    let (first, last) = (columns.start >> grain, (columns.end - 1) >> grain);
    u16::MAX << first & u16::MAX >> (GROUPS as usize - 1 - last)
}

/// Range of columns from the first to the last of some groups.
pub(crate) fn span(area: &Area, groups: u16) -> Range<u16> {
    if groups == 0 {
        return 0..0;
    }
    let grain = grain(area);
    // Rows that share an entry may be longer than this one.
    let columns = |end: u32| (end << grain).min(area.columns.into()) as u16;
    columns(groups.trailing_zeros())..columns(u16::BITS - groups.leading_zeros())
}

/// Iterator over runs of consecutive groups: as groups, and as columns of a row.
pub(crate) struct Pieces {
    groups: u32,
    at: u32,
    grain: u32,
    columns: u32,
}

impl Pieces {
    pub fn of(area: &Area, grain: u32, groups: u32) -> Self {
        Pieces { groups, at: 0, grain, columns: area.columns.into() }
    }
}

impl Iterator for Pieces {
    type Item = (u16, Range<usize>);

    fn next(&mut self) -> Option<(u16, Range<usize>)> {
        if self.groups == 0 {
            return None;
        }
        let skipped = self.groups.trailing_zeros();
        let length = (!(self.groups >> skipped)).trailing_zeros();
        let start = self.at + skipped;
        let groups = ((1 << length) - 1) << start;
        self.groups >>= skipped + length;
        self.at = start + length;
        let end = (self.at << self.grain).min(self.columns);
        Some((groups as u16, (start << self.grain) as usize..end as usize))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::view::Image;
    use super::*;
    use crate::garment::Garment;
    use std::vec;
    use std::vec::Vec;

    #[test]
    fn spans_and_pieces_hold_what_there_is_and_no_more_than_its_groups() {
        for (rows, columns, group) in
            [(1, 1, 1), (3, 16, 1), (300, 16, 1), (2, 17, 2), (5, 40, 4), (1, 700, 64)]
        {
            let layout = Layout::build(&Garment::recorded(rows, columns), 4800, 255).unwrap();
            let area = &layout.areas()[0];
            let mut values = vec![0u16; layout.taxels()];
            assert!(Rows::of(&layout, &values).is_empty());
            let (row, last) = (rows - 1, columns - 1);
            for column in [last / 3, last] {
                values[usize::from(row * columns + column)] = 1;
            }
            let held = Rows::of(&layout, &values);
            let image = Image { values: &values, rows: &held };
            assert_eq!(image.span(area, row), last / 3 / group * group..columns);
            assert_eq!(image.span(area, rows), 0..0);
            assert!(rows == 1 || rows > 255 || image.span(area, row - 1).is_empty());
            assert_eq!(Image { values: &values, rows: &Rows::ALL }.span(area, row), 0..columns);
            let pieces = Pieces::of(area, grain(area), held.groups(row).into());
            let pieces: Vec<_> = pieces.map(|(_, columns)| columns).collect();
            assert!(pieces.iter().any(|piece| piece.contains(&usize::from(last))));
            assert!(pieces.iter().any(|piece| piece.contains(&usize::from(last / 3))));
            assert!(pieces.iter().all(|piece| piece.len() <= 2 * usize::from(group)));
        }
    }
}
