//! Emptying the images where they may hold something.

use super::rows::span;
use super::state::ConditionState;
use super::tare::areas_of;
use crate::garment::Layout;
use core::ops::Range;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Empties the image, before and after the filter.
    pub(super) fn clear(&mut self, layout: &Layout) {
        // Rows that are full follow each other without a gap.
        let mut held = 0..0;
        for (_, area) in areas_of(layout, self.active) {
            let end = area.first_row.saturating_add(area.rows);
            let mut row = area.first_row;
            while let Some(number) = self.rows.next(row..end) {
                row = number + 1;
                let columns = span(area, self.rows.groups(number));
                self.rows.set(number, 0);
                let start =
                    usize::from(area.base) + usize::from(number - area.first_row) * usize::from(area.columns);
                let here = start + usize::from(columns.start)..start + usize::from(columns.end);
                if here.start != held.end {
                    self.clear_taxels(&held);
                    held.start = here.start;
                }
                held.end = here.end;
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
