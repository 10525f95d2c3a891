//! Conservative smoothing: a taxel is clamped to the range of its eight neighbours.
//!
//! Neighbours beyond the border do not count: were the border replicated, a taxel there would be its own neighbour and an
//! impulse would survive. Only a strict extreme of the nine is changed, so one neighbour that is not smaller and one that is
//! not greater settle a taxel: two or three comparisons mostly, of which one is shared with the next taxel.

use super::rows::Rows;
use crate::garment::Area;
use core::ops::Range;

/// Smooths a panel where it may hold something; `out` is empty elsewhere.
pub(super) fn conservative(values: &[u16], out: &mut [u16], area: &Area, grain: u32, marks: &mut Rows) {
    let columns = usize::from(area.columns);
    if area.rows == 1 || columns == 1 {
        // A taxel has two neighbours, or one twice.
        narrow(values, out);
        return mark_all(area, marks);
    }
    let panel = Panel { columns, last: usize::from(area.rows - 1) };
    let (first, end) = (area.first_row, area.first_row.saturating_add(area.rows));
    let mut next = first;
    while let Some(start) = marks.next(next..end) {
        let mut after = start + 1;
        while after < end && marks.contains(after) {
            after += 1;
        }
        let rows = usize::from(start - first)..usize::from(after - first);
        let bridged = panel.smooth(values, out, rows.clone());
        next = after;
        let there = (area.columns - 1) >> grain;
        for number in start..after {
            let groups = marks.groups(number);
            let row = usize::from(number - first);
            // Beside a column that holds nothing, the border stays 0.
            let near = [groups & 0b11 != 0, (groups << 1 | groups) >> there & 1 != 0];
            if panel.sides(values, out, row, near) || bridged {
                marks.add(number, (groups << 1 | groups | groups >> 1) & u16::MAX >> (15 - there));
            }
        }
    }
}

/// After a panel whose rows are not told apart.
fn mark_all(area: &Area, marks: &mut Rows) {
    for number in area.first_row..area.first_row.saturating_add(area.rows) {
        marks.add(number, u16::MAX);
    }
}

/// A panel of at least two rows and columns.
struct Panel {
    columns: usize,
    /// The last row.
    last: usize,
}

impl Panel {
    /// Smooths all but the first and the last taxel of some rows that follow each other; whether a taxel without pressure got
    /// some. What it makes of the first and the last column is wrong.
    fn smooth(&self, values: &[u16], out: &mut [u16], rows: Range<usize>) -> bool {
        let mut bridged = false;
        let mut rows = rows;
        if rows.start == 0 {
            bridged |= self.band(values, out, 0..1);
            rows.start = 1;
        }
        let inside = rows.start..rows.end.min(self.last);
        if inside.start < inside.end {
            bridged |= self.band(values, out, inside);
        }
        if rows.end > self.last && rows.start <= self.last {
            bridged |= self.band(values, out, self.last..self.last + 1);
        }
        bridged
    }

    /// The same for rows of which each has one above and below, or for one that lends from the other side what is missing: a
    /// neighbour that counts twice changes neither end of the range.
    fn band(&self, values: &[u16], out: &mut [u16], rows: Range<usize>) -> bool {
        let [above, below] = self.beside(rows.start);
        let (start, length) = (rows.start * self.columns, rows.len() * self.columns);
        let row = |start: usize| values.get(start..start + length).unwrap_or(&[]);
        let inside = start + 1..start + length - 1;
        inner(row(above), row(start), row(below), out.get_mut(inside).unwrap_or(&mut []))
    }

    /// Where the rows above and below one begin.
    fn beside(&self, row: usize) -> [usize; 2] {
        let (above, below) = (row.checked_sub(1), (row < self.last).then_some(row + 1));
        [above.or(below), below.or(above)].map(|row| row.unwrap_or(0) * self.columns)
    }

