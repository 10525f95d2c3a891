//! What the taxels of a fold are expected to feel between the knots around its posture.

use super::lanes::{LaneSums, WHOLE, both, whole_bytes, zeros};
use super::lesson::MOST_PASSES;

/// Quads that are renewed at once: those of a frame, if the most that fold are renewed at 195 frames a second.
pub(super) const AT_ONCE: usize = 36;

/// What is left of the doubt of days after so many comparisons, whose mean is nearer to the day's own:
/// `1 / (1 + n)`, of [`WHOLE`].
const SHARES: [u16; MOST_PASSES as usize + 1] = [128, 64, 43, 32, 26, 22, 19, 16];

/// A knot around the present posture: of some quads of a fold.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    /// Means, spreads and days of four taxels each.
    pub cells: &'a [[u32; 3]],
    /// Corrections of four taxels each.
    pub corrections: &'a [u32],
    /// How much it counts, of [`WHOLE`].
    pub weight: u32,
}

/// What some quads are expected to feel.
pub(super) struct Quads {
    pub expected: [u32; AT_ONCE],
    pub doubts: [u32; AT_ONCE],
}

impl Quads {
    pub const NONE: Quads = Quads { expected: [0; AT_ONCE], doubts: [0; AT_ONCE] };

    /// Nothing is expected: taxels may feel anything up to these.
    pub fn doubt_all(&mut self, most: &[u32]) {
        self.expected.fill(0);
        self.doubts.iter_mut().zip(most).for_each(|(doubt, most)| *doubt = *most);
    }

    /// Expects what lies between the knots around the posture of two joints.
    #[inline(never)] // own stack
    pub fn expect<'a>(&mut self, around: impl Iterator<Item = Around<'a>>) {
        let mut sums = [LaneSums::NONE; AT_ONCE];
        around.for_each(|knot| add_means(&mut sums, knot));
        self.expected.iter_mut().zip(sums).for_each(|(expected, sums)| *expected = sums.bytes());
    }

    /// Doubts as much as at the nearest knot, after so many comparisons at that one which was compared least.
    pub fn doubt<'a>(&mut self, nearest: Around<'a>, passes: u8, around: impl Iterator<Item = Around<'a>>) {
        let share = SHARES.get(usize::from(passes)).copied().unwrap_or(WHOLE);
        if share == WHOLE {
            doubt_whole(&mut self.doubts, nearest.cells);
        } else {
            self.doubts.fill(0);
            around.for_each(|knot| note_new(&mut self.doubts, knot.corrections));
            doubt_share(&mut self.doubts, nearest.cells, share.into());
        }
    }
}

/// Adds a knot's part to the expectations of quads.
#[inline(never)] // own registers
fn add_means(sums: &mut [LaneSums], Around { cells, corrections, weight }: Around<'_>) {
    for ((sums, [mean, ..]), correction) in sums.iter_mut().zip(cells).zip(corrections) {
        // 128 stands for a correction of 0.
        sums.add_both([*mean, correction | zeros(*correction)], weight);
    }
}

/// Finds what is expected at a knot: means and corrections together.
#[inline(never)] // own registers
pub(super) fn find_end(end: &mut [LaneSums], Around { cells, corrections, .. }: Around<'_>) {
    for ((end, [mean, ..]), correction) in end.iter_mut().zip(cells).zip(corrections) {
        *end = LaneSums::of([*mean, correction | zeros(*correction)]);
    }
}

/// What is expected between two knots, which count so much.
#[inline(never)] // own registers
pub(super) fn blend(expected: &mut [u32], ends: [&[LaneSums]; 2], weights: [u32; 2]) {
    let [first, last] = ends;
    for ((expected, first), last) in expected.iter_mut().zip(first).zip(last) {
        *expected = LaneSums::between(first, last, weights).bytes();
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
        *doubt = both(*spread, sums.within() | whole);
    }
}
