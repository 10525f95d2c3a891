//! Connected components: 8-connected runs joined by union-find, row by row.

use crate::condition::{Feedback, Image};
use crate::garment::{Area, Layout};
use heapless::Vec;

/// A piece of a row in which every taxel is at least the low threshold. The first run of a part stands for the part and
/// carries its sums.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// sum f of the part; fits, since taxels and values have 16 bits
    pub mass: u32,
    /// over all panels
    pub row: u16,
    pub left: u16,
    /// last column
    pub right: u16,
    /// A run of the same part with a smaller index, or itself.
    pub parent: u16,
    /// For the first run of a part: the same, between parts that a seam joins; later the index of the contact, or [`NONE`].
    pub group: u16,
    /// taxels of the part
    pub area: u16,
    /// greatest value of the part
    pub peak: u16,
    pub panel: u8,
    /// The part comes within one taxel of a contact of the previous frame.
    pub held: bool,
    /// A seam joins the part to another.
    pub joined: bool,
}

impl Run {
    const EMPTY: Run = Run {
        mass: 0,
        row: 0,
        left: 0,
        right: 0,
        parent: 0,
        group: 0,
        area: 0,
        peak: 0,
        panel: 0,
        held: false,
        joined: false,
    };
}

/// Length, sum and greatest value of the run that a slice begins with.
#[inline(never)]
fn measure(values: &[u16], low: u16) -> (usize, u32, u16) {
    let (mut length, mut mass, mut peak) = (0, 0u32, 0u32);
    for value in values.iter().take_while(|value| **value >= low) {
        let value = u32::from(*value);
        mass = mass.wrapping_add(value);
        peak = peak.max(value);
        length += 1;
    }
    (length, mass, peak as u16)
}

/// A place as one word, in the order of the runs.
const fn key(row: u16, column: u16) -> u32 {
    (row as u32) << 16 | column as u32
}

/// No contact.
pub(super) const NONE: u16 = u16::MAX;

/// The runs of a frame, in the order of rows and columns.
#[derive(Debug, Clone)]
pub(super) struct Labels<const RUNS: usize> {
    pub runs: Vec<Run, RUNS>,
    /// Panels that have a run at their border.
    pub border: u8,
    /// Runs that did not fit, in this frame.
    pub overflow: u16,
}

impl<const RUNS: usize> Labels<RUNS> {
    pub const fn new() -> Self {
        const { assert!(RUNS < NONE as usize, "a run is numbered with 16 bits") };
        Labels { runs: Vec::new(), border: 0, overflow: 0 }
    }

