//! A set of rows that may be non-zero.

use core::ops::Range;

/// Entries of the set; the last one stands for all further rows.
pub(crate) const ENTRIES: usize = 256;

/// A bit for each row by its number over all panels ([`Area::first_row`](crate::garment::Area)` + row`). Rows
/// from 255 on share one bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RowSet([u32; ENTRIES / 32]);

impl RowSet {
    /// No row.
    pub const NONE: RowSet = RowSet([0; ENTRIES / 32]);
    /// Every row.
    pub const ALL: RowSet = RowSet([u32::MAX; ENTRIES / 32]);

    /// Union.
    pub fn with(&self, other: &RowSet) -> RowSet {
        let mut all = *self;
        all.0.iter_mut().zip(other.0).for_each(|(all, other)| *all |= other);
        all
    }

    /// Rows that are not in `other`.
    pub(crate) fn without(&self, other: &RowSet) -> RowSet {
        let mut rest = *self;
        rest.0.iter_mut().zip(other.0).for_each(|(rest, other)| *rest &= !other);
        rest
    }

    /// True if there is no row.
    pub fn is_empty(&self) -> bool {
        *self == RowSet::NONE
    }

    /// First row of the range that may be non-zero.
    pub const fn next(&self, rows: Range<u16>) -> Option<u16> {
        let mut row = rows.start;
        while row < rows.end {
            let entry = entry(row);
            let ahead = self.0[entry / 32] >> (entry % 32);
            if ahead & 1 == 1 {
                // Most such rows follow another one, and counting zeros takes a Cortex-M0+ long.
                return Some(row);
            }
            if entry == SHARED {
                return None;
            }
            if ahead != 0 {
                let next = row + ahead.trailing_zeros() as u16;
                return if next < rows.end { Some(next) } else { None };
            }
            row = (row | 31) + 1;
        }
        None
    }

    /// First run of consecutive rows of the range that may be non-zero.
    #[inline]
    pub fn run(&self, rows: Range<u16>) -> Option<Range<u16>> {
        let start = self.next(rows.clone())?;
        let mut end = start;
        while end < rows.end {
            let entry = entry(end);
            let nothing = !(self.0[entry / 32] >> (entry % 32));
            if entry == SHARED {
                return Some(start..if nothing & 1 == 0 { rows.end } else { end });
            }
            let held = nothing.trailing_zeros() as u16;
            end += held;
            if held == 0 || end % 32 != 0 {
                break;
            }
        }
        Some(start..end.min(rows.end))
    }

    /// Adds an entry.
    pub(crate) const fn add(&mut self, entry: usize) {
        self.0[entry / 32] |= 1 << (entry % 32);
    }

    /// Adds consecutive entries.
    pub(crate) fn add_run(&mut self, entries: Range<usize>) {
        let mut from = entries.start;
        while from < entries.end {
            let end = ((from | 31) + 1).min(entries.end);
            if let Some(held) = self.0.get_mut(from / 32) {
                *held |= u32::MAX << (from % 32) & u32::MAX >> (31 - (end - 1) % 32);
            }
            from = end;
        }
    }

    /// Removes an entry.
    pub(crate) const fn remove(&mut self, entry: usize) {
        self.0[entry / 32] &= !(1 << (entry % 32));
    }
}

/// Index of the last entry, which many rows share.
pub(crate) const SHARED: usize = ENTRIES - 1;

/// Index of a row's entry.
pub(crate) const fn entry(row: u16) -> usize {
    if row as usize >= SHARED { SHARED } else { row as usize }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_the_rows_that_follow_each_other() {
        for (first, last) in
            [(0, 0), (3, 7), (0, 31), (31, 32), (30, 100), (64, 95), (200, 254), (0, 255), (255, 255)]
        {
            let mut held = RowSet::NONE;
            held.add_run(first..last + 1);
            let (first, end) = (first as u16, if last == SHARED { 300 } else { last as u16 + 1 });
            for rows in [0..300, first..300, 0..end, first..end] {
                assert_eq!(held.run(rows), Some(first..end), "{first}..{end}");
            }
            assert_eq!(held.run(end..300), None);
            assert_eq!(held.run(first..first + 1), Some(first..first + 1));
        }
        assert_eq!(RowSet::NONE.run(0..300), None);
        assert_eq!(RowSet::ALL.run(7..300), Some(7..300));
    }
}
