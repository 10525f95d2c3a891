//! The contour of a contact: how long it is, and how steep.

use super::run::{Run, key};
use crate::condition::{Image, Neighbourhood};
use crate::garment::Area;

/// The row whose runs are being measured.
pub(super) struct Line<'a> {
    around: Neighbourhood<'a>,
    /// over all panels
    number: Option<u16>,
    /// in the panel
    pub row: u16,
    /// The first or the last row of the panel.
    edge: bool,
    /// Index of a run: those before it end above this row's, and further left.
    above: usize,
    /// As `above`, one row below.
    below: usize,
}

impl<'a> Line<'a> {
    /// Before the first row.
    pub const NONE: Line<'static> =
        Line { around: Neighbourhood::NONE, number: None, row: 0, edge: true, above: 0, below: 0 };

    /// Whether it is the row of a run.
    pub fn is_of(&self, run: &Run) -> bool {
        self.number == Some(run.row)
    }

    /// The row of a run that comes later.
    pub fn moved(&self, run: &Run, area: &Area, image: &Image<'a>) -> Line<'a> {
        let row = run.row.saturating_sub(area.first_row);
        let edge = row == 0 || row + 1 >= area.rows;
        let follows = !edge && self.number.is_some_and(|number| number + 1 == run.row);
        Line {
            around: if follows {
                self.around.next(image.values, area, row)
            } else {
                Neighbourhood::of(image.values, area, row)
            },
            number: Some(run.row),
            row,
            edge,
            above: self.above,
            below: self.below,
        }
    }

    /// The values of a run.
    pub fn piece(&self, run: &Run) -> &'a [u16] {
        piece(self.around.rows()[1], run.left, run.right)
    }

    /// Whether all taxels above and below the columns `left ..= right` belong to one run each. Asked from left to right.
    fn is_inside(&mut self, runs: &[Run], left: u16, right: u16) -> bool {
        let Some(number) = self.number.filter(|_| !self.edge) else { return false };
        let covered = |at: &mut usize, row: u16| {
            let place = key(row, left);
            while runs.get(*at).is_some_and(|run| key(run.row, run.right) < place) {
                *at += 1;
            }
            runs.get(*at).is_some_and(|run| run.covers(row, left, right))
        };
        covered(&mut self.above, number.saturating_sub(1))
            && covered(&mut self.below, number.saturating_add(1))
    }
}

/// Columns `left ..= right` of a row.
fn piece(row: &[u16], left: u16, right: u16) -> &[u16] {
    let rest = row.get(usize::from(left)..).unwrap_or(&[]);
    rest.get(..=usize::from(right - left)).unwrap_or(rest)
}

/// The taxels of a contact with at least one of four neighbours in the panel, or beyond its border, below the threshold.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contour {
    /// How many there are; a garment has fewer than 2^16.
    pub length: u32,
    /// Sum of their Sobel magnitudes, in eighths: none is above the full scale, so that 32 bits do.
    pub slope: u32,
}

impl Contour {
    pub const NONE: Contour = Contour { length: 0, slope: 0 };

    /// Adds what a run has of it.
    pub fn add(&mut self, run: &Run, line: &mut Line, runs: &[Run], low: u16) {
        let (left, right) = (u32::from(run.left), u32::from(run.right));
        if line.edge {
            return (left..right + 1).for_each(|column| self.take(line, column));
        }
        self.take(line, left);
        if left == right {
            return;
        }
        self.take(line, right);
        // Between the ends only what is above and below matters.
        if right - left > 1 && !line.is_inside(runs, run.left + 1, run.right - 1) {
            let [above, _, below] = line.around.rows();
            let inner = |row| piece(row, run.left + 1, run.right - 1);
            for (column, (above, below)) in (left + 1..).zip(inner(above).iter().zip(inner(below))) {
                if *above < low || *below < low {
                    self.take(line, column);
                }
            }
        }
    }

    fn take(&mut self, line: &Line, column: u32) {
        self.length = self.length.wrapping_add(1);
        self.slope = self.slope.wrapping_add(line.around.gradient(column as usize).magnitude() >> 3);
    }
}
