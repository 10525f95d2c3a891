//! Clamps rows of sixteen taxels to the range of their eight neighbours, by single comparisons.
//!
//! Only a strict extreme of the nine changes, so one neighbour that is not smaller and one that is not
//! greater settle a taxel. A few comparisons settle most: the neighbours on both sides come first.

use super::points::stands_out;
use crate::image::row16::Row16;

/// A row and the one before it, adjacent: besides the compared values, a Cortex-M0+'s registers hold two
/// addresses more, that of the row below and that of the result.
pub(crate) type Two = [Row16; 2];

/// Clamps the second of two rows, given the one below. Four columns without any of `groups` become 0. Sets
/// `points` if a taxel [stands out](stands_out).
#[inline(always)]
pub(crate) fn clamp_row16(two: &Two, below: &Row16, groups: u16, out: &mut Row16, points: &mut bool) {
    if groups == u16::MAX {
        clamp_groups::<true>(two, below, groups, out, points);
    } else {
        clamp_groups::<false>(two, below, groups, out, points);
    }
}

/// Clamps a row; if ALL, all groups are set.
#[inline(never)] // M0+: out of line
fn clamp_groups<const ALL: bool>(two: &Two, below: &Row16, groups: u16, out: &mut Row16, points: &mut bool) {
    // Unrolled by hand: the compiler would keep a loop, with an index and additions per taxel.
    if ALL || groups & 0xf != 0 {
        end::<0, 1>(two, below, out, points);
        inside::<1>(two, below, out, points);
        inside::<2>(two, below, out, points);
        inside::<3>(two, below, out, points);
    } else {
        empty::<0>(out);
    }
    if ALL || groups & 0xf0 != 0 {
        inside::<4>(two, below, out, points);
        inside::<5>(two, below, out, points);
        inside::<6>(two, below, out, points);
        inside::<7>(two, below, out, points);
    } else {
        empty::<4>(out);
    }
    if ALL || groups & 0xf00 != 0 {
        inside::<8>(two, below, out, points);
        inside::<9>(two, below, out, points);
        inside::<10>(two, below, out, points);
        inside::<11>(two, below, out, points);
    } else {
        empty::<8>(out);
    }
    if ALL || groups & 0xf000 != 0 {
        inside::<12>(two, below, out, points);
        inside::<13>(two, below, out, points);
        inside::<14>(two, below, out, points);
        end::<15, 14>(two, below, out, points);
    } else {
        empty::<12>(out);
    }
}

/// Clears four taxels.
#[inline(always)]
fn empty<const AT: usize>(out: &mut Row16) {
    (out[AT], out[AT + 1], out[AT + 2], out[AT + 3]) = (0, 0, 0, 0);
}

/// Clamps a taxel with neighbours on both sides.
#[inline(always)]
fn inside<const AT: usize>(two: &Two, below: &Row16, out: &mut Row16, points: &mut bool) {
    let [above, here] = two;
    let (left, value, right) = (here[AT - 1], here[AT], here[AT + 1]);
    // Stored before the comparisons, so that it needs no register during them.
    out[AT] = value;
    let around =
        || [above[AT], below[AT], above[AT - 1], above[AT + 1], below[AT - 1], below[AT + 1]].into_iter();
    if value > right {
        if value > left && around().all(|other| other < value) {
            out[AT] = greatest(two, below, AT - 1, points);
        }
    } else if value < right && value < left && around().all(|other| other > value) {
        out[AT] = least(two, below, AT - 1);
    }
}

/// Clamps the first or the last taxel, given the column beside it.
#[inline(always)]
fn end<const AT: usize, const BESIDE: usize>(two: &Two, below: &Row16, out: &mut Row16, points: &mut bool) {
    let [above, here] = two;
    let (value, beside) = (here[AT], here[BESIDE]);
    out[AT] = value;
    let around = || [above[AT], below[AT], above[BESIDE], below[BESIDE]].into_iter();
    if value > beside {
        if around().all(|other| other < value) {
            let greatest = around().fold(beside, u16::max);
            out[AT] = greatest;
            *points |= stands_out(value, greatest);
        }
    } else if value < beside && around().all(|other| other > value) {
        out[AT] = around().fold(beside, u16::min);
    }
}

/// The greatest neighbour, given the column before. Out of line, like [`least`]: inlined, the compiler would
/// keep the neighbours on the stack.
#[inline(never)]
fn greatest(two: &Two, below: &Row16, first: usize, points: &mut bool) -> u16 {
    let greatest = neighbours(two, below, first).into_iter().fold(0, u16::max);
    let value = two[1].get(first + 1).copied().unwrap_or(0);
    *points |= stands_out(value, greatest);
    greatest
}

/// The smallest neighbour.
#[inline(never)]
fn least(two: &Two, below: &Row16, first: usize) -> u16 {
    neighbours(two, below, first).into_iter().fold(u16::MAX, u16::min)
}

/// All eight neighbours.
#[inline(always)]
fn neighbours(two: &Two, below: &Row16, first: usize) -> [u16; 8] {
    let three = |row: &Row16| row.get(first..).and_then(|row| row.first_chunk().copied());
    let [above, here] = two;
    let (Some([a, b, c]), Some([d, _, e]), Some([f, g, h])) = (three(above), three(here), three(below))
    else {
        return [0; 8];
    };
    [a, b, c, d, e, f, g, h]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::row16::ROW16;

    /// Few distinct values, so that many are equal, at both ends of the scale.
    #[test]
    fn a_taxel_is_within_the_range_of_its_neighbours() {
        let mut noise = 1u32;
        for round in 0..20_000 {
            let mut row = || {
                [(); ROW16].map(|()| {
                    noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
                    [0, 1, 700, 701, 0x7fff, 0x8000, 0xffff, round][(noise >> 29) as usize]
                })
            };
            let mut rows = [row(), row(), row()];
            // Sometimes some columns are zero, and are then left out.
            let groups = [u16::MAX, 0xff0f, 0x000f, 0x0110, 0][usize::from(round % 5)];
            for row in &mut rows {
                (0..ROW16).filter(|at| groups >> (at / 4 * 4) & 0xf == 0).for_each(|at| row[at] = 0);
            }
            let (mut out, mut points) = ([7; ROW16], false);
            clamp_row16(&[rows[0], rows[1]], &rows[2], groups, &mut out, &mut points);
            let stand_out = |(value, out): (&u16, &u16)| stands_out(*value, *out);
            assert_eq!(points, rows[1].iter().zip(&out).any(stand_out));
            for (column, have) in out.into_iter().enumerate() {
                let (mut low, mut high) = (u16::MAX, 0);
                for (row, beside) in (0..3).flat_map(|row| (0..ROW16).map(move |beside| (row, beside))) {
                    if beside.abs_diff(column) < 2 && (row, beside) != (1, column) {
                        (low, high) = (low.min(rows[row][beside]), high.max(rows[row][beside]));
                    }
                }
                assert_eq!(have, rows[1][column].clamp(low, high));
            }
        }
    }
}
