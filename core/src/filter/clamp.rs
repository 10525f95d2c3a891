//! Clamps a taxel to the range of its eight neighbours: by single comparisons, or many taxels at once.

use super::points::stands_out;
use crate::format::WIDE;

/// Taxels of a run, with one neighbour at each end: as many as fill a vector, or a few without SIMD.
pub(crate) const SHORT: usize = if WIDE { 10 } else { 9 };

/// Clamps all taxels of `here` except its ends, each to the range of its eight neighbours. Sets `points` if one
/// of them may [stand out](stands_out): with SIMD, to look is as fast as to note it here.
#[inline(always)]
pub(crate) fn clamp_run<const N: usize>(
    above: &[u16; N],
    here: &[u16; N],
    below: &[u16; N],
    out: &mut [u16; N],
    points: &mut bool,
) {
    if WIDE {
        by_range(above, here, below, out);
        *points = true;
    } else {
        by_comparison(above, here, below, out, points);
    }
}

/// Clamps all taxels at once.
fn by_range<const N: usize>(above: &[u16; N], here: &[u16; N], below: &[u16; N], out: &mut [u16; N]) {
    let rows = above.array_windows().zip(here.array_windows()).zip(below.array_windows());
    let inside = out.iter_mut().skip(1);
    rows.zip(inside).for_each(|(((above, here), below), out)| *out = clamp(above, here, below));
}

/// Clamps `here[1]` to the range of its neighbours.
#[inline(always)]
pub(crate) fn clamp(above: &[u16; 3], here: &[u16; 3], below: &[u16; 3]) -> u16 {
    let [left, value, right] = *here;
    let others = above.iter().chain(below);
    let (least, greatest) = others.fold((left.min(right), left.max(right)), |(least, greatest), other| {
        (least.min(*other), greatest.max(*other))
    });
    value.max(least).min(greatest)
}

/// Clamps one taxel after another.
#[inline(never)] // M0+: out of line
fn by_comparison<const N: usize>(
    above: &[u16; N],
    here: &[u16; N],
    below: &[u16; N],
    out: &mut [u16; N],
    points: &mut bool,
) {
    // Unrolled by hand: the compiler would keep a loop, with an index and five additions per taxel.
    step::<1, N>(above, here, below, out, points);
    step::<2, N>(above, here, below, out, points);
    step::<3, N>(above, here, below, out, points);
    step::<4, N>(above, here, below, out, points);
    step::<5, N>(above, here, below, out, points);
    step::<6, N>(above, here, below, out, points);
    step::<7, N>(above, here, below, out, points);
    step::<8, N>(above, here, below, out, points);
}

/// Clamps taxel AT. Only a strict extreme of the nine changes, so one neighbour that is not smaller and one
/// that is not greater settle a taxel: usually two or three comparisons.
#[inline(always)]
fn step<const AT: usize, const N: usize>(
    above: &[u16; N],
    here: &[u16; N],
    below: &[u16; N],
    out: &mut [u16; N],
    points: &mut bool,
) {
    let (Some(a), Some([left, value, right]), Some(b)) =
        (three(above, AT), three(here, AT), three(below, AT))
    else {
        // The run is shorter.
        return;
    };
    let mut settled = *value;
    if value > right {
        if value > left && around(a, b).all(|other| other < *value) {
            settled = greatest(above, here, below, AT);
            *points |= stands_out(*value, settled);
        }
    } else if value < right && value < left && around(a, b).all(|other| other > *value) {
        settled = least(above, here, below, AT);
    }
    if let Some(out) = out.get_mut(AT) {
        *out = settled;
    }
}

/// Neighbours above and below, nearest first.
#[inline(always)]
fn around(above: &[u16; 3], below: &[u16; 3]) -> impl Iterator<Item = u16> {
    [above[1], below[1], above[0], above[2], below[0], below[2]].into_iter()
}

/// A taxel of a row with its two neighbours.
#[inline(always)]
fn three<const N: usize>(row: &[u16; N], at: usize) -> Option<&[u16; 3]> {
    row.get(at - 1..)?.first_chunk()
}

/// The greatest neighbour. Out of line, like [`least`]: inlined, the compiler would keep the neighbours on
/// the stack.
#[inline(never)]
fn greatest<const N: usize>(above: &[u16; N], here: &[u16; N], below: &[u16; N], at: usize) -> u16 {
    fold_around(above, here, below, at, u16::max)
}

/// The smallest neighbour.
#[inline(never)]
fn least<const N: usize>(above: &[u16; N], here: &[u16; N], below: &[u16; N], at: usize) -> u16 {
    fold_around(above, here, below, at, u16::min)
}

#[inline(always)]
fn fold_around<const N: usize>(
    above: &[u16; N],
    here: &[u16; N],
    below: &[u16; N],
    at: usize,
    of: impl Fn(u16, u16) -> u16,
) -> u16 {
    let (Some(above), Some([left, _, right]), Some(below)) =
        (three(above, at), three(here, at), three(below, at))
    else {
        return 0;
    };
    above.iter().chain(below).fold(of(*left, *right), |end, other| of(end, *other))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All 3x3 values of four sizes, at both ends of the scale.
    #[test]
    fn to_compare_one_after_another_makes_no_difference() {
        for case in 0..1u32 << 18 {
            let rows = [0, 6, 12].map(|shift| {
                let mut row = [0; SHORT];
                for (at, value) in row.iter_mut().enumerate() {
                    // Other columns hold the same in another order.
                    let size = case >> (shift + 2 * (at % 3)) & 3;
                    *value = [0, 1, 0x8000, 0xffff][size as usize];
                }
                row
            });
            let mut out = [[0; SHORT]; 2];
            let [above, here, below] = &rows;
            let mut points = false;
            by_comparison(above, here, below, &mut out[0], &mut points);
            by_range(above, here, below, &mut out[1]);
            assert_eq!(out[0], out[1]);
            let mut inside = here.iter().zip(out[0]).skip(1).take(SHORT - 2);
            assert_eq!(points, inside.any(|(value, out)| stands_out(*value, out)));
        }
    }
}
