//! Rows of sixteen columns, each in one word.

use super::bits::{highest, is_run, run_of, widened};
use super::labeller::{Labeller, ScanLine};
use super::run::Run;
use super::sums::RunSums;
use super::threshold::{PairedRow16, touched_of_row16};
use super::union_find::{NONE, first_of, unite};
use bytemuck::must_cast_slice;
use core::ops::Range;

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    /// Appends the touched taxels of consecutive rows, as one run for each label of a row. Their sums are not
    /// added to the labels yet.
    #[inline(never)] // M0+: out of line
    pub(crate) fn scan_rows16(&mut self, rows: &[PairedRow16], low: u16, line: &mut ScanLine) {
        let mut all = 0;
        for row16 in rows {
            let here = self.runs.len();
            let (taxels, values) = (touched_of_row16(row16, low), must_cast_slice(row16));
            line.label = if is_run(taxels) {
                self.scan_group(taxels, values, line)
            } else if taxels & !line.reach != 0 {
                self.scan_groups(taxels, values, line)
            } else if taxels != 0 {
                self.push_groups(taxels, line.label, values, line)
            } else {
                NONE
            };
            line.reach = if line.label == NONE { 0 } else { widened(taxels) };
            line.row += 1;
            line.above = here;
            all |= taxels;
        }
        line.ends = line.ends.map(|end| end | all);
    }

    /// Appends the single group of a row to the label that it touches, and returns the label. Labels that it
    /// connects are joined.
    #[inline(never)] // M0+: out of line
    fn scan_group(&mut self, group: u32, values: &[u16], line: &ScanLine) -> u16 {
        let label = if line.reach & group != 0 { line.label } else { self.meet(group, line) };
        self.push_group(group, label, values, line)
    }

    /// Appends one group of adjacent taxels.
    #[inline(always)]
    pub(crate) fn push_group(&mut self, taxels: u32, label: u16, values: &[u16], line: &ScanLine) -> u16 {
        let Range { start, end } = run_of(taxels);
        // Always: the row has as many values.
        let Some(values) = values.get(start..end) else { return label };
        let (left, right, area) = (start as u16, end as u16 - 1, values.len() as u16);
        let (sums, peak) = (RunSums::NONE, 0);
        let run = Run { taxels, row: line.row, label, left, right, area, peak, sums };
        let (label, run) = self.push(run, line.panel);
        if let Some(run) = run {
            // Summed in place: nothing is copied.
            run.peak = run.sums.take(values);
        }
        label
    }

    /// Returns the label of the row above that a group touches, or [`NONE`]. If it touches several, they are
    /// joined.
    #[inline(never)] // M0+: out of line
    fn meet(&mut self, group: u32, line: &ScanLine) -> u16 {
        let above = self.runs.get(line.above..).unwrap_or(&[]);
        let mut label = NONE;
        for run in above.iter().filter(|run| run.reach() & group != 0) {
            label = match label {
                NONE => first_of(&mut self.labels, run.label),
                label => unite(&mut self.labels, run.label, label),
            };
        }
        label
    }

    /// Appends groups of a row as one run.
    #[inline(never)] // M0+: out of line
    pub(crate) fn push_groups(&mut self, taxels: u32, label: u16, values: &[u16], line: &ScanLine) -> u16 {
        let (start, area) = (taxels.trailing_zeros(), taxels.count_ones() as u16);
        let (left, right) = (start as u16, highest(taxels));
        let (sums, peak) = (RunSums::NONE, 0);
        let run = Run { taxels, row: line.row, label, left, right, area, peak, sums };
        let (label, run) = self.push(run, line.panel);
        if let Some(run) = run {
            let values = values.get(start as usize..).unwrap_or(&[]);
            run.peak = run.sums.take_named(values, taxels.unbounded_shr(start));
        }
        label
    }
}
