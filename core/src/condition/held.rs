//! Which rows may hold something.

use core::ops::Range;

/// Rows that are told apart; those from the last of them on are one.
pub(super) const ENTRIES: usize = 256;

/// A bit for each row by its number over all panels ([`Area::first_row`](crate::garment::Area)` + row`). Rows
/// from 255 on share one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Held([u32; ENTRIES / 32]);

impl Held {
    /// No row.
    pub const NONE: Held = Held([0; ENTRIES / 32]);
    /// Every row.
    pub const ALL: Held = Held([u32::MAX; ENTRIES / 32]);

    /// Those of both.
    pub fn with(&self, other: &Held) -> Held {
        let mut all = *self;
        all.0.iter_mut().zip(other.0).for_each(|(all, other)| *all |= other);
        all
    }

    /// Those that the other does not hold.
    pub(super) fn without(&self, other: &Held) -> Held {
        let mut rest = *self;
        rest.0.iter_mut().zip(other.0).for_each(|(rest, other)| *rest &= !other);
        rest
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        *self == Held::NONE
    }

    /// The first of some rows that may hold something.
    pub const fn next(&self, rows: Range<u16>) -> Option<u16> {
        let mut row = rows.start;
        while row < rows.end {
            let entry = entry(row);
            let ahead = self.0[entry / 32] >> (entry % 32);
            if ahead & 1 == 1 {
                // Most rows that hold something follow another, and to count zeros takes a Cortex-M0+ long.
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

    /// The first of some rows that may hold something, with those behind it up to the first that holds nothing.
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
    pub(super) const fn add(&mut self, entry: usize) {
        self.0[entry / 32] |= 1 << (entry % 32);
    }

    /// Adds entries that follow each other.
    pub(super) fn add_run(&mut self, entries: Range<usize>) {
        let mut from = entries.start;
        while from < entries.end {
            let end = ((from | 31) + 1).min(entries.end);
            if let Some(held) = self.0.get_mut(from / 32) {
                *held |= u32::MAX << (from % 32) & u32::MAX >> (31 - (end - 1) % 32);
            }
            from = end;
        }
    }

    /// Takes an entry away.
    pub(super) const fn remove(&mut self, entry: usize) {
        self.0[entry / 32] &= !(1 << (entry % 32));
    }
}

/// The last entry, which many rows share.
pub(super) const SHARED: usize = ENTRIES - 1;

/// Where a row is noted.
pub(super) const fn entry(row: u16) -> usize {
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
            let mut held = Held::NONE;
            held.add_run(first..last + 1);
            let (first, end) = (first as u16, if last == SHARED { 300 } else { last as u16 + 1 });
            for rows in [0..300, first..300, 0..end, first..end] {
                assert_eq!(held.run(rows), Some(first..end), "{first}..{end}");
            }
            assert_eq!(held.run(end..300), None);
            assert_eq!(held.run(first..first + 1), Some(first..first + 1));
        }
        assert_eq!(Held::NONE.run(0..300), None);
        assert_eq!(Held::ALL.run(7..300), Some(7..300));
    }
}
