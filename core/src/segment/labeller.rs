//! The labels and runs of a frame: what the scan of its rows fills in, and the stages after it read.

use super::run::{Run, WORD, key};
use super::union_find::{Label, NONE};
use crate::baseline::feedback::{Feedback, Pressed};
use crate::garment::{Area, Layout, PANELS, Rect, Side};
use heapless::Vec;

/// The labels and runs of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Labeller<const RUNS: usize, const LABELS: usize> {
    /// Runs in the order of rows, then words.
    pub runs: Vec<Run, RUNS>,
    /// Labels in the order of their first taxels.
    pub labels: Vec<Label, LABELS>,
    /// Sides of panels that a run touches, four bits for each panel.
    sides: u32,
    /// Number of runs of this frame that did not fit, or whose labels did not.
    pub overflow: u16,
}

/// Returns the bit of a side among the four of its panel.
const fn bit(panel: u8, side: Side) -> u32 {
    const { assert!(PANELS <= 8, "four bits for each panel") };
    1 << (panel as u32 % 8 * 4 + side as u32)
}

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    pub const fn new() -> Self {
        const { assert!(LABELS < NONE as usize, "a label is numbered with 16 bits") };
        Labeller { runs: Vec::new(), labels: Vec::new(), sides: 0, overflow: 0 }
    }

    /// Empties all lists.
    pub fn clear(&mut self) {
        self.runs.clear();
        self.labels.clear();
        self.sides = 0;
        self.overflow = 0;
    }

    /// Appends a run of these values, and adds its sums to its label, or to a new label if that is [`NONE`].
    #[inline(always)]
    pub(super) fn push(&mut self, mut run: Run, values: &[u16], panel: u8) {
        let mut fits = true;
        if run.label == NONE {
            run.label = self.labels.len() as u16;
            fits = self.labels.push(Label::new(run.label, panel)).is_ok();
        }
        let label = usize::from(run.label);
        if !fits || self.runs.push(run).is_err() {
            self.overflow = self.overflow.saturating_add(1);
        } else if let (Some(run), Some(label)) = (self.runs.last_mut(), self.labels.get_mut(label)) {
            // Summed in place: nothing is copied.
            run.peak = run.sums.take(values);
            label.add(run.sums.s0, values.len() as u16, run.peak);
        }
    }

    /// Marks the sides of a panel that its runs, those from `start` on, touch. `ends`: what they touch of the
    /// first and of the last words of its rows.
    pub(super) fn mark_sides(&mut self, start: usize, panel: u8, area: &Area, ends: [u32; 2]) {
        let runs = self.runs.get(start..).unwrap_or(&[]);
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else { return };
        let [left, right] = ends;
        let mut mark = |touched: bool, side| {
            if touched {
                self.sides |= bit(panel, side);
            }
        };
        mark(first.row == area.first_row, Side::Top);
        mark(last.row - area.first_row + 1 >= area.rows, Side::Bottom);
        mark(left & 1 == 1, Side::Left);
        mark(right >> (area.columns.saturating_sub(1) % WORD) & 1 == 1, Side::Right);
    }

    /// True if a run touches that side of a panel.
    pub const fn touches(&self, panel: u8, side: Side) -> bool {
        self.sides & bit(panel, side) != 0
    }

    /// Makes the root the parent of each label, and gives it the sums of all.
    pub(super) fn flatten(&mut self) {
        for index in 0..self.labels.len() {
            let Some(label) = self.labels.get(index) else { return };
            let parent = usize::from(label.parent);
            if parent >= index {
                continue;
            }
            // Labels before this one have their root as parent already.
            let (mass, area, peak) = (label.mass, label.area, label.peak as u16);
            let Some(first) = self.labels.get(parent).map(|label| label.parent) else { return };
            if let Some(label) = self.labels.get_mut(index) {
                label.parent = first;
            }
            if let Some(label) = self.labels.get_mut(usize::from(first)) {
                label.add(mass, area, peak);
            }
        }
    }

    /// Renumbers contacts after component `lost` has become part of `whole`: those after it move up.
    pub fn renumber(&mut self, whole: u16, lost: u16) {
        for label in self.labels.iter_mut().filter(|label| label.contact != NONE) {
            let contact = if label.contact == lost { whole } else { label.contact };
            label.contact = contact - u16::from(contact > lost);
        }
    }

    /// Roots with their indices.
    pub fn roots(&self) -> impl Iterator<Item = (u16, &Label)> {
        (0u16..).zip(&self.labels).filter(|(index, label)| label.parent == *index)
    }

    /// Marks the labels that come within one taxel of a contact of the previous frame: faint ones continue
    /// it. Only labels that begin no contact by themselves need the mark, and most frames have none.
    pub fn mark_held<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        last: &Feedback<CONTACTS>,
        high: u16,
    ) {
        // The least peak is at most twice the threshold.
        if self.roots().all(|(_, label)| label.peak >= 2 * u32::from(high)) {
            return;
        }
        for Pressed { rect, .. } in last.home.iter().chain(&last.beyond) {
            if let Some(area) = layout.areas().get(usize::from(rect.panel)) {
                self.mark_held_by(area, rect);
            }
        }
    }

    fn mark_held_by(&mut self, area: &Area, rect: &Rect) {
        let top = area.first_row.saturating_add(rect.top.saturating_sub(1));
        let bottom = area.first_row.saturating_add(rect.bottom.saturating_add(1));
        let (left, right) = (rect.left.saturating_sub(1), rect.right.saturating_add(1));
        let from = self.runs.partition_point(|run| run.row < top);
        for run in self.runs.iter().skip(from).take_while(|run| run.row <= bottom) {
            let label = self.labels.get(usize::from(run.label)).filter(|label| label.panel == rect.panel);
            if let Some(first) =
                label.map(|label| label.parent).filter(|_| !run.within(left, right).is_empty())
                && let Some(label) = self.labels.get_mut(usize::from(first))
            {
                label.held = true;
            }
        }
    }

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
        let (&Run { taxels, row, .. }, column) = (run, run.column());
        let last = area.first_row.saturating_add(area.rows).saturating_sub(1);
        let mut left = taxels << 1;
        if taxels & 1 != 0 && column > 0 {
            left |= self.before(number, key(row, column - 1), 1 << (WORD - 1)) >> (WORD - 1);
        }
        let mut right = taxels >> 1;
        if taxels >> (WORD - 1) != 0 && column < u16::MAX - WORD {
            right |= self.after(number, key(row, column + WORD), 1) << (WORD - 1);
        }
        let inside = taxels & left & right;
        if inside == 0 || row <= area.first_row || row >= last {
            return 0;
        }
        let above = self.before(number, key(row - 1, column), inside);
        inside & above & self.after(number, key(row + 1, column), inside)
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
        let place = (area.first_row.saturating_add(row), column);
        let run = self.runs.get(self.runs.partition_point(|run| (run.row, run.right) < place))?;
        self.contact_of(run).filter(|_| (run.row, run.left) <= place)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contacts_behind_a_lost_one_move_up() {
        let mut labeller = Labeller::<8, 8>::new();
        for (label, contact) in [0, 1, NONE, 2, 3, 1].into_iter().enumerate() {
            let _ = labeller.labels.push(Label { contact, ..Label::new(label as u16, 0) });
        }
        let after = |whole, lost| {
            let mut labeller = labeller.clone();
            labeller.renumber(whole, lost);
            labeller.labels.iter().map(|label| label.contact).collect::<Vec<u16, 8>>()
        };
        assert_eq!(after(0, 1)[..], [0, 0, NONE, 1, 2, 0]);
        assert_eq!(after(3, 1)[..], [0, 2, NONE, 1, 2, 2]);
        assert_eq!(after(0, 3)[..], [0, 1, NONE, 2, 0, 1]);
    }
}
