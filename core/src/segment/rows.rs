//! Rows of any length, word by word.

use super::bits::WORD;
use super::labeller::{Labeller, ScanLine};
use super::run::Run;
use super::sums::RunSums;
use super::threshold::touched;
use super::union_find::{NONE, first_of, unite};
use core::ops::Range;

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    /// Appends the groups of adjacent taxels of a row as one run each, and adds their sums to their labels.
    pub(crate) fn scan_row(&mut self, row: &[u16], low: u16, line: &mut ScanLine) {
        let here = self.runs.len();
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

    /// Appends the groups of a word; `above` is the range of runs in the row above that may touch them.
    /// Returns the first of these that may touch taxels of the next word. All runs are in the order of their
    /// columns.
    #[inline(never)] // M0+: out of line
    fn scan_word(
        &mut self,
        all: u32,
        values: &[u16],
        column: u16,
        above: Range<usize>,
        line: &ScanLine,
    ) -> usize {
        let Range { start: mut above, end: here } = above;
        // The first group may continue one of the word before.
        let before = self.runs.get(here..).and_then(<[Run]>::last);
        let before = before.filter(|before| all & 1 == 1 && before.right.wrapping_add(1) == column);
        let mut label = before.map_or(NONE, |before| before.label);
        let mut rest = all;
        while rest != 0 {
            let start = rest.trailing_zeros() as u16;
            let area = (rest >> start).trailing_ones() as u16;
            let after = rest & rest.wrapping_add(1 << start);
            let (left, end) = (column + start, column + start + area);
            while above < here
                && let Some(run) = self.runs.get(above)
            {
                let beyond = run.right + 1;
                if beyond >= left {
                    if run.left > end {
                        break;
                    }
                    label = match label {
                        NONE => first_of(&mut self.labels, run.label),
                        label => unite(&mut self.labels, run.label, label),
                    };
                    if beyond >= end {
                        // It may touch the next group, too.
                        break;
                    }
                }
                above += 1;
            }
            // Always: the word has as many values.
            let Some(values) = values.get(start.into()..(start + area).into()) else { break };
            let mut sums = RunSums::NONE;
            let peak = sums.take(values);
            let (taxels, row, right) = (rest & !after, line.row, end - 1);
            let run = Run { taxels, row, label, left, right, area, peak, sums };
            if let (label, Some(_)) = self.push(run, line.panel)
                && let Some(label) = self.labels.get_mut(usize::from(label))
            {
                label.add(sums.s0, area, peak);
            }
            (label, rest) = (NONE, after);
        }
        above
    }
}
