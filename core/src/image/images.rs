//! The images of a frame, cleared where they may be non-zero.
//!
//! Rows that are calibrated as a whole are not cleared first, but overwritten; nor are those that are filtered
//! as a whole. Those that are no longer active are cleared once that is known, before the filter reads them.

use super::row_set::RowSet;
use super::row16::ROW16;
use super::rows::Rows;
use super::slices::{areas_of, row_mut};
use super::view::Image;
use crate::garment::{Area, Layout};
use core::ops::Range;

/// The image of a frame before and after the filter. Aligned to words: what folds press is subtracted from two
/// taxels at a time.
#[derive(Debug, Clone)]
#[repr(align(4))]
pub(crate) struct Images<const TAXELS: usize> {
    /// Image before the filter. During a tare: the high halves of the sums.
    pub calibrated: [u16; TAXELS],
    /// Image after the filter. During a tare: zeros.
    pub filtered: [u16; TAXELS],
    /// Rows in which one of the images may be non-zero.
    pub rows: Rows,
    /// Panels that may be non-zero.
    pub active: u8,
}

impl<const TAXELS: usize> Images<TAXELS> {
    /// Empty images.
    pub const fn new() -> Self {
        Images { calibrated: [0; TAXELS], filtered: [0; TAXELS], rows: Rows::NONE, active: 0 }
    }

    /// Clears both images as a whole.
    pub fn reset(&mut self) {
        self.calibrated.fill(0);
        self.filtered.fill(0);
        (self.rows, self.active) = (Rows::NONE, 0);
    }

    /// The image of the garment's taxels, before the filter if there is none.
    pub fn image(&self, layout: &Layout, unfiltered: bool) -> Image<'_> {
        let values = if unfiltered && self.active != 0 { &self.calibrated } else { &self.filtered };
        Image { values: values.get(..layout.taxels()).unwrap_or(values), rows: &self.rows }
    }

    /// Clears both images; returns the rows left for overwriting, none if no panel was active. These are no
    /// longer [held](Rows), and may still be non-zero. `overwritten`: the filter writes whole rows of
    /// sixteen; without that, only the image before the filter is left for overwriting.
    pub fn clear(&mut self, layout: &Layout, codes: usize, overwritten: bool) -> Option<RowSet> {
        if self.active == 0 {
            return None;
        }
        for (_, area) in areas_of(layout, self.active) {
            let calibrated = self.are_overwritten(area, codes);
            if calibrated && overwritten {
                continue;
            }
            // Consecutive rows are cleared together, which is faster than finding their columns.
            let mut held = 0..0;
            let columns = usize::from(area.columns);
            let end = area.first_row.saturating_add(area.rows);
            let mut row = area.first_row;
            while let Some(number) = self.rows.next(row..end) {
                row = number + 1;
                if !calibrated {
                    self.rows.set(number, 0);
                }
                let start = usize::from(area.base) + usize::from(number - area.first_row) * columns;
                if start != held.end {
                    self.clear_taxels(&held, calibrated);
                    held.start = start;
                }
                held.end = start + columns;
            }
            self.clear_taxels(&held, calibrated);
        }
        self.rows.forget_shared();
        self.active = 0;
        Some(self.rows.release())
    }

    /// True if the rows of an active panel can be overwritten as a whole, given the number of codes.
    fn are_overwritten(&mut self, area: &Area, codes: usize) -> bool {
        let rows = area.first_row..area.first_row.saturating_add(area.rows);
        let end = usize::from(area.base) + usize::from(area.rows) * ROW16;
        usize::from(area.columns) == ROW16 && end <= codes.min(TAXELS) && self.rows.places(rows).is_some()
    }

    /// Clears the rows of `before` that are no longer active.
    pub fn clear_left(&mut self, layout: &Layout, before: &RowSet) {
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

    /// Clears some taxels of the filtered image, and of the other one if it is not `calibrated` anew.
    fn clear_taxels(&mut self, taxels: &Range<usize>, calibrated: bool) {
        let before = (!calibrated).then_some(&mut self.calibrated);
        for image in before.into_iter().chain([&mut self.filtered]) {
            if let Some(held) = image.get_mut(taxels.clone()) {
                held.fill(0);
            }
        }
    }
}
