//! Connected components: 8-connected runs joined by union-find, row by row.

use super::run::{NONE, Run, Stretch, key};
use crate::condition::{Feedback, Image, row_of};
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
            self.scan_panel(panel, area, image, low);
        }
        self.flatten();
    }

    #[inline(never)] // a stack frame of its own is near
    fn scan_panel(&mut self, panel: u8, area: &Area, image: &Image, low: u16) {
        let start = self.runs.len();
        let last = area.first_row.saturating_add(area.rows);
        let (mut above, mut from) = (start, area.first_row);
        while let Some(number) = image.rows.next(from..last) {
            let here = self.runs.len();
            let row = row_of(image.values, area, number - area.first_row);
            // Only rows that follow each other touch.
            self.scan_row(row, low, panel, number, if number == from { above } else { here });
            (above, from) = (here, number + 1);
        }
        self.mark_sides(start, panel, area);
    }

    /// Appends the runs of a row, and joins them to those of the row above, the first of which is `above`.
    #[inline(never)]
    fn scan_row(&mut self, values: &[u16], low: u16, panel: u8, row: u16, above: usize) {
        let mut above = above..self.runs.len();
        let (mut rest, mut column) = (values, 0);
        while let Some(quiet) = rest.iter().position(|value| *value >= low) {
            rest = rest.get(quiet..).unwrap_or(&[]);
            let Stretch { length, mass, peak } = Stretch::of(rest, low.into());
            let left = column + quiet as u16;
            column = left + length as u16;
            rest = rest.get(length..).unwrap_or(&[]);
            let index = self.runs.len() as u16;
            let run = Run {
                mass,
                row,
                left,
                right: column - 1,
                parent: index,
                group: index,
                contact: NONE,
                area: length as u16,
                peak: peak as u16,
                panel,
                held: false,
                joined: false,
                covers: 0,
            };
            match self.runs.push(run) {
                Ok(()) if above.is_empty() => {}
                Ok(()) => above.start = self.connect(above.clone()),
                Err(_) => self.overflow = self.overflow.saturating_add(1),
            }
        }
    }

    /// Marks the sides of a panel that its runs touch, which are those from `start` on.
    fn mark_sides(&mut self, start: usize, panel: u8, area: &Area) {
        let runs = self.runs.get(start..).unwrap_or(&[]);
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else { return };
        let mut mark = |touched: bool, side| {
            if touched {
                self.sides |= bit(panel, side);
            }
        };
        mark(first.row == area.first_row, Side::Top);
        mark(last.row - area.first_row + 1 >= area.rows, Side::Bottom);
        mark(runs.iter().any(|run| run.left == 0), Side::Left);
        mark(runs.iter().any(|run| run.right + 1 >= area.columns), Side::Right);
    }

    /// Whether a run touches that side of a panel.
    pub const fn touches(&self, panel: u8, side: Side) -> bool {
        self.sides & bit(panel, side) != 0
    }

    /// Joins the last run to those of the row above that it touches, corners included. The first of these that may touch the
    /// next run of the row.
    #[inline(never)] // the few registers of an M0+ are for this
    fn connect(&mut self, above: Range<usize>) -> usize {
        let mut other = above.start;
        let Some((last, runs)) = self.runs.split_last_mut() else { return other };
        let (left, right) = (u32::from(last.left), u32::from(last.right));
        while other < above.end {
            let Some(run) = runs.get_mut(other) else { break };
            let (begin, end) = (u32::from(run.left), u32::from(run.right));
            if begin > right + 1 {
                break;
            }
            if end + 1 >= left {
                if left <= begin + 1 && end <= right + 1 {
                    run.covers += 1;
                }
                if begin <= left + 1 && right <= end + 1 {
                    last.covers += 1;
                }
                let part = part(runs, other as u16);
                // The first to be joined to takes it; another is united with that.
                let (first, second) = (last.parent.min(part), last.parent.max(part));
                if let Some(run) = runs.get_mut(usize::from(second)) {
                    run.parent = first;
                }
                last.parent = first;
                // What ends further right may touch the next run, too.
                if end > right {
                    break;
                }
            }
            other += 1;
        }
        other
    }

    /// Makes the first run of its part the parent of each run, and gives it the sums of all.
    #[inline(never)] // the few registers of an M0+ are for this
    fn flatten(&mut self) {
        for index in 0..self.runs.len() {
            let Some(run) = self.runs.get(index) else { return };
            let parent = usize::from(run.parent);
            if parent >= index {
                continue;
            }
            // Those before it have the first run of theirs already.
            let (mass, area, peak) = (run.mass, run.area, run.peak);
            let Some(first) = self.runs.get(parent).map(|run| run.parent) else { return };
            if let Some(run) = self.runs.get_mut(index) {
                run.parent = first;
            }
            if let Some(part) = self.runs.get_mut(usize::from(first)) {
                part.add(mass, area, peak);
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
        let mut rest = 0;
        core::iter::from_fn(move || {
            let index = self.next_part(rest)?;
            rest = index + 1;
            Some((index, self.runs.get(usize::from(index))?))
        })
    }

    /// The first run from `index` on that is the first of its part.
    #[inline(never)] // the few registers of an M0+ are for its loop
    fn next_part(&self, mut index: u16) -> Option<u16> {
        for run in self.runs.get(usize::from(index)..)? {
            if run.parent == index {
                return Some(index);
            }
            index += 1;
        }
        None
    }

    /// The runs of some rows, over all panels.
    pub fn in_rows(&self, first: u16, last: u16) -> &[Run] {
        let from = self.runs.partition_point(|run| run.row < first);
        let (_, runs) = self.runs.split_at_checked(from).unwrap_or_default();
        let count = runs.partition_point(|run| run.row <= last);
        runs.get(..count).unwrap_or(runs)
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

/// The first run of the part that a run belongs to. Parents have smaller indices, so this ends; it halves the path.
fn part(runs: &mut [Run], mut run: u16) -> u16 {
    let parent = |runs: &[Run], run: u16| runs.get(usize::from(run)).map_or(run, |run| run.parent);
    loop {
        let above = parent(runs, run);
        if above >= run {
            return run;
        }
        let first = parent(runs, above);
        if first >= above {
            return above;
        }
        if let Some(held) = runs.get_mut(usize::from(run)) {
            held.parent = first;
        }
        run = first;
    }
}
