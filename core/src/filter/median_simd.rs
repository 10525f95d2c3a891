//! The median of nine by SIMD: eight taxels of a row at once, down the rows of a panel.

use super::median::{mark, median_of_columns, sorted};
use crate::garment::Area;
use crate::image::rows::{Rows, columns_as_groups};
use bytemuck::must_cast;
use core::ops::Range;
use wide::{i16x8, u16x16};

/// Taxels filtered at once.
const EIGHT: usize = 8;
/// Least columns of a panel for it: eight taxels and a neighbour on each side.
pub(crate) const FEWEST: usize = EIGHT + 2;
/// Rows searched at once.
const BLOCK: usize = u32::BITS as usize;

/// Pressure as signed numbers, which compare faster.
type Eight = i16x8;
/// Zero pressure as such a number.
const NOTHING: Eight = Eight::splat(i16::MIN);

/// Filters a panel where it may be non-zero, border replicated; `out` is zero elsewhere.
pub(crate) fn median_simd(values: &[u16], out: &mut [u16], area: &Area, grain: u32, marks: &mut Rows) {
    let columns = usize::from(area.columns);
    let panel = area.first_row..area.first_row.saturating_add(area.rows);
    for column in (1..columns - 1).step_by(EIGHT) {
        // The last eight may overlap the previous eight, with equal results.
        let column = column.min(columns - 1 - EIGHT);
        let reach = columns_as_groups(column - 1..column + EIGHT + 1, grain);
        let marks = marks.places(panel.clone());
        for block in (0..usize::from(area.rows)).step_by(BLOCK) {
            let rows = BLOCK.min(usize::from(area.rows) - block) as u32;
            let mut held = u32::MAX >> (u32::BITS - rows);
            if let Some(marks) = marks.as_ref().and_then(|marks| marks.get(block..block + rows as usize)) {
                held = holding(marks, reach);
                // A row may be filled from both sides; rows beyond the block are assumed to hold something.
                held |= (held << 1 | 1) & (held >> 1 | 1 << (rows - 1));
            }
            while held != 0 {
                let start = held.trailing_zeros();
                let end = start + (held >> start).trailing_ones();
                held &= u32::MAX.unbounded_shl(end);
                filter(values, out, columns, column, block + start as usize..block + end as usize);
            }
        }
    }
    let there = columns_as_groups(0..columns, grain);
    let ends = 1 | there ^ there >> 1;
    mark(area, grain, marks, |row, groups| {
        if groups & ends != 0 {
            filter_ends(values, out, columns, row);
        }
    });
}

/// Returns a mask of those of at most [`BLOCK`] rows that have any of the groups.
#[inline(always)]
fn holding(rows: &[u16], groups: u16) -> u32 {
    let (chunks, rest) = rows.as_chunks();
    let last = rest.iter().rev().fold(0, |held, row| held << 1 | u32::from(row & groups != 0));
    chunks.iter().rev().fold(last, |held, chunk| {
        let none = (u16x16::new(*chunk) & u16x16::splat(groups)).simd_eq(u16x16::ZERO);
        held << 16 | (!none).to_bitmask()
    })
}

/// Filters eight columns of some rows, neither the first column nor the last. Each three taxels of a row are
/// sorted once, for all rows that use them; what two output rows have in common is computed once for both.
#[inline(always)]
fn filter(values: &[u16], out: &mut [u16], columns: usize, column: usize, rows: Range<usize>) {
    let mut values = values.get(rows.start.saturating_sub(1) * columns..).unwrap_or(&[]);
    let mut out = out.get_mut(rows.start * columns..rows.end * columns).unwrap_or(&mut []);
    let mut next = || {
        let (row, rest) = values.split_at_checked(columns)?;
        values = rest;
        Some(three(row, column))
    };
    let Some(mut above) = next() else { return };
    // The border is replicated.
    let mut here = if rows.start == 0 { above } else { next().unwrap_or(above) };
    while !out.is_empty() {
        let below = next().unwrap_or(here);
        let after = next().unwrap_or(below);
        let (low, high) = (here[0].max(below[0]), here[2].min(below[2]));
        let (less, more) = (here[1].min(below[1]), here[1].max(below[1]));
        for other in [above, after] {
            let Some((row, rest)) = out.split_at_mut_checked(columns) else { return };
            let [low, high] = [low.max(other[0]), high.min(other[2])];
            let middle = less.max(more.min(other[1]));
            let median = low.min(middle).max(low.max(middle).min(high));
            if let Some(out) = row.get_mut(column..).and_then(<[u16]>::first_chunk_mut::<EIGHT>) {
                *out = must_cast(median ^ NOTHING);
            }
            out = rest;
        }
        (above, here) = (below, after);
    }
}

