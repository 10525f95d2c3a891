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
        let above = self.before(number, key(row - 1, column), taxels);
        let below = self.after(number, key(row + 1, column), taxels);
        let mut left = taxels << 1;
        if column > 0 {
            left |= self.before(number, key(row, column - 1), 1 << (WORD - 1)) >> (WORD - 1);
        }
        let mut right = taxels >> 1;
        if taxels >> (WORD - 1) != 0 && column < u16::MAX - WORD {
            right |= self.after(number, key(row, column + WORD), 1) << (WORD - 1);
        }
        taxels & above & below & left & right
    }

    /// Returns which of the `wanted` taxels of a word that comes before run `number` are touched; bits of
    /// others may be set.
    #[inline(never)] // M0+: out of line
    fn before(&self, number: usize, word: u32, wanted: u32) -> u32 {
        let mut runs = self.runs.get(..number).unwrap_or(&[]).iter().rev();
        let last = runs.find(|run| run.key() <= word);
        union(last, runs, word, wanted)
    }

    /// Returns which of the `wanted` taxels of a word that comes after run `number` are touched; bits of
    /// others may be set.
    #[inline(never)] // M0+: out of line
    fn after(&self, number: usize, word: u32, wanted: u32) -> u32 {
        let mut runs = self.runs.get(number + 1..).unwrap_or(&[]).iter();
        let first = runs.find(|run| run.key() >= word);
        union(first, runs, word, wanted)
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

/// The taxels of the runs of a word, `first` and those that follow, until they hold all `wanted` ones.
#[inline(always)]
fn union<'a>(first: Option<&Run>, rest: impl Iterator<Item = &'a Run>, word: u32, wanted: u32) -> u32 {
    let Some(first) = first.filter(|run| run.key() == word) else { return 0 };
    let mut all = first.taxels;
    if wanted & !all != 0 {
        all = rest.take_while(|run| run.key() == word).fold(all, |all, run| all | run.taxels);
    }
    all
}