    /// The first and the last taxel of a row, as far as they are asked for; whether one had no pressure and got some.
    #[inline(never)]
    fn sides(&self, values: &[u16], out: &mut [u16], row: usize, [left, right]: [bool; 2]) -> bool {
        let [above, below] = self.beside(row);
        let here = row * self.columns;
        let line = |start: usize| values.get(start..start + self.columns);
        let (Some(above), Some(line), Some(below)) = (line(above), line(here), line(below)) else {
            return false;
        };
        let Some(out) = out.get_mut(here..here + self.columns) else { return false };
        let mut bridged = false;
        if left
            && let (Some(above), Some(line), Some(below), Some(out)) =
                (above.first_chunk(), line.first_chunk(), below.first_chunk(), out.first_mut())
        {
            *out = border(above, line, below, 0);
            bridged |= line[0] == 0 && *out != 0;
        }
        if right
            && let (Some(above), Some(line), Some(below), Some(out)) =
                (above.last_chunk(), line.last_chunk(), below.last_chunk(), out.last_mut())
        {
            *out = border(above, line, below, 1);
            bridged |= line[1] == 0 && *out != 0;
        }
        bridged
    }
}

/// The taxel at `at`, 0 or 1, of the first or the last two columns.
#[inline(never)]
fn border(above: &[u16; 2], here: &[u16; 2], below: &[u16; 2], at: usize) -> u16 {
    let [value, next] = if at == 0 { *here } else { [here[1], here[0]] };
    let others = [above[0], above[1], below[0], below[1]];
    if value > next && others.iter().all(|other| *other < value) {
        others.into_iter().fold(next, u16::max)
    } else if value < next && others.iter().all(|other| *other > value) {
        others.into_iter().fold(next, u16::min)
    } else {
        value
    }
}

/// A panel of a single row or column.
fn narrow(values: &[u16], out: &mut [u16]) {
    for (at, (value, out)) in values.iter().zip(out).enumerate() {
        let (before, after) = (at.checked_sub(1).and_then(|at| values.get(at)), values.get(at + 1));
        let (a, b) = before.or(after).zip(after.or(before)).unwrap_or((value, value));
        *out = *value.max(a.min(b)).min(a.max(b));
    }
}

/// All of `here` but its ends.
#[inline(never)]
fn inner(above: &[u16], here: &[u16], below: &[u16], out: &mut [u16]) -> bool {
    let (Some(first), Some(second)) = (here.first(), here.get(1)) else { return false };
    let mut value = i32::from(*second);
    let mut from_last = value - i32::from(*first);
    let mut bridged = false;
    let rows = above.array_windows::<3>().zip(here.array_windows::<3>()).zip(below.array_windows::<3>());
    for (((above, here), below), out) in rows.zip(out) {
        let next = i32::from(here[2]);
        let to_next = next - value;
        let mut smoothed = value;
        if to_next < 0 {
            if from_last > 0 && !around(above, below).any(|other| other >= value) {
                smoothed = greatest(above, here, below);
            }
        } else if to_next > 0 && from_last < 0 && !around(above, below).any(|other| other <= value) {
            smoothed = least(above, here, below);
            bridged |= value == 0;
        }
        *out = smoothed as u16;
        (from_last, value) = (to_next, next);
    }
    bridged
}

/// The neighbours above and below, the nearest first.
#[inline(always)]
fn around(above: &[u16; 3], below: &[u16; 3]) -> impl Iterator<Item = i32> {
    [above[1], below[1], above[0], above[2], below[0], below[2]].into_iter().map(i32::from)
}

/// The greatest neighbour. Not inlined, as [`least`], lest the neighbours be kept for it, one by one, on the stack.
#[inline(never)]
fn greatest(above: &[u16; 3], here: &[u16; 3], below: &[u16; 3]) -> i32 {
    around(above, below).fold(i32::from(here[0]).max(here[2].into()), i32::max)
}

/// The smallest neighbour.
#[inline(never)]
fn least(above: &[u16; 3], here: &[u16; 3], below: &[u16; 3]) -> i32 {
    around(above, below).fold(i32::from(here[0]).min(here[2].into()), i32::min)
}
