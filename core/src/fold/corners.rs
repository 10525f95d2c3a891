//! Expected pressure on the taxels of a fold between the knots around its posture.

use super::lanes::{LaneSums, WHOLE, both, whole_bytes, zeros};
use super::lesson::MOST_PASSES;

/// Quads that are renewed at once: those of a frame, if the most that fold are renewed at 195 frames a second.
pub(super) const AT_ONCE: usize = 36;

/// Share of the doubt of days that is left after so many comparisons, whose mean is nearer to the day's own:
/// `1 / (1 + n)`, of [`WHOLE`].
const SHARES: [u16; MOST_PASSES as usize + 1] = [128, 64, 43, 32, 26, 22, 19, 16];

/// A knot around the present posture: of some quads of a fold.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    /// Means, spreads and days of four taxels each.
    pub cells: &'a [[u32; 3]],
    /// Corrections of four taxels each.
    pub corrections: &'a [u32],
    /// Weight of the knot, of [`WHOLE`].
    pub weight: u32,
}

/// Doubts of some quads: as much as at the nearest knot, after so many comparisons at that one which was
/// compared least.
pub(super) fn find_doubts<'a>(
    doubts: &mut [u32; AT_ONCE],
    nearest: Around<'a>,
    passes: u8,
    around: impl Iterator<Item = Around<'a>>,
) {
    let share = SHARES.get(usize::from(passes)).copied().unwrap_or(WHOLE);
    if share == WHOLE {
        doubt_whole(doubts, nearest.cells);
    } else {
        around.for_each(|knot| note_new(doubts, knot.corrections));
        doubt_share(doubts, nearest.cells, share.into());
    }
}

/// Adds a knot's part to what is expected of quads: to the start, see [`LaneSums::ends`].
#[inline(never)] // own registers
pub(super) fn add_means(ends: &mut [[LaneSums; 2]], Around { cells, corrections, weight }: Around<'_>) {
    for (([sums, _], [mean, ..]), correction) in ends.iter_mut().zip(cells).zip(corrections) {
        sums.add_lanes(&LaneSums::at_knot(*mean, *correction), weight);
    }
}

/// Finds what is expected at two knots, see [`LaneSums::ends`].
#[inline(never)] // own registers
pub(super) fn find_ends(ends: &mut [[LaneSums; 2]], first: Around<'_>, last: Around<'_>) {
    let first = first.cells.iter().zip(first.corrections);
    let last = last.cells.iter().zip(last.corrections);
    for ((ends, ([mean, ..], correction)), ([next, ..], next_correction)) in
        ends.iter_mut().zip(first).zip(last)
    {
        let (first, last) =
            (LaneSums::at_knot(*mean, *correction), LaneSums::at_knot(*next, *next_correction));
        *ends = LaneSums::ends(first, last);
    }
}

/// Notes the taxels that were not compared at a knot, by the highest bits of their bytes.
#[inline(never)] // own registers
fn note_new(new: &mut [u32], corrections: &[u32]) {
    for (new, correction) in new.iter_mut().zip(corrections) {
        *new |= zeros(*correction);
    }
}

/// Doubts of quads: those of days as a whole.
#[inline(never)] // own registers
fn doubt_whole(doubts: &mut [u32], cells: &[[u32; 3]]) {
    for (doubt, [_, spread, days]) in doubts.iter_mut().zip(cells) {
        *doubt = both(*spread, *days);
    }
}

/// Doubts of quads: those of days as a whole for the taxels that are new at a knot, whose bytes have their
/// highest bit set before, else a share of them.
#[inline(never)] // own registers
fn doubt_share(doubts: &mut [u32], cells: &[[u32; 3]], share: u32) {
    for (doubt, [_, spread, days]) in doubts.iter_mut().zip(cells) {
        let whole = days & whole_bytes(*doubt);
        let mut sums = LaneSums::ALMOST;
        sums.add(days ^ whole, share);
        // Each byte is of one of them.
        *doubt = both(*spread, sums.lanes().bytes() | whole);
    }
}
