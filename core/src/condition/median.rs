//! The exact median of nine.

use super::clamp::{SHORT, VECTORS};
use super::row::Row;
use super::rows::{Pieces, Rows};
use crate::garment::Area;
use core::ops::Range;

/// Filters a panel where it may hold something, its border replicated; `out` is empty elsewhere.
///
/// Each column of three is sorted once and used three times; the median of nine is the median of the largest low, the
/// median middle and the smallest high one (Smith 1996): 195 cycles per taxel on a Cortex-M0+ where all are pressed, see
/// `docs/bench/cycles.txt`.
pub(super) fn median(values: &[u16], out: &mut [u16], area: &Area, grain: u32, marks: &mut Rows) {
    let columns = usize::from(area.columns);
    let there = u32::MAX >> (31 - (u32::from(area.columns - 1) >> grain));
    let (first, end) = (area.first_row, area.first_row.saturating_add(area.rows));
    // The groups of the row above, before the filter: what it leaves takes their place.
    let (mut above, mut here) = (0, marks.groups(first));
    for number in first..end {
        let below = if number + 1 < end { marks.groups(number + 1) } else { 0 };
        let all = u32::from(above | here | below);
        if all != 0 {
            let row = number - first;
            let rows = [row.saturating_sub(1), row, (row + 1).min(area.rows - 1)];
            let rows = rows.map(|row| usize::from(row) * columns);
            let start = usize::from(row) * columns;
            let mut held = here;
            for (groups, piece) in Pieces::of(area, grain, (all | all << 1 | all >> 1) & there) {
                let any = if VECTORS && columns >= SHORT {
                    let row = Row { starts: rows, columns };
                    row.filter(values, out, piece.clone(), median_run, median_of_end);
                    out.get(start + piece.start..start + piece.end)
                        .is_some_and(|out| out.iter().any(|value| *value != 0))
                } else {
                    let line = |start: usize| values.get(start..start + columns).unwrap_or(&[]);
                    let out = out.get_mut(start..start + columns).unwrap_or(&mut []);
                    part(rows.map(line), piece, out)
                };
                held |= if any { groups } else { 0 };
            }
            marks.set(number, held);
        }
        (above, here) = (here, below);
    }
}

/// Some columns of a row; whether anything is left.
fn part(rows: [&[u16]; 3], columns: Range<usize>, out: &mut [u16]) -> bool {
    let led = columns.start > 0;
    let around = columns.start - usize::from(led)..(columns.end + 1).min(out.len());
    let [above, here, below] = rows.map(|row| row.get(around.clone()).unwrap_or(&[]));
    row(above, here, below, led, out.get_mut(columns).unwrap_or(&mut [])) != 0
}

/// The same; if `led`, the rows begin one column before `out`.
#[inline(never)]
fn row(above: &[u16], here: &[u16], below: &[u16], led: bool, out: &mut [u16]) -> u32 {
    let mut columns =
        above.iter().zip(here).zip(below).map(|((a, h), b)| sorted((*a).into(), (*h).into(), (*b).into()));
    let Some(mut left) = columns.next() else { return 0 };
    let mut middle = left;
    if led && let Some(second) = columns.next() {
        middle = second;
    }
    let mut any = 0;
    for out in out {
        let right = columns.next().unwrap_or(middle);
        let value = match left.2 | middle.2 | right.2 {
            0 => 0,
            _ => median_of_columns(left, middle, right),
        };
        *out = value as u16;
        any |= value;
        left = middle;
        middle = right;
    }
    any
}

/// Taxels that are filtered at once, with their neighbours.
type Block = [u16; SHORT];

/// All of `here` but its ends at once: not inlined, and each step a loop of its own, so that a compiler makes vectors of them.
#[inline(never)]
fn median_run(above: &Block, here: &Block, below: &Block, out: &mut Block) {
    // Numbers with a sign are sooner compared.
    let signed = |value: &u16| (value ^ 0x8000) as i16;
    let (mut low, mut middle, mut high) = ([0; SHORT], [0; SHORT], [0; SHORT]);
    let columns = low.iter_mut().zip(&mut middle).zip(&mut high);
    for (((low, middle), high), ((a, h), b)) in columns.zip(above.iter().zip(here).zip(below)) {
        (*low, *middle, *high) = sorted(signed(a), signed(h), signed(b));
    }
    let columns = low.array_windows().zip(middle.array_windows()).zip(high.array_windows());
    for ((([a, b, c], [d, e, f]), [g, h, i]), out) in columns.zip(out.iter_mut().skip(1)) {
        *out = median_of_columns((*a, *d, *g), (*b, *e, *h), (*c, *f, *i)) as u16 ^ 0x8000;
    }
}

fn median_of_nine(above: [u16; 3], here: [u16; 3], below: [u16; 3]) -> u16 {
    let [a, b, c] = [0, 1, 2].map(|column: usize| sorted(above[column], here[column], below[column]));
    median_of_columns(a, b, c)
}

/// The first taxel of a row, before which it is repeated.
fn median_of_end(rows: [[u16; 2]; 3]) -> u16 {
    let [above, here, below] = rows.map(|[end, next]| [end, end, next]);
    median_of_nine(above, here, below)
}

type Sorted<T> = (T, T, T);

fn median_of_columns<T: Ord + Copy>(a: Sorted<T>, b: Sorted<T>, c: Sorted<T>) -> T {
    let low = a.0.max(b.0).max(c.0);
    let middle = sorted(a.1, b.1, c.1).1;
    let high = a.2.min(b.2).min(c.2);
    sorted(low, middle, high).1
}

fn sorted<T: Ord + Copy>(a: T, b: T, c: T) -> Sorted<T> {
    let (a, b) = (a.min(b), a.max(b));
    let (b, c) = (b.min(c), b.max(c));
    (a.min(b), a.max(b), c)
}