/// Eight taxels of a row, each sorted with its two neighbours: least, middle and greatest of the three.
#[inline(always)]
fn three(row: &[u16], column: usize) -> [Eight; 3] {
    let around = row.get(column - 1..).and_then(<[u16]>::first_chunk::<FEWEST>);
    let Some(around) = around else { return [NOTHING; 3] };
    let [left, here, right]: [Eight; 3] = [0, 1, 2].map(|first| {
        let eight = around.get(first..).and_then(<[u16]>::first_chunk::<EIGHT>);
        eight.map_or(NOTHING, |eight| must_cast::<_, Eight>(*eight) ^ NOTHING)
    });
    let (less, more) = (left.min(here), left.max(here));
    let (middle, greatest) = (more.min(right), more.max(right));
    [less.min(middle), less.max(middle), greatest]
}

/// Filters the first and the last taxel of a row.
#[inline(always)]
fn filter_ends(values: &[u16], out: &mut [u16], columns: usize, row: usize) {
    let ends = |row: usize| -> Option<[[u16; 2]; 2]> {
        let row = values.get(row * columns..)?.get(..columns)?;
        Some([*row.first_chunk()?, *row.last_chunk()?])
    };
    let Some(here) = ends(row) else { return };
    let above = row.checked_sub(1).and_then(ends).unwrap_or(here);
    let below = ends(row + 1).unwrap_or(here);
    if must_cast::<_, u64>(above) | must_cast::<_, u64>(here) | must_cast::<_, u64>(below) == 0 {
        return;
    }
    let column = |end: usize, at: usize| sorted(above[end][at], here[end][at], below[end][at]);
    if let Some([first, .., last]) = out.get_mut(row * columns..).and_then(|row| row.get_mut(..columns)) {
        // The column at the border counts twice.
        *first = median_of_columns(column(0, 0), column(0, 0), column(0, 1));
        *last = median_of_columns(column(1, 1), column(1, 1), column(1, 0));
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::median::median;
    use super::*;
    use crate::garment::{Garment, Layout};
    use crate::image::rows::grain;
    use std::vec;
    use std::vec::Vec;

    /// Both medians against a sorted list, on panels with and without spare columns, rows and blocks.
    #[test]
    fn a_taxel_becomes_the_fifth_of_nine() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 16) % end
        };
        let sizes = [(1, 1), (1, 12), (9, 1), (4, 16), (32, 64), (33, 10), (70, 17), (300, 11), (5, 700)];
        for (round, (rows, columns)) in (0..12).flat_map(|round| sizes.map(|size| (round, size))) {
            let layout = Layout::build(&Garment::recorded(rows, columns), 4800, 255).unwrap();
            let area = &layout.areas()[0];
            let (last_row, last_column) = (i32::from(rows) - 1, i32::from(columns) - 1);
            // Blots on an empty panel, few of them or many, of values of all sizes.
            let mut values = vec![0u16; layout.taxels()];
            for _ in 0..[1, 5, 200][round % 3] {
                let (row, column) = (next(rows.into()) as u16, next(columns.into()) as u16);
                for (row, column) in (row..rows.min(row + 3))
                    .flat_map(|row| (column..columns.min(column + 3)).map(move |column| (row, column)))
                {
                    values[usize::from(row * columns + column)] =
                        [0, 1, 700, 0x7fff, 0x8000, u16::MAX][next(6) as usize];
                }
            }
            let want: Vec<u16> = (0..values.len() as i32)
                .map(|taxel| {
                    let (row, column) = (taxel / (last_column + 1), taxel % (last_column + 1));
                    let around = (-1..2).flat_map(|y| (-1..2).map(move |x| (y, x)));
                    let mut nine: Vec<u16> = around
                        .map(|(y, x)| {
                            let row = (row + y).clamp(0, last_row);
                            values[(row * (last_column + 1) + (column + x).clamp(0, last_column)) as usize]
                        })
                        .collect();
                    nine.sort_unstable();
                    nine[4]
                })
                .collect();
            let check = |filter: &dyn Fn(&mut [u16], &mut Rows)| {
                let (mut out, mut marks) = (vec![0; values.len()], Rows::of(&layout, &values));
                filter(&mut out, &mut marks);
                assert!(out == want, "{rows} x {columns}");
                for row in 0..rows {
                    let there =
                        want[usize::from(row * columns)..][..columns.into()].iter().any(|value| *value != 0);
                    assert!(!there || marks.contains(row), "row {row} of {rows} x {columns}");
                }
            };
            check(&|out, marks| median(&values, out, area, grain(area), marks));
            if usize::from(columns) >= FEWEST {
                check(&|out, marks| median_simd(&values, out, area, grain(area), marks));
            }
        }
    }
}
