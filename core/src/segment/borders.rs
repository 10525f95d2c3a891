//! The labels along a side of a panel.

use super::bits::WORD;
use super::labeller::Labeller;
use super::run::{Run, key};
use super::union_find::{Label, NONE};
use crate::garment::{Area, Stretch};
use core::ops::Range;

/// Cursor over the taxels along a side of a panel.
pub(crate) struct SideCursor<'a> {
    runs: &'a [Run],
    labels: &'a [Label],
    edge: &'a Stretch,
    /// First row of the panel, over all panels.
    first_row: u16,
    last_row: u16,
    /// True if each taxel lies below the one before.
    is_down: bool,
    /// Last result: from taxel `asked` on, the next `taxels` that belong to one label, or [`NONE`].
    asked: i32,
    label: u16,
    taxels: Range<i32>,
    /// Index of a run; no run before it holds a taxel that comes after `taxels`.
    near: usize,
}

impl<'a> SideCursor<'a> {
    pub fn of<const RUNS: usize, const LABELS: usize>(
        labeller: &'a Labeller<RUNS, LABELS>,
        area: &Area,
        edge: &'a Stretch,
    ) -> SideCursor<'a> {
        let Area { first_row, rows, .. } = *area;
        SideCursor {
            runs: &labeller.runs,
            labels: &labeller.labels,
            edge,
            first_row,
            last_row: first_row.saturating_add(rows).saturating_sub(1),
            is_down: edge.at(1).1 > edge.at(0).1,
            asked: 0,
            label: NONE,
            taxels: -1..-1,
            near: labeller.runs.partition_point(|run| run.row < first_row),
        }
    }

    /// Returns the next label from `taxel` on, and its taxels; those before the range belong to none, those
    /// after it may belong to the same label. Returns [`NONE`] if no taxel before the end of the range is
    /// touched.
    #[inline(always)]
    pub fn from(&mut self, taxel: i32) -> (u16, Range<i32>) {
        if taxel < self.asked || taxel >= self.taxels.end {
            self.look(taxel);
        }
        (self.label, self.taxels.clone())
    }

    #[inline(never)] // M0+: out of line
    fn look(&mut self, taxel: i32) {
        let (x, y) = self.edge.at(taxel);
        let (row, column) = (self.first_row.saturating_add(y as u16), x as u16);
        if !self.is_down || taxel != self.taxels.end {
            self.near = seek(self.runs, self.near, key(row, column));
        }
        let spot = BorderColumn { column: column - column % WORD, taxel: 1 << (column % WORD) };
        let last = if self.is_down { self.last_row } else { row };
        let (skipped, found) = spot.skip(self.runs.get(self.near..).unwrap_or(&[]), last);
        self.near += skipped;
        (self.asked, self.label) = (taxel, NONE);
        let start = taxel + i32::from(found - row);
        self.taxels = start..start;
        if found <= last
            && let Some(run) = self.runs.get(self.near)
        {
            self.label = self.labels.get(usize::from(run.label)).map_or(NONE, |label| label.parent);
            self.taxels.end = start + 1;
            if self.is_down {
                // If the next run does not hold the taxel below, the label ends here.
                let next = self.runs.get(self.near + 1);
                let (passed, rows) = if next.is_some_and(|next| next.row == found || spot.is_in(next)) {
                    spot.pass(self.runs.get(self.near..).unwrap_or(&[]), found, run.label)
                } else {
                    (1, 1)
                };
                self.near += passed;
                self.taxels.end = start + i32::from(rows);
            }
        }
    }
}

/// Returns the first run from the position `word` on, searching from run `near`.
#[inline(never)] // M0+: out of line
fn seek(runs: &[Run], mut near: usize, word: u32) -> usize {
    let is_before = |number: usize| runs.get(number).is_some_and(|run| run.key() < word);
    while is_before(near) {
        near += 1;
    }
    while near > 0 && !is_before(near - 1) {
        near -= 1;
    }
    near
}

