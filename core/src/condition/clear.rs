//! Emptying the images where they may hold something.
//!
//! Rows that are calibrated and filtered as a whole are not emptied first: what they held is overwritten.
//! Those of them that hold nothing any more are emptied once that is known, before the filter looks at them.

use super::config::Filter;
use super::held::Held;
use super::sixteen::SIXTEEN;
use super::slices::row_mut;
use super::state::ConditionState;
use super::tare::areas_of;
use crate::garment::{Area, Layout};
use core::ops::Range;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Empties the images, before and after the filter, but for the rows that it gives back, if there may be
    /// any: they are not [held](super::Rows) any more, and may still hold something.
    pub(super) fn clear(&mut self, layout: &Layout, codes: usize, filter: Filter) -> Option<Held> {
        if self.active == 0 {
            return None;
        }
        // Rows that follow each other are one part: that is sooner done than to look for their columns.
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

    /// Whether a row of a panel that is worked on is written as a whole, given how many codes there are.
    fn overwrites(&mut self, area: &Area, codes: usize, filter: Filter) -> bool {
        let rows = area.first_row..area.first_row.saturating_add(area.rows);
        let end = usize::from(area.base) + usize::from(area.rows) * SIXTEEN;
        usize::from(area.columns) == SIXTEEN
            && matches!(filter, Filter::Conservative | Filter::Persistent)
            && end <= codes.min(TAXELS)
            && self.rows.places(rows).is_some()
    }

    /// Empties those of some rows that hold nothing any more.
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
