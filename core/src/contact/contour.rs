//! The contour of a contact: how long it is, and how steep.

use super::component::Component;
use super::label::Labels;
use crate::condition::{Image, Neighbourhood, Sixteen, gradient_of_sixteens};
use crate::garment::Layout;

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
    pub fn of<const RUNS: usize, const PARTS: usize>(
        index: u16,
        component: &Component,
        labels: &Labels<RUNS, PARTS>,
        layout: &Layout,
        image: &Image,
    ) -> Contour {
        let mut contour = Contour { length: 0, slope: 0 };
        for (number, piece) in component.pieces(labels, layout) {
            let Some(part) = labels.parts.get(usize::from(piece.part)) else { continue };
            let Some(area) = layout.areas().get(usize::from(part.panel)) else { continue };
            if part.contact == index {
                let outline = piece.taxels & !labels.enclosed(number, piece, area);
                let around = Neighbourhood::of(image.values, area, piece.row - area.first_row);
                contour.add(outline, piece.column(), &around);
            }
        }
        contour
    }

    /// Adds some taxels of the word that begins at a column.
    #[inline(never)] // the few registers of an M0+ are for this
    fn add(&mut self, taxels: u32, column: u16, around: &Neighbourhood) {
        let sixteens = around.sixteens();
        let mut rest = taxels;
        while rest != 0 {
            let taxel = column + rest.trailing_zeros() as u16;
            rest &= rest - 1;
            self.length = self.length.wrapping_add(1);
            let steepness = match sixteens {
                Some([above, here, below]) => steepness_of_sixteens(above, here, below, taxel),
                None => steepness(around, taxel),
            };
            self.slope = self.slope.wrapping_add(steepness >> 3);
        }
    }
}

/// Sobel magnitude in rows of sixteen columns.
#[inline(never)] // the few registers of an M0+ are for this
fn steepness_of_sixteens(above: &Sixteen, here: &Sixteen, below: &Sixteen, column: u16) -> u32 {
    gradient_of_sixteens([above, here, below], column).magnitude()
}

/// Sobel magnitude.
#[inline(never)] // the few registers of an M0+ are for this
fn steepness(around: &Neighbourhood, column: u16) -> u32 {
    around.gradient(column).magnitude()
}
