//! Rows of any length, word by word.

use super::bits::WORD;
use super::labels::{Labels, Line};
use super::run::Piece;
use super::sums::Sums;
use super::threshold::touched;
use super::union_find::{NONE, first_of, unite};
use core::ops::Range;

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    /// Appends the runs of a row as one piece each, and adds their sums to their parts.
    pub(crate) fn scan_row(&mut self, row: &[u16], low: u16, line: &mut Line) {
        let here = self.pieces.len();
        let mut above = line.above;
        for (values, column) in row.chunks(WORD.into()).zip((0..).step_by(WORD.into())) {
            let taxels = touched(values, low);
            if column == 0 {
                line.ends[0] |= taxels;
            }
            if usize::from(column) + values.len() == row.len() {
                line.ends[1] |= taxels;
            }
            if taxels != 0 {
                above = self.scan_word(taxels, values, column, above..here, line);
            }
        }
        line.above = here;
    }

    /// Appends the runs of a word; `above` is the range of pieces in the row above that may touch them.
    /// Returns the first of these that may touch runs of the next word. All pieces are in the order of their
    /// columns.
    #[inline(never)] // M0+: out of line
    fn scan_word(
        &mut self,
        all: u32,
        values: &[u16],
        column: u16,
        above: Range<usize>,
        line: &Line,
    ) -> usize {
        let Range { start: mut above, end: here } = above;
        // The first run may continue one of the word before.
        let before = self.pieces.get(here..).and_then(<[Piece]>::last);
        let before = before.filter(|before| all & 1 == 1 && before.right.wrapping_add(1) == column);
        let mut part = before.map_or(NONE, |before| before.part);
        let mut rest = all;
        while rest != 0 {
            let start = rest.trailing_zeros() as u16;
            let area = (rest >> start).trailing_ones() as u16;
            let after = rest & rest.wrapping_add(1 << start);
            let (left, end) = (column + start, column + start + area);
            while above < here
                && let Some(piece) = self.pieces.get(above)
            {
                let beyond = piece.right + 1;
                if beyond >= left {
                    if piece.left > end {
                        break;
                    }
                    part = match part {
                        NONE => first_of(&mut self.parts, piece.part),
                        part => unite(&mut self.parts, piece.part, part),
                    };
                    if beyond >= end {
                        // It may touch the next run, too.
                        break;
                    }
                }
                above += 1;
            }
            // Always: the word has as many values.
            let Some(values) = values.get(start.into()..(start + area).into()) else { break };
            let mut sums = Sums::NONE;
            let peak = sums.take(values);
            let (taxels, row, right) = (rest & !after, line.row, end - 1);
            let piece = Piece { taxels, all, row, part, left, right, area, peak, sums };
            if let (part, Some(_)) = self.push(piece, line.panel)
                && let Some(part) = self.parts.get_mut(usize::from(part))
            {
                part.add(sums.s0, area, peak);
            }
            (part, rest) = (NONE, after);
        }
        above
    }
}
