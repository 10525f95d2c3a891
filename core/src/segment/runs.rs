//! Rows of one word with several runs: assigns the runs to parts.

use super::bits::{WORD, flood, is_run, lowest_run};
use super::labels::{Labels, Line};
use super::union_find::{NONE, first_of, unite};
use heapless::Vec;

/// Pairs of a part and its runs in a row, as bits.
type Found = Vec<(u32, u16), { WORD as usize / 2 }>;

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    /// Returns the part that all runs of a row touch, if there is only one.
    #[inline(never)] // M0+: out of line
    fn only_part(&mut self, all: u32, line: &Line) -> Option<u16> {
        let above = self.pieces.get(line.above..).unwrap_or(&[]);
        if let [piece] = above
            && piece.reach() & all == all
        {
            return Some(first_of(&mut self.parts, piece.part));
        }
        let (mut part, mut touched) = (NONE, 0);
        for piece in above {
            let taxels = piece.reach() & all;
            if taxels != 0 {
                let other = first_of(&mut self.parts, piece.part);
                if part != NONE && part != other {
                    return None;
                }
                (part, touched) = (other, touched | taxels);
            }
        }
        (flood(all, touched) == all).then_some(part)
    }

    /// Appends the runs of a row, as one piece for each part that they touch or begin. Returns the part if it
    /// is the only one.
    #[inline(never)] // M0+: out of line
    pub(crate) fn scan_runs(&mut self, all: u32, values: &[u16], line: &Line) -> u16 {
        if let Some(part) = self.only_part(all, line) {
            return self.push_named(all, all, part, values, line);
        }
        let mut found = Found::new();
        self.find_parts(&mut found, all, line);
        for &(taxels, part) in &found {
            if is_run(taxels) {
                self.push_run(taxels, all, part, values, line);
            } else {
                self.push_named(taxels, all, part, values, line);
            }
        }
        NONE
    }

    /// Sorts the runs of a row by their parts: first those that touch the row above, then new ones.
    #[inline(never)] // rarely called
    fn find_parts(&mut self, found: &mut Found, all: u32, line: &Line) {
        let mut free = all;
        for piece in self.pieces.get(line.above..).unwrap_or(&[]) {
            let touched = piece.reach() & all;
            if touched == 0 {
                continue;
            }
            let mut part = first_of(&mut self.parts, piece.part);
            let runs = flood(all, touched);
            for (_, other) in found.iter().filter(|(taken, _)| taken & runs != 0) {
                part = unite(&mut self.parts, *other, part);
            }
            let fresh = runs & free;
            free &= !runs;
            match found.iter_mut().find(|(_, other)| *other == part) {
                Some((taken, _)) => *taken |= fresh,
                // As many places as a row has runs.
                None if fresh != 0 => drop(found.push((fresh, part))),
                None => {}
            }
        }
        while free != 0 {
            let run = lowest_run(free);
            free &= !run;
            let _ = found.push((run, NONE));
        }
    }
}
