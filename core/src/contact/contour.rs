//! The contour of a contact: how long it is, and how steep.

use super::component::Component;
use super::label::Labels;
use super::run::Run;
use crate::condition::{Image, Neighbourhood};
use crate::garment::{Area, Layout};

/// A row with what lies above and below it.
struct Line<'a> {
    around: Neighbourhood<'a>,
    /// The first or the last row of the panel.
    border: bool,
}

impl<'a> Line<'a> {
    /// The row of a run.
    fn of(run: &Run, area: &Area, values: &'a [u16]) -> Line<'a> {
        let row = run.row - area.first_row;
        Line { around: Neighbourhood::of(values, area, row), border: row == 0 || row + 1 >= area.rows }
    }
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
    /// Of component `index`.
    pub fn of<const RUNS: usize>(
        index: u16,
        component: &Component,
        labels: &Labels<RUNS>,
        layout: &Layout,
        image: &Image,
        low: u16,
    ) -> Contour {
        let mut contour = Contour { length: 0, slope: 0 };
        for run in component.runs(index, labels, layout) {
            if let Some(area) = layout.areas().get(usize::from(run.panel)) {
                contour.add(run, &Line::of(run, area, image.values), low);
            }
        }
        contour
    }

    /// Adds what a run has of it.
    #[inline(never)] // the few registers of an M0+ are for this
    fn add(&mut self, run: &Run, line: &Line, low: u16) {
        let (left, right, around) = (run.left, run.right, &line.around);
        self.take(around, left);
        if left == right {
            return;
        }
        self.take(around, right);
        // Between the ends only what is above and below matters.
        if line.border {
            (left + 1..right).for_each(|column| self.take(around, column));
        } else if !run.is_inside() && right - left > 1 {
            let [above, below] = around.beside(left + 1, right - 1);
            for (column, (above, below)) in (left + 1..).zip(above.iter().zip(below)) {
                if *above < low || *below < low {
                    self.take(around, column);
                }
            }
        }
    }

    fn take(&mut self, around: &Neighbourhood, column: u16) {
        self.length = self.length.wrapping_add(1);
        self.slope = self.slope.wrapping_add(steepness(around, column) >> 3);
    }
}

/// Sobel magnitude.
#[inline(never)] // the few registers of an M0+ are for this
fn steepness(around: &Neighbourhood, column: u16) -> u32 {
    around.gradient(column).magnitude()
}
