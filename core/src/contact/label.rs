//! Connected components: 8-connected runs joined by union-find, row by row.

use super::run::{NONE, Run, Stretch, key};
use crate::condition::{Feedback, Image};
use crate::garment::{Area, Layout, Rect, Side};
use core::ops::Range;
use heapless::Vec;

/// The runs of a frame, in the order of rows and columns.
#[derive(Debug, Clone)]
pub(super) struct Labels<const RUNS: usize> {
    pub runs: Vec<Run, RUNS>,
    /// Sides of panels that have a run, four bits for each panel.
    sides: u32,
    /// Runs that did not fit, in this frame.
    pub overflow: u16,
}

/// The bit of a side among the four of its panel.
const fn bit(panel: u8, side: Side) -> u32 {
    1 << (panel as u32 % 8 * 4 + side as u32)
}

impl<const RUNS: usize> Labels<RUNS> {
    pub const fn new() -> Self {
        const { assert!(RUNS < NONE as usize, "a run is numbered with 16 bits") };
        Labels { runs: Vec::new(), sides: 0, overflow: 0 }
    }

    /// Finds the parts of an image: connected runs within one panel.
    pub fn scan(&mut self, layout: &Layout, image: &Image, low: u16) {
        self.runs.clear();
        self.sides = 0;
        self.overflow = 0;
        if image.rows.is_empty() {
            return;
        }
        for (panel, area) in (0u8..).zip(layout.areas()) {
            let last = area.first_row.saturating_add(area.rows);
            let (mut above, mut from) = (0..0, area.first_row);
            while let Some(number) = image.rows.next(from..last) {
                let start = self.runs.len();
                let row = number - area.first_row;
                self.scan_row(image.row(area, row), low, panel, number);
                let here = start..self.runs.len();
                if !here.is_empty() {
                    self.mark_sides(start, panel, row, area);
                    if number == from {
                        self.connect(above, here.clone());
                    }
                }
                (above, from) = (here, number + 1);
            }
        }
        self.flatten();
    }

    /// Appends the runs of a row.
    fn scan_row(&mut self, values: &[u16], low: u16, panel: u8, row: u16) {
        let (mut rest, mut column) = (values, 0);
        while let Some(skipped) = rest.iter().position(|value| *value >= low) {
            rest = rest.get(skipped..).unwrap_or(&[]);
            let Stretch { length, mass, peak } = Stretch::of(rest, low.into());
            let left = column + skipped;
            column = left + length;
            rest = rest.get(length..).unwrap_or(&[]);
            let index = self.runs.len() as u16;
            let run = Run {
                mass,
                row,
                left: left as u16,
                right: (column - 1) as u16,
                parent: index,
                group: index,
                contact: NONE,
                area: length as u16,
                peak: peak as u16,
                panel,
                held: false,
                joined: false,
            };
            if self.runs.push(run).is_err() {
                self.overflow = self.overflow.saturating_add(1);
            }
        }
    }

    /// Marks the sides of the panel that the new runs of a row touch.
    fn mark_sides(&mut self, start: usize, panel: u8, row: u16, area: &Area) {
        let mut mark = |touched: bool, side| {
            if touched {
                self.sides |= bit(panel, side);
            }
        };
        mark(row == 0, Side::Top);
        mark(row + 1 >= area.rows, Side::Bottom);
        mark(self.runs.get(start).is_some_and(|run| run.left == 0), Side::Left);
        mark(self.runs.last().is_some_and(|run| run.right + 1 >= area.columns), Side::Right);
    }

    /// Whether a run touches that side of a panel.
    pub const fn touches(&self, panel: u8, side: Side) -> bool {
        self.sides & bit(panel, side) != 0
    }

    /// Joins the runs of two rows that follow each other where they touch, corners included.
    fn connect(&mut self, above: Range<usize>, here: Range<usize>) {
        let (mut i, mut j) = (above.start, here.start);
        let ends = |labels: &Self, index: usize| {
            labels.runs.get(index).map_or((0, 0), |run| (u32::from(run.left), u32::from(run.right)))
        };
        let (mut a, mut b) = (ends(self, i), ends(self, j));
        while i < above.end && j < here.end {
            if a.0 <= b.1 + 1 && b.0 <= a.1 + 1 {
                self.union(i as u16, j as u16);
            }
            // The one that ends first cannot touch what follows the other.
            if a.1 < b.1 {
                i += 1;
                a = ends(self, i);
            } else {
                j += 1;
                b = ends(self, j);
            }
        }
    }

