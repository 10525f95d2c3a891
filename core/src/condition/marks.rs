//! Where something is beyond its limit.

use super::rows::{Rows, grain};
use super::sixteen::SIXTEEN;
use crate::garment::Area;
use core::ops::Range;

/// Takes down where something is; goes through a panel once, row by row.
pub(super) struct Marks<'a> {
    rows: &'a mut Rows,
    /// Those of the panel, over all panels.
    panel: Range<u16>,
    /// Over all panels.
    row: u16,
    /// Its first taxel in the panel.
    start: usize,
    columns: usize,
    grain: u32,
}

impl<'a> Marks<'a> {
    pub fn of(rows: &'a mut Rows, area: &Area) -> Self {
        Marks {
            rows,
            panel: area.first_row..area.first_row.saturating_add(area.rows),
            row: area.first_row,
            start: 0,
            columns: usize::from(area.columns),
            grain: grain(area),
        }
    }

    /// The groups of the rows from one of the panel on, where rows are of sixteen taxels and have a place each: one bit for each of
    /// them. What is written there is to be [held](Marks::hold).
    #[inline(always)]
    pub fn rows(&mut self, first: usize) -> Option<&mut [u16]> {
        let (panel, sixteen) = (self.panel.clone(), self.columns == SIXTEEN);
        if sixteen { self.rows.places(panel)?.get_mut(first..) } else { None }
    }

    /// Holds some rows, by their number in the panel.
    #[inline(always)]
    pub fn hold(&mut self, rows: Range<usize>) {
        let row = |row: usize| usize::from(self.panel.start) + row;
        self.rows.hold(row(rows.start)..row(rows.end));
    }

    /// Taxels of the panel from number `at` on, `count` of them, a bit for each that holds something.
    pub fn mark(&mut self, at: usize, count: usize, bits: u32) {
        let mut column = at - self.start;
        while column >= self.columns {
            self.next_row();
            column -= self.columns;
        }
        if column + count <= self.columns && self.grain == 0 {
            return self.rows.add(self.row, (bits << column) as u16);
        }
        let mut rest = bits;
        while rest != 0 {
            let skipped = rest.trailing_zeros();
            column += skipped as usize;
            while column >= self.columns {
                self.next_row();
                column -= self.columns;
            }
            self.rows.add(self.row, 1 << (column >> self.grain));
            // What else is of the same group and row.
            let group = (((column >> self.grain) + 1) << self.grain).min(self.columns) - column;
            rest = (rest >> skipped).unbounded_shr(group as u32);
            column += group;
        }
    }

    fn next_row(&mut self) {
        self.row = self.row.saturating_add(1);
        self.start += self.columns;
    }
}