    /// Finds the parts of an image: connected runs within one panel.
    pub fn scan<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        image: &Image,
        low: u16,
        last: &Feedback<CONTACTS>,
    ) {
        self.runs.clear();
        self.border = 0;
        self.overflow = 0;
        for (panel, area) in layout.areas().iter().enumerate() {
            let mut above = 0..0;
            for row in 0..area.rows {
                let start = self.runs.len();
                self.scan_row(image.row(area, row), low, panel as u8, area.first_row.saturating_add(row));
                let here = start..self.runs.len();
                if here.is_empty() {
                    above = 0..0;
                    continue;
                }
                self.mark(start, row, area, last);
                self.connect(above, here.clone());
                above = here;
            }
        }
    }

    /// Appends the runs of a row.
    fn scan_row(&mut self, values: &[u16], low: u16, panel: u8, row: u16) {
        let (mut rest, mut column) = (values, 0);
        while let Some(skipped) = rest.iter().position(|value| *value >= low) {
            rest = rest.get(skipped..).unwrap_or(&[]);
            let (length, mass, peak) = measure(rest, low);
            let left = column + skipped;
            column = left + length;
            rest = rest.get(length..).unwrap_or(&[]);
            let (left, right) = (left as u16, (column - 1) as u16);
            self.push(Run { left, right, mass, peak, row, panel, ..Run::EMPTY });
        }
    }

    fn push(&mut self, mut run: Run) {
        run.parent = self.runs.len() as u16;
        run.group = run.parent;
        run.area = run.right - run.left + 1;
        if self.runs.push(run).is_err() {
            self.overflow = self.overflow.saturating_add(1);
        }
    }

    /// Marks what the new runs of a row touch: the panel's border, contacts of the previous frame.
    fn mark<const CONTACTS: usize>(
        &mut self,
        start: usize,
        row: u16,
        area: &Area,
        last: &Feedback<CONTACTS>,
    ) {
        let edge = row == 0 || row + 1 >= area.rows;
        for run in self.runs.iter_mut().skip(start) {
            run.held = last.touches(run.panel, row, run.left, run.right);
            let border = edge || run.left == 0 || run.right + 1 >= area.columns;
            self.border |= u8::from(border) << (run.panel % 8);
        }
    }

    /// Joins the runs of two rows that follow each other where they touch, corners included.
    fn connect(&mut self, above: core::ops::Range<usize>, here: core::ops::Range<usize>) {
        let (mut i, mut j) = (above.start, here.start);
        while i < above.end && j < here.end {
            let (Some(a), Some(b)) = (self.runs.get(i).copied(), self.runs.get(j).copied()) else { return };
            if a.left <= b.right.saturating_add(1) && b.left <= a.right.saturating_add(1) {
                self.union(i as u16, j as u16);
            }
            // The one that ends first cannot touch what follows the other.
            if a.right < b.right { i += 1 } else { j += 1 }
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
        let other = *other;
        if let Some(run) = self.runs.get_mut(usize::from(first)) {
            run.mass = run.mass.wrapping_add(other.mass);
            run.area = run.area.saturating_add(other.area);
            run.peak = run.peak.max(other.peak);
            run.held |= other.held;
        }
    }

    /// The first run of the part that a run belongs to. Parents have smaller indices, so this ends; it halves the path.
    pub fn part(&mut self, mut run: u16) -> u16 {
        while let Some(parent) = self.parent(run) {
            if parent >= run {
                break;
            }
            let grandparent = self.parent(parent).unwrap_or(parent);
            if let Some(held) = self.runs.get_mut(usize::from(run)) {
                held.parent = grandparent;
            }
            run = grandparent;
        }
        run
    }

    fn parent(&self, run: u16) -> Option<u16> {
        self.runs.get(usize::from(run)).map(|run| run.parent)
    }

    /// Makes the first run of its part the parent of each run.
    pub fn flatten(&mut self) {
        for run in 0..self.runs.len() as u16 {
            let part = self.part(run);
            if let Some(run) = self.runs.get_mut(usize::from(run)) {
                run.parent = part;
            }
        }
    }

    /// The parts: index and first run.
    pub fn parts(&self) -> impl Iterator<Item = (u16, &Run)> {
        (0u16..).zip(&self.runs).filter(|(index, run)| run.parent == *index)
    }

    /// The run that holds a taxel.
    pub fn run_at(&self, area: &Area, row: u16, column: u16) -> Option<(u16, &Run)> {
        let row = area.first_row.saturating_add(row);
        let after = self.runs.partition_point(|run| key(run.row, run.left) <= key(row, column));
        let index = after.checked_sub(1)?;
        let run = self.runs.get(index)?;
        (run.row == row && column <= run.right).then_some((index as u16, run))
    }

    /// The contact that a taxel belongs to, once contacts are numbered.
    pub fn contact_at(&self, area: &Area, row: u16, column: u16) -> Option<u16> {
        let (_, run) = self.run_at(area, row, column)?;
        self.contact_of(run)
    }

    /// The contact that a run belongs to, once contacts are numbered.
    pub fn contact_of(&self, run: &Run) -> Option<u16> {
        let part = self.runs.get(usize::from(run.parent))?;
        (part.group != NONE).then_some(part.group)
    }
}