    fn union(&mut self, a: u16, b: u16) {
        let (a, b) = (self.part(a), self.part(b));
        let (first, second) = (a.min(b), a.max(b));
        if first == second {
            return;
        }
        let Some(other) = self.runs.get_mut(usize::from(second)) else { return };
        other.parent = first;
        let (mass, area, peak) = (other.mass, other.area, other.peak);
        if let Some(run) = self.runs.get_mut(usize::from(first)) {
            run.mass = run.mass.wrapping_add(mass);
            run.area = run.area.saturating_add(area);
            run.peak = run.peak.max(peak);
        }
    }

    /// The first run of the part that a run belongs to. Parents have smaller indices, so this ends; it halves the path.
    fn part(&mut self, mut run: u16) -> u16 {
        loop {
            let parent = self.parent(run);
            if parent >= run {
                return run;
            }
            let grandparent = self.parent(parent);
            if grandparent >= parent {
                return parent;
            }
            if let Some(held) = self.runs.get_mut(usize::from(run)) {
                held.parent = grandparent;
            }
            run = grandparent;
        }
    }

    fn parent(&self, run: u16) -> u16 {
        self.runs.get(usize::from(run)).map_or(run, |run| run.parent)
    }

    /// Makes the first run of its part the parent of each run: those before it have it already.
    fn flatten(&mut self) {
        for index in 0..self.runs.len() as u16 {
            let parent = self.parent(index);
            if parent < index {
                let part = self.parent(parent);
                if let Some(run) = self.runs.get_mut(usize::from(index)) {
                    run.parent = part;
                }
            }
        }
    }

    /// Marks the parts that come within one taxel of a contact of the previous frame. Only of parts with a peak below
    /// `high` that is asked, and most frames have none.
    pub fn mark_held<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        last: &Feedback<CONTACTS>,
        high: u16,
    ) {
        if self.parts().all(|(_, run)| run.peak >= high) {
            return;
        }
        for rect in last.home.iter().chain(&last.beyond) {
            if let Some(area) = layout.areas().get(usize::from(rect.panel)) {
                self.mark_held_by(area, rect);
            }
        }
    }

    fn mark_held_by(&mut self, area: &Area, rect: &Rect) {
        let top = area.first_row.saturating_add(rect.top.saturating_sub(1));
        let bottom = area.first_row.saturating_add(rect.bottom.saturating_add(1));
        for index in self.runs.partition_point(|run| run.row < top)..self.runs.len() {
            let Some(run) = self.runs.get(index).filter(|run| run.row <= bottom) else { return };
            let beside = run.right.saturating_add(1) >= rect.left && run.left <= rect.right.saturating_add(1);
            if beside && run.panel == rect.panel {
                let part = run.parent;
                if let Some(part) = self.runs.get_mut(usize::from(part)) {
                    part.held = true;
                }
            }
        }
    }

    /// The parts: index and first run.
    pub fn parts(&self) -> impl Iterator<Item = (u16, &Run)> {
        (0u16..).zip(&self.runs).filter(|(index, run)| run.parent == *index)
    }

    /// How many runs begin before or at a place of a panel.
    pub fn before(&self, area: &Area, row: u16, column: u16) -> usize {
        let place = key(area.first_row.saturating_add(row), column);
        self.runs.partition_point(|run| run.key() <= place)
    }

    /// As [`Labels::before`], for a place not far from another, of which it was `near`.
    pub fn before_near(&self, near: usize, area: &Area, row: u16, column: u16) -> usize {
        let place = key(area.first_row.saturating_add(row), column);
        let begins = |index: usize| self.runs.get(index).is_some_and(|run| run.key() <= place);
        let mut count = near.min(self.runs.len());
        while begins(count) {
            count += 1;
        }
        while count > 0 && !begins(count - 1) {
            count -= 1;
        }
        count
    }

    /// The run that holds a taxel, where so many begin before or at it.
    pub fn holding(&self, before: usize, area: &Area, row: u16, column: u16) -> Option<&Run> {
        let run = self.runs.get(before.checked_sub(1)?)?;
        run.covers(area.first_row.saturating_add(row), column, column).then_some(run)
    }

    /// The contact that a taxel belongs to, once contacts are numbered.
    pub fn contact_at(&self, area: &Area, row: u16, column: u16) -> Option<u16> {
        self.contact_of(self.holding(self.before(area, row, column), area, row, column)?)
    }

    /// The contact that a run belongs to, once contacts are numbered.
    pub fn contact_of(&self, run: &Run) -> Option<u16> {
        let part = self.runs.get(usize::from(run.parent))?;
        (part.contact != NONE).then_some(part.contact)
    }
}
