//! Conservative smoothing: clamps a taxel to the range of its eight neighbours.
//!
//! Taxels beyond the border do not count: with a replicated border a taxel there would be its own neighbour,
//! and an impulse would survive.

use super::clamp::{SHORT, clamp, clamp_run};
use super::clamp_row16::clamp_row16;
use super::points::stands_out;
use super::row::FilterRow;
use crate::format::WIDE;
use crate::garment::Area;
use crate::image::row16::ROW16;
use crate::image::rows::{Pieces, Rows};
use core::ops::Range;

/// Smooths a panel where it may be non-zero; `out` is zero elsewhere. Returns true if it may have
/// [points](super::points::stands_out).
pub(crate) fn conservative(
    values: &[u16],
    out: &mut [u16],
    area: &Area,
    grain: u32,
    marks: &mut Rows,
) -> bool {
    let columns = usize::from(area.columns);
    if area.rows == 1 || columns == 1 {
        // A taxel has two neighbours, or one that counts twice.
        narrow(values, out);
        mark_all(area, marks);
        return true;
    }
    let there = u16::MAX >> (15 - ((area.columns - 1) >> grain));
    let (first, end) = (area.first_row, area.first_row.saturating_add(area.rows));
    if columns == ROW16
        && !WIDE
        && let Some(groups) = marks.places(first..end)
    {
        return smooth_rows16(values, out, groups);
    }
    let mut points = false;
    let mut next = first;
    while let Some(number) = marks.next(next..end) {
        next = number + 1;
        let groups = bridged(marks.groups(number), there);
        marks.widen(number, groups);
        let here = usize::from(number - first) * columns;
        // At the border the opposite row replaces the missing one: counted twice, it changes neither end of
        // the range.
        let above = if number == first { columns } else { here - columns };
        let below = if next == end { above } else { here + columns };
        let row = FilterRow { starts: [above, here, below], columns };
        if columns == ROW16 || groups == there {
            smooth(&row, values, out, 0..columns, &mut points);
            continue;
        }
        for (_, piece) in Pieces::of(area, grain, groups.into()) {
            smooth(&row, values, out, piece, &mut points);
        }
    }
    points
}

/// Smooths a panel of sixteen columns and at least two rows. Returns true if it has points.
#[inline(never)] // M0+: out of line
fn smooth_rows16(values: &[u16], out: &mut [u16], groups: &mut [u16]) -> bool {
    let mut points = false;
    let (rows, _) = values.as_chunks();
    let (out, _) = out.as_chunks_mut();
    let ([top, second, ..], [.., last, bottom]) = (rows, rows) else { return true };
    let ([top_out, out @ .., bottom_out], [top_groups, groups @ .., bottom_groups]) = (out, groups) else {
        return true;
    };
    // At both ends the opposite row replaces the missing one.
    if widen(top_groups) {
        clamp_row16(&[*second, *top], second, *top_groups, top_out, &mut points);
    }
    for ((three, out), groups) in rows.array_windows::<3>().zip(out).zip(groups) {
        if let (true, Some(two)) = (widen(groups), three.first_chunk()) {
            clamp_row16(two, &three[2], *groups, out, &mut points);
        }
    }
    if widen(bottom_groups) {
        clamp_row16(&[*last, *bottom], last, *bottom_groups, bottom_out, &mut points);
    }
    points
}

/// Adds the groups that the filter may fill to those of a row of sixteen columns. Returns false if it has
/// none.
#[inline(always)]
fn widen(groups: &mut u16) -> bool {
    if *groups == 0 {
        return false;
    }
    *groups |= bridged(*groups, u16::MAX);
    true
}

/// Marks all columns of all rows of a panel.
fn mark_all(area: &Area, marks: &mut Rows) {
    for number in area.first_row..area.first_row.saturating_add(area.rows) {
        marks.add(number, u16::MAX);
    }
}

/// Groups of a row that may be non-zero after smoothing: a taxel without pressure gets some from neighbours
/// on both sides, or on its only side. In a group of several columns it is at the end of the group.
fn bridged(groups: u16, there: u16) -> u16 {
    let last = there ^ there >> 1;
    let (before, after) = (groups << 1, groups >> 1);
    (groups | before & after | after & 1 | before & last) & there
}

/// A panel of a single row or column.
fn narrow(values: &[u16], out: &mut [u16]) {
    for (at, (value, out)) in values.iter().zip(out).enumerate() {
        let (before, after) = (at.checked_sub(1).and_then(|at| values.get(at)), values.get(at + 1));
        let (a, b) = before.or(after).zip(after.or(before)).unwrap_or((value, value));
        *out = *value.max(a.min(b)).min(a.max(b));
    }
}

/// Smooths some columns of a row, run by run. Sets `points` if it may have points.
#[inline(never)]
fn smooth(row: &FilterRow, values: &[u16], out: &mut [u16], columns: Range<usize>, points: &mut bool) {
    if row.columns < SHORT {
        *points = true;
        return smooth_each(row, values, out);
    }
    let (mut inside, mut at_end) = (false, false);
    row.filter(
        values,
        out,
        columns,
        |above, here, below, out: &mut [u16; SHORT]| clamp_run(above, here, below, out, &mut inside),
        |[above, here, below]| {
            let smoothed = border(here[0], [here[1], above[0], below[0], above[1], below[1]]);
            at_end |= stands_out(here[0], smoothed);
            smoothed
        },
    );
    *points |= inside | at_end;
}

/// Smooths a row shorter than a run.
#[inline(never)]
fn smooth_each(row: &FilterRow, values: &[u16], out: &mut [u16]) {
    let [above, here, below] = row.starts;
    let value = |at: usize| values.get(at).copied().unwrap_or(0);
    for column in 0..row.columns {
        let left = if column == 0 { 1 } else { column - 1 };
        let right = if column + 1 == row.columns { left } else { column + 1 };
        let three = |start: usize| [start + left, start + column, start + right].map(value);
        if let Some(out) = out.get_mut(here + column) {
            *out = clamp(&three(above), &three(here), &three(below));
        }
    }
}

/// Clamps a taxel of the first or the last column.
#[inline(always)]
fn border(value: u16, others: [u16; 5]) -> u16 {
    if others.iter().all(|other| *other < value) {
        others.into_iter().fold(0, u16::max)
    } else if others.iter().all(|other| *other > value) {
        others.into_iter().fold(u16::MAX, u16::min)
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_sixteen_are_as_others() {
        let mut noise = 1u32;
        for rows in [2, 3, 9] {
            let mut values = [0; 9 * ROW16];
            values.fill_with(|| {
                noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
                (noise >> 28) as u16
            });
            let values = &values[..rows * ROW16];
            // A row without pressure is left out.
            let mut groups = [u16::MAX; 9];
            groups[rows / 2] = 0;
            let mut out = [[7; 9 * ROW16]; 2];
            smooth_rows16(values, &mut out[0][..values.len()], &mut groups[..rows]);
            for row in (0..rows).filter(|row| *row != rows / 2) {
                let around = [
                    if row == 0 { 1 } else { row - 1 },
                    row,
                    if row + 1 == rows { row - 1 } else { row + 1 },
                ];
                let row = FilterRow { starts: around.map(|row| row * ROW16), columns: ROW16 };
                smooth(&row, values, &mut out[1], 0..ROW16, &mut false);
            }
            assert_eq!(out[0], out[1]);
        }
    }
}
