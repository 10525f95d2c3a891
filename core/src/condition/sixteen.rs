//! Rows of sixteen taxels, each within the range of its eight neighbours: one comparison after another.
//!
//! Only a strict extreme of the nine is changed, so one neighbour that is not smaller and one that is not
//! greater settle a taxel. Few comparisons settle most: those beside it first.

use super::points::stands_out;

/// Taxels of a row.
pub(super) const SIXTEEN: usize = 16;
/// A row and the one before it: two places in memory, that of the row below and that of the result are all
/// that the registers of a Cortex-M0+ can tell beside what is compared.
pub(super) type Two = [Sixteen; 2];
/// A row.
pub(crate) type Sixteen = [u16; SIXTEEN];

/// Clamps the latter of two rows, given the one below. Of four columns none of which is among `groups`
/// nothing may be left. Sets `points` where a taxel [stands out](stands_out).
#[inline(always)]
pub(super) fn clamp_sixteen(two: &Two, below: &Sixteen, groups: u16, out: &mut Sixteen, points: &mut bool) {
    if groups == u16::MAX {
        clamp_groups::<true>(two, below, groups, out, points);
    } else {
        clamp_groups::<false>(two, below, groups, out, points);
    }
}

/// The same; if ALL, the groups are all there are. Not inlined, so that it has the registers to itself.
#[inline(never)]
fn clamp_groups<const ALL: bool>(
    two: &Two,
    below: &Sixteen,
    groups: u16,
    out: &mut Sixteen,
    points: &mut bool,
) {
    // A compiler keeps a loop of that length, and with it an index and sums for each taxel.
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

/// Four taxels without pressure.
#[inline(always)]
fn empty<const AT: usize>(out: &mut Sixteen) {
    (out[AT], out[AT + 1], out[AT + 2], out[AT + 3]) = (0, 0, 0, 0);
}

/// A taxel with neighbours on both sides.
#[inline(always)]
fn inside<const AT: usize>(two: &Two, below: &Sixteen, out: &mut Sixteen, points: &mut bool) {
    let [above, here] = two;
    let (left, value, right) = (here[AT - 1], here[AT], here[AT + 1]);
    // Kept at once: nothing is to be remembered while it is compared.
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

/// The first taxel, or the last, given the column beside it.
#[inline(always)]
fn end<const AT: usize, const BESIDE: usize>(
    two: &Two,
    below: &Sixteen,
    out: &mut Sixteen,
    points: &mut bool,
) {
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

/// The greatest neighbour, given the column before. Not inlined, as [`least`], lest the neighbours be kept
/// for it, one by one, on the stack.
#[inline(never)]
fn greatest(two: &Two, below: &Sixteen, first: usize, points: &mut bool) -> u16 {
    let greatest = neighbours(two, below, first).into_iter().fold(0, u16::max);
    let value = two[1].get(first + 1).copied().unwrap_or(0);
    *points |= stands_out(value, greatest);
    greatest
}

/// The smallest neighbour.
#[inline(never)]
fn least(two: &Two, below: &Sixteen, first: usize) -> u16 {
    neighbours(two, below, first).into_iter().fold(u16::MAX, u16::min)
}

/// All eight.
#[inline(always)]
fn neighbours(two: &Two, below: &Sixteen, first: usize) -> [u16; 8] {
    let three = |row: &Sixteen| row.get(first..).and_then(|row| row.first_chunk().copied());
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

    /// Few sizes, so that many are the same, at both ends of the scale.
    #[test]
    fn a_taxel_is_within_the_range_of_its_neighbours() {
        let mut noise = 1u32;
        for round in 0..20_000 {
            let mut row = || {
                [(); SIXTEEN].map(|()| {
                    noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
                    [0, 1, 700, 701, 0x7fff, 0x8000, 0xffff, round][(noise >> 29) as usize]
                })
            };
            let mut rows = [row(), row(), row()];
            // Sometimes nothing in some of the columns, which are left out then.
            let groups = [u16::MAX, 0xff0f, 0x000f, 0x0110, 0][usize::from(round % 5)];
            for row in &mut rows {
                (0..SIXTEEN).filter(|at| groups >> (at / 4 * 4) & 0xf == 0).for_each(|at| row[at] = 0);
            }
            let (mut out, mut points) = ([7; SIXTEEN], false);
            clamp_sixteen(&[rows[0], rows[1]], &rows[2], groups, &mut out, &mut points);
            let stand_out = |(value, out): (&u16, &u16)| stands_out(*value, *out);
            assert_eq!(points, rows[1].iter().zip(&out).any(stand_out));
            for (column, have) in out.into_iter().enumerate() {
                let (mut low, mut high) = (u16::MAX, 0);
                for (row, beside) in (0..3).flat_map(|row| (0..SIXTEEN).map(move |beside| (row, beside))) {
                    if beside.abs_diff(column) < 2 && (row, beside) != (1, column) {
                        (low, high) = (low.min(rows[row][beside]), high.max(rows[row][beside]));
                    }
                }
                assert_eq!(have, rows[1][column].clamp(low, high));
            }
        }
    }
}
