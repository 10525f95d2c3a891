//! Emptying the images where they may hold something.

use super::state::ConditionState;
use super::tare::areas_of;
use crate::garment::Layout;
use core::ops::Range;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Empties the image, before and after the filter.
    pub(super) fn clear(&mut self, layout: &Layout) {
        // Rows that follow each other are one part: that is sooner done than to look for their columns.
        let mut held = 0..0;
        for (_, area) in areas_of(layout, self.active) {
            let columns = usize::from(area.columns);
            let end = area.first_row.saturating_add(area.rows);
            let mut row = area.first_row;
            while let Some(number) = self.rows.next(row..end) {
                row = number + 1;
                self.rows.set(number, 0);
                let start = usize::from(area.base) + usize::from(number - area.first_row) * columns;
                if start != held.end {
                    self.clear_taxels(&held);
                    held.start = start;
                }
                held.end = start + columns;
            }
        }
        self.clear_taxels(&held);
        self.rows.forget_shared();
        self.active = 0;
    }

    fn clear_taxels(&mut self, taxels: &Range<usize>) {
        for image in [&mut self.calibrated, &mut self.filtered] {
            if let Some(held) = image.get_mut(taxels.clone()) {
                held.fill(0);
            }
        }
    }
}
