//! The labels and runs of a frame: what the scan of its rows fills in, and the stages after it read.

use super::bits::WORD;
use super::run::Run;
use super::strip::strips;
use super::union_find::{Label, NONE};
use crate::garment::{Area, PANELS, Side};
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

/// Position of the scan in a panel, and what it has found so far.
#[derive(Clone, Copy)]
pub(crate) struct ScanLine {
    pub panel: u8,
    /// Row, counted over all panels.
    pub row: u16,
    /// Index of the first run of the row above, or of this row if the row above has none.
    pub above: usize,
    /// Fast path of rows of one word: dilated mask and label of the row above, if it is all one label.
    pub reach: u32,
    pub label: u16,
    /// Taxels touched so far in the first and in the last words of the panel's rows.
    pub ends: [u32; 2],
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

    /// Appends a run to its label, or to a new label if that is [`NONE`]. Returns the label, and the run if
    /// there is room.
    #[inline(always)]
    pub fn push(&mut self, mut run: Run, panel: u8) -> (u16, Option<&mut Run>) {
        let mut fits = true;
        if run.label == NONE {
            run.label = self.labels.len() as u16;
            fits = self.labels.push(Label::new(run.label, panel)).is_ok();
        }
        let label = run.label;
        if !fits || self.runs.push(run).is_err() {
            self.overflow = self.overflow.saturating_add(1);
            return (label, None);
        }
        (label, self.runs.last_mut())
    }

    /// Marks the sides of a panel that its runs, those from `start` on, touch.
    pub(super) fn mark_sides(&mut self, start: usize, area: &Area, line: &ScanLine) {
        let runs = self.runs.get(start..).unwrap_or(&[]);
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else { return };
        let [left, right] = line.ends;
        let mut mark = |touched: bool, side| {
            if touched {
                self.sides |= bit(line.panel, side);
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

    /// Adds the sums of the runs from `start` on to their labels.
    #[inline(never)] // M0+: out of line
    pub(super) fn weigh(&mut self, start: usize) {
        for runs in strips(self.runs.get(start..).unwrap_or(&[])) {
            let (mut mass, mut area, mut peak) = (0u32, 0u32, 0);
            for run in runs {
                mass = mass.wrapping_add(run.sums.s0);
                area = area.wrapping_add(run.area.into());
                if run.peak > peak {
                    peak = run.peak;
                }
            }
            let label = runs.first().and_then(|run| self.labels.get_mut(usize::from(run.label)));
            if let Some(label) = label {
                label.add(mass, area.min(u16::MAX.into()) as u16, peak);
            }
        }
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
