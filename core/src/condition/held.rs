//! Which rows may hold something.

use core::ops::Range;

/// Rows that are told apart; those from the last of them on are one.
pub(super) const ENTRIES: usize = 256;

/// A bit for each row by its number over all panels ([`Area::first_row`](crate::garment::Area)` + row`). Rows from 255 on share one.
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
