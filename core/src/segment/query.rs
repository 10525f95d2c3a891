//! Queries of a frame's runs by position.

use super::bits::WORD;
use super::labeller::Labeller;
use super::run::{Run, key};
use super::union_find::NONE;
use crate::garment::Area;

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    /// Root of the label of a run.
    pub fn label_of(&self, run: &Run) -> Option<u16> {
        Some(self.labels.get(usize::from(run.label))?.parent)
    }

    /// Runs of the rows `first ..= last`, counted over all panels, with their indices.
    pub fn in_rows(&self, first: u16, last: u16) -> impl Iterator<Item = (usize, &Run)> {
        let from = self.runs.partition_point(|run| run.row < first);
        let runs = (from..).zip(self.runs.get(from..).unwrap_or(&[]));
        runs.take_while(move |(_, run)| run.row <= last)
    }

    /// Returns the taxels of run `number` that have all four neighbours touched, in its panel `area`.
    pub fn enclosed(&self, number: usize, run: &Run, area: &Area) -> u32 {
        let (Run { taxels, row, .. }, column) = (*run, run.column());
        let last = area.first_row.saturating_add(area.rows).saturating_sub(1);
        if row <= area.first_row || row >= last {
            return 0;
        }
        let above = self.all_before(number, key(row - 1, column));
        let below = self.all_after(number, key(row + 1, column));
        let mut left = taxels << 1;
        if column > 0 {
            left |= self.all_before(number, key(row, column - 1)) >> (WORD - 1);
        }
        let mut right = taxels >> 1;
        if taxels >> (WORD - 1) != 0 && column < u16::MAX - WORD {
            right |= self.all_after(number, key(row, column + WORD)) << (WORD - 1);
        }
        taxels & above & below & left & right
    }

    /// Returns all touched taxels of a word that comes before run `number`.
    #[inline(never)] // M0+: out of line
    fn all_before(&self, number: usize, word: u32) -> u32 {
        let runs = self.runs.get(..number).unwrap_or(&[]);
        let last = runs.iter().rev().find(|run| run.key() <= word);
        last.filter(|run| run.key() == word).map_or(0, |run| run.all)
    }

    /// Returns all touched taxels of a word that comes after run `number`.
    #[inline(never)] // M0+: out of line
    fn all_after(&self, number: usize, word: u32) -> u32 {
        let runs = self.runs.get(number + 1..).unwrap_or(&[]);
        let first = runs.iter().find(|run| run.key() >= word);
        first.filter(|run| run.key() == word).map_or(0, |run| run.all)
    }

    /// Contact of a taxel; valid once contacts are numbered.
    pub fn contact_at(&self, area: &Area, row: u16, column: u16) -> Option<u16> {
        let word = key(area.first_row.saturating_add(row), column);
        let first = self.runs.partition_point(|run| run.key() < word);
        let mut runs = self.runs.get(first..)?.iter().take_while(|run| run.key() == word);
        self.contact_of(runs.find(|run| run.holds(column))?)
    }

    /// Contact of a run; valid once contacts are numbered.
    pub fn contact_of(&self, run: &Run) -> Option<u16> {
        let label = self.labels.get(usize::from(run.label))?;
        (label.contact != NONE).then_some(label.contact)
    }
}
