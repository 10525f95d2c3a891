//! Rows of one word with several groups of adjacent taxels: assigns the groups to labels.

use super::bits::{WORD, flood, is_run, lowest_run};
use super::labeller::{Labeller, ScanLine};
use super::union_find::{NONE, first_of, unite};
use heapless::Vec;

/// Pairs of a label and its taxels in a row, as bits.
type GroupLabels = Vec<(u32, u16), { WORD as usize / 2 }>;

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    /// Returns the label that all groups of a row touch, if there is only one.
    #[inline(never)] // M0+: out of line
    fn only_label(&mut self, all: u32, line: &ScanLine) -> Option<u16> {
        let above = self.runs.get(line.above..).unwrap_or(&[]);
        if let [run] = above
            && run.reach() & all == all
        {
            return Some(first_of(&mut self.labels, run.label));
        }
        let (mut label, mut touched) = (NONE, 0);
        for run in above {
            let taxels = run.reach() & all;
            if taxels != 0 {
                let other = first_of(&mut self.labels, run.label);
                if label != NONE && label != other {
                    return None;
                }
                (label, touched) = (other, touched | taxels);
            }
        }
        (flood(all, touched) == all).then_some(label)
    }

    /// Appends the groups of a row, as one run for each label that they touch or begin. Returns the label if
    /// it is the only one.
    #[inline(never)] // M0+: out of line
    pub(crate) fn scan_groups(&mut self, all: u32, values: &[u16], line: &ScanLine) -> u16 {
        if let Some(label) = self.only_label(all, line) {
            return self.push_groups(all, label, values, line);
        }
        let mut found = GroupLabels::new();
        self.find_labels(&mut found, all, line);
        for &(taxels, label) in &found {
            if is_run(taxels) {
                self.push_group(taxels, label, values, line);
            } else {
                self.push_groups(taxels, label, values, line);
            }
        }
        NONE
    }

    /// Sorts the groups of a row by their labels: first those that touch the row above, then new ones.
    #[inline(never)] // rarely called
    fn find_labels(&mut self, found: &mut GroupLabels, all: u32, line: &ScanLine) {
        let mut free = all;
        for run in self.runs.get(line.above..).unwrap_or(&[]) {
            let touched = run.reach() & all;
            if touched == 0 {
                continue;
            }
            let mut label = first_of(&mut self.labels, run.label);
            let groups = flood(all, touched);
            for (_, other) in found.iter().filter(|(taken, _)| taken & groups != 0) {
                label = unite(&mut self.labels, *other, label);
            }
            let fresh = groups & free;
            free &= !groups;
            match found.iter_mut().find(|(_, other)| *other == label) {
                Some((taken, _)) => *taken |= fresh,
                // As many places as a row has groups.
                None if fresh != 0 => drop(found.push((fresh, label))),
                None => {}
            }
        }
        while free != 0 {
            let group = lowest_run(free);
            free &= !group;
            let _ = found.push((group, NONE));
        }
    }
}
