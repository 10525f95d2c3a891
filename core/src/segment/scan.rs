//! Connected components: row by row, each row as bits, its 8-connected taxels joined by union-find.

use super::labeller::Labeller;
use super::run::{Run, WORD};
use super::sums::RunSums;
use super::threshold::touched;
use super::union_find::{NONE, first_of, unite};
use crate::garment::{Area, Layout};
use crate::image::slices::panel_of;
use crate::image::view::Image;
use core::ops::Range;

/// Position of the scan in a panel, and what it has found so far.
struct ScanLine {
    panel: u8,
    /// Row, counted over all panels.
    row: u16,
    /// Index of the first run of the row above, or of this row if the row above has none.
    above: usize,
    /// Taxels touched so far in the first and in the last words of the panel's rows.
    ends: [u32; 2],
}

/// Labels the connected taxels of an image.
pub(crate) fn scan<const RUNS: usize, const LABELS: usize>(
    labeller: &mut Labeller<RUNS, LABELS>,
    layout: &Layout,
    image: &Image,
    low: u16,
) {
    labeller.clear();
    if image.rows.is_empty() {
        return;
    }
    for (panel, area) in (0u8..).zip(layout.areas()) {
        scan_panel(labeller, panel, area, image, low);
    }
    labeller.flatten();
}

#[inline(never)] // own frame: locals stay within short SP offsets
fn scan_panel<const RUNS: usize, const LABELS: usize>(
    labeller: &mut Labeller<RUNS, LABELS>,
    panel: u8,
    area: &Area,
    image: &Image,
    low: u16,
) {
    let start = labeller.runs.len();
    let last = area.first_row.saturating_add(area.rows);
    let (values, columns) = (panel_of(image.values, area), usize::from(area.columns).max(1));
    let mut line = ScanLine { panel, row: 0, above: start, ends: [0; 2] };
    let mut from = area.first_row;
    while let Some(rows) = image.rows.held().run(from..last) {
        from = rows.end;
        // A gap between active rows separates labels.
        (line.row, line.above) = (rows.start, labeller.runs.len());
        let at = |row: u16| usize::from(row - area.first_row) * columns;
        let taxels = values.get(at(rows.start)..).unwrap_or(&[]);
        for row in taxels.chunks(columns).take(rows.len()) {
            scan_row(labeller, row, low, &mut line);
            line.row += 1;
        }
    }
    labeller.mark_sides(start, panel, area, line.ends);
}

/// Appends the runs of a row, and adds their sums to their labels.
#[inline(always)]
fn scan_row<const RUNS: usize, const LABELS: usize>(
    labeller: &mut Labeller<RUNS, LABELS>,
    row: &[u16],
    low: u16,
    line: &mut ScanLine,
) {
    let here = labeller.runs.len();
    let (mut above, mut column, mut rest) = (line.above, 0, row);
    loop {
        let (values, after) = rest.split_at(rest.len().min(WORD.into()));
        let taxels = touched(values, low);
        if taxels != 0 {
            if column == 0 {
                line.ends[0] |= taxels;
            }
            if after.is_empty() {
                line.ends[1] |= taxels;
            }
            above = scan_word(labeller, taxels, values, column, above..here, line);
        }
        if after.is_empty() {
            break;
        }
        (rest, column) = (after, column + WORD);
    }
    line.above = here;
}

/// Appends the runs of a word; `above` is the range of runs in the row above that may touch them. Returns the
/// first of these that may touch taxels of the next word. All runs are in the order of their columns.
#[inline(never)] // M0+: out of line
fn scan_word<const RUNS: usize, const LABELS: usize>(
    labeller: &mut Labeller<RUNS, LABELS>,
    all: u32,
    values: &[u16],
    column: u16,
    Range { start: mut above, end: here }: Range<usize>,
    line: &ScanLine,
) -> usize {
    // The first run may continue one of the word before.
    let before = labeller.runs.get(here..).and_then(<[Run]>::last);
    let before = before.filter(|before| all & 1 == 1 && before.right.wrapping_add(1) == column);
    let mut label = before.map_or(NONE, |before| before.label);
    let mut rest = all;
    while rest != 0 {
        let start = rest.trailing_zeros() as u16;
        let length = (rest >> start).trailing_ones() as u16;
        let after = rest & rest.wrapping_add(1 << start);
        let (left, end) = (column + start, column + start + length);
        while above < here
            && let Some(run) = labeller.runs.get(above)
        {
            let beyond = run.right + 1;
            if beyond >= left {
                if run.left > end {
                    break;
                }
                label = match label {
                    NONE => first_of(&mut labeller.labels, run.label),
                    label if label == run.label => label,
                    label => unite(&mut labeller.labels, run.label, label),
                };
                if beyond >= end {
                    // It may touch the next run, too.
                    break;
                }
            }
            above += 1;
        }
        // Always: the word has as many values.
        let Some(values) = values.get(start.into()..(start + length).into()) else { break };
        let (taxels, row, right) = (rest & !after, line.row, end - 1);
        let run = Run { taxels, row, label, left, right, peak: 0, sums: RunSums::NONE };
        labeller.push(run, values, line.panel);
        (label, rest) = (NONE, after);
    }
    above
}
