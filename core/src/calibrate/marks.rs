//! Marks of taxels beyond their limits.

use crate::garment::Area;
use crate::image::row16::ROW16;
use crate::image::rows::{Rows, grain};
use core::ops::Range;

/// Marks the active taxels of a panel in one pass, row by row.
pub(crate) struct Marks<'a> {
    rows: &'a mut Rows,
    /// Rows of the panel, numbered over all panels.
    panel: Range<u16>,
    /// Present row, numbered over all panels.
    row: u16,
    /// First taxel of that row, numbered in the panel.
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

    /// Groups of the panel's rows from `first` on, one bit per taxel, if rows have sixteen columns and an
    /// entry each. Rows whose groups are written must be [held](Marks::hold).
    #[inline(always)]
    pub fn rows(&mut self, first: usize) -> Option<&mut [u16]> {
        let (panel, are_rows16) = (self.panel.clone(), self.columns == ROW16);
        if are_rows16 { self.rows.places(panel)?.get_mut(first..) } else { None }
    }

    /// Holds some rows, numbered in the panel.
    #[inline(always)]
    pub fn hold(&mut self, rows: Range<usize>) {
        let row = |row: usize| usize::from(self.panel.start) + row;
        self.rows.hold(row(rows.start)..row(rows.end));
    }

    /// Marks the active taxels among `count` taxels from number `at` of the panel on, given a bit for each;
    /// at most 16.
    pub fn mark(&mut self, at: usize, count: usize, bits: u32) {
        let mut column = at - self.start;
        while column >= self.columns {
            self.next_row();
            column -= self.columns;
        }
        let (mut rest, mut left) = (bits, count);
        while rest != 0 {
            // Up to the end of the row and, if groups are too wide to fold in a word, of the group.
            let (before, inside) = (column >> self.grain, column & ((1 << self.grain) - 1));
            let wide = self.grain > MOST_FOLDED;
            let row = self.columns - column;
            let ahead = left.min(if wide { row.min((1 << self.grain) - inside) } else { row });
            let piece = rest & !u32::MAX.unbounded_shl(ahead as u32);
            let groups = if wide { u32::from(piece != 0) } else { fold(piece << inside, self.grain) };
            self.rows.add(self.row, (groups << before) as u16);
            (rest, left, column) = (rest.unbounded_shr(ahead as u32), left - ahead, column + ahead);
            if column == self.columns {
                self.next_row();
                column = 0;
            }
        }
    }

    fn next_row(&mut self) {
        self.row = self.row.saturating_add(1);
        self.start += self.columns;
    }
}

/// Largest grain at which a group's bits and those of 16 taxels fit in one word.
const MOST_FOLDED: u32 = 4;

/// Marks rows that are whole chunks of sixteen columns, by SIMD.
#[cfg(target_pointer_width = "64")]
impl Marks<'_> {
    /// True if rows are whole chunks of sixteen columns, and no group is wider than one.
    pub const fn are_chunks16(&self) -> bool {
        self.columns.is_multiple_of(ROW16) && self.grain <= MOST_FOLDED
    }

    /// Number of chunks of sixteen columns of a row.
    pub const fn chunks16(&self) -> usize {
        self.columns / ROW16
    }

    /// Groups of a row with active taxels in a chunk, given its number in the row and a bit per taxel.
    #[inline(always)]
    pub fn groups_of_chunk16(&self, chunk: u32, bits: u32) -> u16 {
        let groups = match self.grain {
            2 => fold_chunk16_by_four(bits),
            grain => fold(bits, grain),
        };
        (groups << ((chunk * ROW16 as u32) >> self.grain)) as u16
    }

    /// Replaces the groups of a row of the panel.
    #[inline(always)]
    pub const fn mark_row(&mut self, row: usize, groups: u16) {
        self.rows.set(self.panel.start.saturating_add(row as u16), groups);
    }
}

/// [`fold`] of 16 bits with a grain of 2, that of panels of 33 to 64 columns.
#[cfg(target_pointer_width = "64")]
const fn fold_chunk16_by_four(bits: u32) -> u32 {
    let two = bits | bits >> 1;
    let four = (two | two >> 2) & 0x1111;
    // Brings bit 4 k to bit 12 + k; nothing carries.
    ((four * 0x1248) >> 12) & 0xf
}

/// Returns a bit for each `2^grain` bits: 1 if any of them is set.
fn fold(bits: u32, grain: u32) -> u32 {
    let mut bits = bits;
    for _ in 0..grain {
        // Combines neighbours, then moves the remaining bits together.
        bits = (bits | bits >> 1) & 0x5555_5555;
        bits = (bits | bits >> 1) & 0x3333_3333;
        bits = (bits | bits >> 2) & 0x0f0f_0f0f;
        bits = (bits | bits >> 4) & 0x00ff_00ff;
        bits = (bits | bits >> 8) & 0x0000_ffff;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::{Garment, Layout};

    #[test]
    fn chunks16_fold_as_others() {
        for bits in 0..1 << ROW16 {
            assert_eq!(fold_chunk16_by_four(bits), fold(bits, 2));
        }
        for columns in (1..=20).map(|chunks| chunks * ROW16 as u16) {
            let layout = Layout::build(&Garment::recorded(2, columns), 2048, 255).unwrap();
            let area = &layout.areas()[0];
            let (mut marked, mut expected) = (Rows::NONE, Rows::NONE);
            let mut marks = Marks::of(&mut marked, area);
            assert_eq!((marks.are_chunks16(), marks.chunks16()), (columns <= 256, usize::from(columns) / 16));
            if columns > 256 {
                continue;
            }
            let bits = |chunk: u32| 1u32 << (chunk * 7 % 16);
            let groups = (0..u32::from(columns) / 16).map(|at| marks.groups_of_chunk16(at, bits(at)));
            let groups = groups.fold(0, |all, groups| all | groups);
            marks.mark_row(0, u16::MAX);
            marks.mark_row(0, groups);
            let mut each = Marks::of(&mut expected, area);
            for at in 0..u32::from(columns) / 16 {
                each.mark(at as usize * ROW16, ROW16, bits(at));
            }
            assert!(marked == expected, "{columns}");
        }
    }

    #[test]
    fn whatever_the_columns_each_taxel_marks_its_group() {
        let mut noise = 1u32;
        for columns in [1, 2, 5, 15, 16, 17, 27, 32, 33, 64, 100, 255, 256, 257, 700] {
            let rows = 2 + 60 / columns;
            let layout = Layout::build(&Garment::recorded(rows, columns), 2048, 255).unwrap();
            let area = &layout.areas()[0];
            let count = usize::from(rows * columns);
            for _ in 0..200 {
                let (mut marked, mut expected) = (Rows::NONE, Rows::NONE);
                let mut marks = Marks::of(&mut marked, area);
                for first in (0..count).step_by(ROW16) {
                    noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
                    let there = ROW16.min(count - first);
                    let bits = (noise >> 16) & (noise >> 8) & 0xffff >> (ROW16 - there);
                    marks.mark(first, there, bits);
                    for taxel in (0..there).filter(|taxel| bits & 1 << taxel != 0).map(|taxel| first + taxel)
                    {
                        let (row, column) = (taxel / usize::from(columns), taxel % usize::from(columns));
                        expected.add(row as u16, 1 << (column >> grain(area)));
                    }
                }
                assert!(marked == expected, "{columns}");
            }
        }
    }
}
