//! Connected components: row by row, each row as bits, its 8-connected taxels joined by union-find.

use super::labeller::{Labeller, ScanLine};
use super::threshold::paired_rows16;
use super::union_find::NONE;
use crate::garment::{Area, Layout};
use crate::image::slices::{panel_of, row_of};
use crate::image::view::Image;

impl<const RUNS: usize, const LABELS: usize> Labeller<RUNS, LABELS> {
    /// Labels the connected taxels of an image.
    pub fn scan(&mut self, layout: &Layout, image: &Image, low: u16) {
        self.clear();
        if image.rows.is_empty() {
            return;
        }
        for (panel, area) in (0u8..).zip(layout.areas()) {
            self.scan_panel(panel, area, image, low);
        }
        self.flatten();
    }

    #[inline(never)] // own frame: locals stay within short SP offsets
    fn scan_panel(&mut self, panel: u8, area: &Area, image: &Image, low: u16) {
        let start = self.runs.len();
        let last = area.first_row.saturating_add(area.rows);
        let rows16 = paired_rows16(panel_of(image.values, area), area.columns, low);
        let are_rows16 = rows16.len() == usize::from(area.rows);
        let mut line = ScanLine { panel, row: 0, above: start, reach: 0, label: NONE, ends: [0; 2] };
        let mut from = area.first_row;
        // A gap between active rows separates labels.
        while let Some(rows) = image.rows.held().run(from..last) {
            from = rows.end;
            line = ScanLine { row: rows.start, above: self.runs.len(), reach: 0, label: NONE, ..line };
            if are_rows16 {
                let here = |row: u16| usize::from(row - area.first_row);
                let rows16 = rows16.get(here(rows.start)..here(rows.end));
                self.scan_rows16(rows16.unwrap_or(&[]), low, &mut line);
                continue;
            }
            for row in rows {
                line.row = row;
                self.scan_row(row_of(image.values, area, row - area.first_row), low, &mut line);
            }
        }
        if are_rows16 {
            self.weigh(start);
        }
        self.mark_sides(start, area, &line);
    }
}
