//! The exact median of nine.

use crate::garment::Area;
use crate::image::rows::{Pieces, Rows, columns_as_groups};
use core::ops::Range;

/// Filters a panel where it may be non-zero, border replicated; `out` is zero elsewhere.
///
/// Each column of three is sorted once and used three times. The median of nine is the median of the largest
/// low, the median middle and the smallest high one (Smith 1996): 170 cycles per taxel on a Cortex-M0+ if all
/// are pressed, see `docs/evidence/bench/cycles.txt`.
pub(crate) fn median(values: &[u16], out: &mut [u16], area: &Area, grain: u32, marks: &mut Rows) {
    let columns = usize::from(area.columns);
    mark(area, grain, marks, |row, groups| {
        let rows = [row.saturating_sub(1), row, (row + 1).min(usize::from(area.rows) - 1)];
        let line = |row: usize| values.get(row * columns..(row + 1) * columns).unwrap_or(&[]);
        let out = out.get_mut(row * columns..(row + 1) * columns).unwrap_or(&mut []);
        for (_, piece) in Pieces::of(area, grain, groups.into()) {
            part(rows.map(line), piece, out);
        }
    });
}

/// Marks the groups of a panel that may be non-zero after the filter, and calls `each` with every such row:
/// five of nine taxels lie in at least two rows. The border is replicated.
#[inline(always)]
pub(crate) fn mark(area: &Area, grain: u32, marks: &mut Rows, mut each: impl FnMut(usize, u16)) {
    let there = columns_as_groups(0..area.columns.into(), grain);
    let widened = |groups: u16| (groups | groups << 1 | groups >> 1) & there;
    let end = area.first_row.saturating_add(area.rows);
    let here = marks.groups(area.first_row);
    // Groups as they were before the filter.
    let (mut above, mut here) = (widened(here), widened(here));
    for (row, number) in (area.first_row..end).enumerate() {
        let below = if number + 1 < end { widened(marks.groups(number + 1)) } else { here };
        let reach = above & here | here & below | above & below;
        if reach != 0 {
            each(row, reach);
            marks.add(number, reach);
        }
        (above, here) = (here, below);
    }
}

/// Filters some columns of a row.
fn part(rows: [&[u16]; 3], columns: Range<usize>, out: &mut [u16]) {
    let led = columns.start > 0;
    let around = columns.start - usize::from(led)..(columns.end + 1).min(out.len());
    let [above, here, below] = rows.map(|row| row.get(around.clone()).unwrap_or(&[]));
    row(above, here, below, led, out.get_mut(columns).unwrap_or(&mut []));
}

/// Filters a row; if `led`, the inputs begin one column before `out`.
#[inline(never)]
fn row(above: &[u16], here: &[u16], below: &[u16], led: bool, out: &mut [u16]) {
    let mut columns =
        above.iter().zip(here).zip(below).map(|((a, h), b)| sorted((*a).into(), (*h).into(), (*b).into()));
    let Some(mut left) = columns.next() else { return };
    let mut middle = left;
    if led && let Some(second) = columns.next() {
        middle = second;
    }
    for out in out {
        let right = columns.next().unwrap_or(middle);
        let value: u32 = match left.2 | middle.2 | right.2 {
            0 => 0,
            _ => median_of_columns(left, middle, right),
        };
        *out = value as u16;
        left = middle;
        middle = right;
    }
}

type Sorted<T> = (T, T, T);

pub(crate) fn median_of_columns<T: Ord + Copy>(a: Sorted<T>, b: Sorted<T>, c: Sorted<T>) -> T {
    let low = a.0.max(b.0).max(c.0);
    let middle = sorted(a.1, b.1, c.1).1;
    let high = a.2.min(b.2).min(c.2);
    sorted(low, middle, high).1
}

pub(crate) fn sorted<T: Ord + Copy>(a: T, b: T, c: T) -> Sorted<T> {
    let (a, b) = (a.min(b), a.max(b));
    let (b, c) = (b.min(c), b.max(c));
    (a.min(b), a.max(b), c)
}
