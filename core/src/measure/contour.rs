//! The contour of a contact: its length and its steepness.

use super::component::Component;
use super::sobel::{Neighbourhood, steepness_of_rows16};
use crate::garment::Layout;
use crate::image::view::Image;
use crate::segment::labeller::Labeller;

/// Contour of a contact: its taxels with at least one of the four neighbours below the threshold or outside
/// the panel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contour {
    /// Number of taxels; a garment has fewer than 2^16.
    pub length: u32,
    /// Sum of their Sobel magnitudes / 8; fits in 32 bits, since none of these exceeds full scale.
    pub slope: u32,
}

impl Contour {
    /// Returns the contour of component `index`.
    pub fn of<const RUNS: usize, const LABELS: usize>(
        index: u16,
        component: &Component,
        labeller: &Labeller<RUNS, LABELS>,
        layout: &Layout,
        image: &Image,
    ) -> Contour {
        let mut contour = Contour { length: 0, slope: 0 };
        for (number, run) in component.runs(labeller, layout) {
            let Some(label) = labeller.labels.get(usize::from(run.label)) else { continue };
            let Some(area) = layout.areas().get(usize::from(label.panel)) else { continue };
            if label.contact == index {
                let outline = run.taxels & !labeller.enclosed(number, run, area);
                let around = Neighbourhood::of(image.values, area, run.row - area.first_row);
                contour.add(outline, run.column(), &around);
            }
        }
        contour
    }

    /// Adds taxels of the word that begins at `column`.
    #[inline(never)] // M0+: out of line
    fn add(&mut self, taxels: u32, column: u16, around: &Neighbourhood) {
        self.length = self.length.wrapping_add(taxels.count_ones());
        let slope = match around.rows16() {
            Some(rows) => steepness_of_rows16(rows, taxels),
            None => steepness(around, taxels, column),
        };
        self.slope = self.slope.wrapping_add(slope);
    }
}

/// Like [`steepness_of_rows16`], for a row of any length; `taxels` are of the word that begins at `column`.
fn steepness(around: &Neighbourhood, mut taxels: u32, column: u16) -> u32 {
    let mut sum = 0;
    while taxels != 0 {
        sum += magnitude(around, column + taxels.trailing_zeros() as u16) >> 3;
        taxels &= taxels - 1;
    }
    sum
}

#[inline(never)] // M0+: out of line
fn magnitude(around: &Neighbourhood, column: u16) -> u32 {
    around.gradient(column).magnitude()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::Garment;

    #[test]
    fn a_row_of_any_length_is_as_steep_as_its_taxels() {
        let layout = Layout::build(&Garment::recorded(3, 45), 135, 65535).unwrap();
        let values: [u16; 135] = core::array::from_fn(|i| (i * i * 37 % 4001) as u16);
        let area = &layout.areas()[0];
        let around = Neighbourhood::of(&values, area, 1);
        let magnitude = |column| around.gradient(column).magnitude();
        for (column, taxels) in [(0, 1), (0, 0x8000_0101), (0, u32::MAX), (32, 1), (32, 0x1ffe)] {
            let columns = (0..32).filter(|bit| taxels & 1 << bit != 0).map(|bit| column + bit);
            let sum: u32 = columns.map(|column| magnitude(column) >> 3).sum();
            assert_eq!(steepness(&around, taxels, column), sum);
        }
    }
}
