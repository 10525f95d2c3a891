//! The contour of a contact: how long it is, and how steep.

use super::run::Run;
use crate::condition::Neighbourhood;

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

    /// Adds what a run has of it; `border` says that its row is the first or the last of the panel.
    #[inline(never)] // the few registers of an M0+ are for this
    pub fn add(&mut self, run: &Run, around: &Neighbourhood, border: bool, low: u16) {
        let (left, right) = (run.left, run.right);
        self.take(around, left);
        if left == right {
            return;
        }
        self.take(around, right);
        // Between the ends only what is above and below matters.
        if border {
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
