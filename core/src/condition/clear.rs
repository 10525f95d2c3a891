//! Clears the images where they may be non-zero.
//!
//! Rows that are calibrated and filtered as a whole are not cleared first, but overwritten. Those that are no
//! longer active are cleared once that is known, before the filter reads them.

use super::config::Filter;
use super::held::Held;
use super::sixteen::SIXTEEN;
use super::slices::row_mut;
use super::state::ConditionState;
use super::tare::areas_of;
use crate::garment::{Area, Layout};
use core::ops::Range;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Clears both images; returns the rows left for overwriting, none if no panel was active. These are no
    /// longer [held](super::Rows), and may still be non-zero.
    pub(super) fn clear(&mut self, layout: &Layout, codes: usize, filter: Filter) -> Option<Held> {
        if self.active == 0 {
            return None;
        }
        // Consecutive rows are cleared together, which is faster than finding their columns.
        let mut held = 0..0;
        for (_, area) in areas_of(layout, self.active) {
            if self.overwrites(area, codes, filter) {
                continue;
            }
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
        Some(self.rows.release())
    }

    /// True if the rows of an active panel are overwritten as a whole, given the number of codes.
    fn overwrites(&mut self, area: &Area, codes: usize, filter: Filter) -> bool {
        let rows = area.first_row..area.first_row.saturating_add(area.rows);
        let end = usize::from(area.base) + usize::from(area.rows) * SIXTEEN;
        usize::from(area.columns) == SIXTEEN
            && matches!(filter, Filter::Conservative | Filter::Persistent)
            && end <= codes.min(TAXELS)
            && self.rows.places(rows).is_some()
    }

    /// Clears the rows of `before` that are no longer active.
    pub(super) fn clear_left(&mut self, layout: &Layout, before: &Held) {
        let left = before.without(self.rows.held());
        if left.is_empty() {
            return;
        }
        for area in layout.areas() {
            let end = area.first_row.saturating_add(area.rows);
            let mut next = area.first_row;
            while let Some(number) = left.next(next..end) {
                next = number + 1;
                self.rows.set(number, 0);
                for image in [&mut self.calibrated, &mut self.filtered] {
                    row_mut(image, area, number - area.first_row).fill(0);
                }
            }
        }
    }

    fn clear_taxels(&mut self, taxels: &Range<usize>) {
        for image in [&mut self.calibrated, &mut self.filtered] {
            if let Some(held) = image.get_mut(taxels.clone()) {
                held.fill(0);
            }
        }
    }
}
