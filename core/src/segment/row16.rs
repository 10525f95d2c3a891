//! Rows of sixteen columns, each in one word.

use super::bits::{highest, is_run, run_of, widened};
use super::labels::{Labels, Line};
use super::run::Piece;
use super::sums::Sums;
use super::threshold::{Sixteen, touched_of_sixteen};
use super::union_find::{NONE, first_of, unite};
use bytemuck::must_cast_slice;
use core::ops::Range;

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    /// Appends the runs of consecutive rows, as one piece for each part of a row. Their sums are not added to
    /// the parts yet.
    #[inline(never)] // M0+: out of line
    pub(crate) fn scan_sixteens(&mut self, rows: &[Sixteen], low: u16, line: &mut Line) {
        let mut all = 0;
        for sixteen in rows {
            let here = self.pieces.len();
            let (taxels, values) = (touched_of_sixteen(sixteen, low), must_cast_slice(sixteen));
            line.part = if is_run(taxels) {
                self.scan_run(taxels, values, line)
            } else if taxels & !line.reach != 0 {
                self.scan_runs(taxels, values, line)
            } else if taxels != 0 {
                self.push_named(taxels, taxels, line.part, values, line)
            } else {
                NONE
            };
            line.reach = if line.part == NONE { 0 } else { widened(taxels) };
            line.row += 1;
            line.above = here;
            all |= taxels;
        }
        line.ends = line.ends.map(|end| end | all);
    }

    /// Appends the single run of a row to the part that it touches, and returns the part. Parts that it
    /// connects are joined.
    #[inline(never)] // M0+: out of line
    fn scan_run(&mut self, run: u32, values: &[u16], line: &Line) -> u16 {
        let part = if line.reach & run != 0 { line.part } else { self.meet(run, line) };
        self.push_run(run, run, part, values, line)
    }

    /// Appends one run of a row; `all` is every touched taxel of the row.
    #[inline(always)]
    pub(crate) fn push_run(&mut self, taxels: u32, all: u32, part: u16, values: &[u16], line: &Line) -> u16 {
        let Range { start, end } = run_of(taxels);
        // Always: the row has as many values.
        let Some(values) = values.get(start..end) else { return part };
        let (left, right, area) = (start as u16, end as u16 - 1, values.len() as u16);
        let (sums, peak) = (Sums::NONE, 0);
        let piece = Piece { taxels, all, row: line.row, part, left, right, area, peak, sums };
        let (part, piece) = self.push(piece, line.panel);
        if let Some(piece) = piece {
            // Summed in place: nothing is copied.
            piece.peak = piece.sums.take(values);
        }
        part
    }

    /// Returns the part of the row above that a run touches, or [`NONE`]. If it touches several, they are
    /// joined.
    #[inline(never)] // M0+: out of line
    fn meet(&mut self, run: u32, line: &Line) -> u16 {
        let above = self.pieces.get(line.above..).unwrap_or(&[]);
        let mut part = NONE;
        for piece in above.iter().filter(|piece| piece.reach() & run != 0) {
            part = match part {
                NONE => first_of(&mut self.parts, piece.part),
                part => unite(&mut self.parts, piece.part, part),
            };
        }
        part
    }

    /// Appends runs of a row as one piece; `all` is every touched taxel of the row.
    #[inline(never)] // M0+: out of line
    pub(crate) fn push_named(
        &mut self,
        taxels: u32,
        all: u32,
        part: u16,
        values: &[u16],
        line: &Line,
    ) -> u16 {
        let (start, area) = (taxels.trailing_zeros(), taxels.count_ones() as u16);
        let (left, right) = (start as u16, highest(taxels));
        let (sums, peak) = (Sums::NONE, 0);
        let piece = Piece { taxels, all, row: line.row, part, left, right, area, peak, sums };
        let (part, piece) = self.push(piece, line.panel);
        if let Some(piece) = piece {
            let values = values.get(start as usize..).unwrap_or(&[]);
            piece.peak = piece.sums.take_named(values, taxels.unbounded_shr(start));
        }
        part
    }
}