/// A column of the panel.
#[derive(Clone, Copy)]
struct BorderColumn {
    /// First column of its word.
    column: u16,
    /// Bit of the column in the word.
    taxel: u32,
}

impl BorderColumn {
    const fn is_in(&self, run: &Run) -> bool {
        run.column() == self.column && run.taxels & self.taxel != 0
    }

    /// Returns the number of runs before the next one that holds the taxel, and the row of that run; the
    /// row after `last` if there is none up to `last`.
    #[inline(never)] // M0+: out of line
    fn skip(self, runs: &[Run], last: u16) -> (usize, u16) {
        let found = runs.iter().position(|run| run.row > last || self.is_in(run));
        let number = found.unwrap_or(runs.len());
        (number, runs.get(number).map_or(u16::MAX, |run| run.row).min(last.saturating_add(1)))
    }

    /// From row `first` of a label on, returns the number of runs before the next one that holds the taxel
    /// but is of another label or follows a row without it; and the number of rows in which the label holds
    /// it.
    #[inline(never)] // M0+: out of line
    fn pass(self, runs: &[Run], first: u16, label: u16) -> (usize, u16) {
        let mut row = first;
        let another = |run: &Run| {
            let is_in = self.is_in(run);
            let another = is_in && (run.row != row || run.label != label);
            row += u16::from(is_in && !another);
            another
        };
        let passed = runs.iter().position(another).unwrap_or(runs.len());
        (passed, row - first)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::format::Name;
    use crate::garment::{Garment, Layout, Seam, SeamEdge, Side as Of};
    use crate::image::rows::Rows;
    use crate::image::view::Image;
    use std::vec;

    /// Two panels of two words a row, sewn in all ways. Asks for taxels in order, and then at random.
    #[test]
    fn the_labels_along_a_side_are_those_of_its_taxels() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 16) % end
        };
        for round in 0..256 {
            let sides = [Of::Left, Of::Right, Of::Top, Of::Bottom];
            let mut garment = Garment::recorded(40, 40);
            let mut second = garment.panels[0].clone();
            second.name = Name::try_from("second").unwrap();
            garment.panels.push(second).unwrap();
            let edges = [round, round / 4].map(|side| (sides[side % 4], next(5) as u16));
            let [a, b] = [0, 1].map(|panel| SeamEdge {
                panel,
                side: edges[panel as usize].0,
                start: edges[panel as usize].1,
            });
            garment.seams.push(Seam { a, b, length: 36, reversed: round % 3 == 0 }).unwrap();
            let layout = Layout::build(&garment, 3200, 4095).unwrap();
            let share = next(99);
            let mut values = vec![0; 3200];
            values.fill_with(|| u16::from(next(100) < share));
            let rows = Rows::of(&layout, &values);
            let mut labeller = Labeller::<1700, 1700>::new();
            labeller.scan(&layout, &Image { values: &values, rows: &rows }, 1);
            let joint = &layout.joints()[0];
            for (edge, area) in [(&joint.edge_a, &layout.areas()[0]), (&joint.edge_b, &layout.areas()[1])] {
                let label_at = |taxel| {
                    let (x, y) = edge.at(taxel);
                    let word = key(area.first_row + y as u16, x as u16);
                    let run = labeller.runs.iter().find(|run| run.key() == word && run.holds(x as u16));
                    run.map_or(NONE, |run| labeller.label_of(run).unwrap())
                };
                let mut side = SideCursor::of(&labeller, area, edge);
                let mut at = 0;
                let mut ask = |taxel| {
                    let (label, taxels) = side.from(taxel);
                    for here in taxel..taxels.end.min(36) {
                        assert_eq!(label_at(here), if here < taxels.start { NONE } else { label });
                    }
                    assert!(taxels.end > taxel);
                    taxels.end
                };
                while at < 36 {
                    at = ask(at);
                }
                for _ in 0..40 {
                    ask(next(36) as i32);
                }
            }
        }
    }
}
