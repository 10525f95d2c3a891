//! How the panels drift as a whole.

use super::rates::COMMON;
use super::slices::panel_of;
use crate::format::Code;
use crate::garment::{Area, PANELS};

/// Taxels of a panel that are asked.
const WITNESSES: usize = 16;

/// Fewest of them that say something for their panel.
const FEWEST: usize = 4;

/// A code so near its baseline is noise, counts.
const NOISE: i32 = 4;

/// Witnesses may stay so far apart, counts: their noise is remembered, or the panel would walk with it.
const APART: i32 = 8;

/// What moves all of a panel by more in a turn is no drift, but an input that broke, counts.
const BROKEN: i32 = 2 * COMMON;

/// A panel is fast that moves by more than so many counts in a turn.
const FAST: i32 = 4;

/// What each panel drifts in a turn, counts.
///
/// Once in a turn those of its witnesses that nothing touches tell how far they have drifted beyond what the panel is known to
/// have. It moves by their median if seven eighths of them are beyond it the same way, by a quarter of the median at least: drift
/// is common, and where something presses slowly a part of a panel stays at rest. If only most of them are beyond it, it moves by one count.
/// What sets a witness apart from the others by more than noise is forgotten by a count a turn, and at once where the panel moves
/// fast, so that it does not hide what all have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Consensus([Panel; PANELS]);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Panel {
    /// Where each witness would be, had it drifted as the panel has; below 0 or beyond 65535 it is held there.
    known: [u16; WITNESSES],
    begun: bool,
    /// Drift in this turn.
    step: i8,
}

impl Consensus {
    pub const fn new() -> Self {
        Consensus([Panel { known: [0; WITNESSES], begun: false, step: 0 }; PANELS])
    }

    /// Begins anew, since baselines have been set.
    pub fn forget(&mut self) {
        self.0.iter_mut().for_each(|panel| (panel.begun, panel.step) = (false, 0));
    }

    /// What a panel moves by in this turn, counts.
    pub fn step(&self, panel: u8) -> i32 {
        self.0.get(usize::from(panel)).map_or(0, |panel| panel.step.into())
    }

    /// Asks the witnesses of a panel, given the baselines and gains of all taxels; `touched` tells which of its taxels a contact
    /// holds.
    #[inline(never)] // M0+: out of line
    pub fn vote(
        &mut self,
        panel: u8,
        area: &Area,
        codes: &[Code],
        (baseline, gain): (&[u16], &[u16]),
        touched: impl Fn(usize) -> bool,
    ) {
        let Some(panel) = self.0.get_mut(usize::from(panel)) else { return };
        let (baseline, gain) = (panel_of(baseline, area), panel_of(gain, area));
        let codes = panel_of(codes, area);
        let places = || witnesses(baseline.len());
        if !panel.begun {
            panel.begun = true;
            places().zip(&mut panel.known).for_each(|(at, known)| {
                *known = baseline.get(at).copied().unwrap_or(0);
            });
        }
        // How far each is beyond what is known, if it was asked; and these in ascending order.
        let mut beyond = [None; WITNESSES];
        let (mut sorted, mut asked) = ([0; WITNESSES], 0);
        for ((at, known), beyond) in places().zip(&panel.known).zip(&mut beyond) {
            // Absent and dead ones are not asked.
            if gain.get(at).is_some_and(|gain| *gain != 0)
                && let (Some(code), Some(rest)) = (codes.get(at), baseline.get(at))
                && !touched(at)
            {
                let (code, rest) = (i32::from(code.0), i32::from(*rest));
                let now = if (code - rest).abs() > NOISE { code } else { rest };
                *beyond = Some(now - i32::from(*known));
                insert(&mut sorted, asked, now - i32::from(*known));
                asked += 1;
            }
        }
        let sorted = sorted.get(..asked).unwrap_or(&[]);
        let middle = sorted.get(asked / 2).copied().unwrap_or(0);
        let step = agreed(sorted, middle, panel.step.into()).clamp(-COMMON, COMMON);
        for (known, beyond) in panel.known.iter_mut().zip(beyond) {
            let apart = beyond.map_or(0, |beyond| beyond - middle);
            let forgotten = match apart.abs() > APART {
                _ if step.abs() > FAST => apart,
                true => apart.signum(),
                false => 0,
            };
            *known = (i32::from(*known) + step + forgotten).clamp(0, 0xffff) as u16;
        }
        panel.step = step as i8;
    }
}

/// What witnesses agree on, given how far they are beyond what is known, in ascending order, the one in the middle, and the step
/// before; 0 for nothing. Fast drift goes on while five eighths agree: noise may hide it from some.
fn agreed(beyond: &[i32], middle: i32, before: i32) -> i32 {
    if beyond.len() < FEWEST {
        return 0;
    }
    let with = |other: &&i32| other.signum() == middle.signum() && 4 * other.abs() >= middle.abs();
    let goes_on = before.abs() > FAST && before.signum() == middle.signum();
    let eighths = if goes_on { 5 } else { 7 };
    if middle.abs() <= BROKEN && beyond.iter().filter(with).count() * 8 >= beyond.len() * eighths {
        return middle;
    }
    let side = |way: i32| beyond.iter().filter(|beyond| beyond.signum() == way).count() * 2 > beyond.len();
    i32::from(side(1)) - i32::from(side(-1))
}

/// Puts a number where it belongs among the first `count`, which ascend.
fn insert(list: &mut [i32; WITNESSES], count: usize, number: i32) {
    let mut carried = number;
    for held in list.iter_mut().take(count) {
        if carried < *held {
            core::mem::swap(held, &mut carried);
        }
    }
    if let Some(end) = list.get_mut(count) {
        *end = carried;
    }
}

/// Where they are in a panel of so many taxels: an odd distance apart, lest they stand in one column.
fn witnesses(taxels: usize) -> impl Iterator<Item = usize> {
    let stride = (taxels / WITNESSES) | 1;
    (0..WITNESSES).scan(0, move |next, _| {
        let at = *next;
        *next += stride;
        if *next >= taxels {
            *next -= taxels;
        }
        Some(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_move_it_by_a_count_and_seven_eighths_by_what_they_agree_on() {
        let agreed_after = |before: i32, numbers: [i32; 16]| {
            let mut list = [0; WITNESSES];
            (0..).zip(numbers).for_each(|(count, number)| insert(&mut list, count, number));
            assert!(list.is_sorted());
            agreed(&list, list[8], before)
        };
        let agreed = |numbers| agreed_after(0, numbers);
        let spread = [14, 7, 21, 9, 12, 8, 20, 15, 11, 13, 10, 16, 17, 18, 19, 14];
        assert_eq!((agreed(spread), agreed(spread.map(|off| -off))), (14, -14));
        // Of 16 two may be elsewhere; then most decide, and half are not most.
        let but = |count: usize| core::array::from_fn(|at| if at < count { 0 } else { spread[at] });
        assert_eq!([2, 3, 7, 8].map(|count| agreed(but(count))), [14, 1, 1, 0]);
        assert_eq!(agreed([1, 1, 0, 0, -1, -1, 0, 2, 0, -2, 1, -1, 3, -3, 0, 0]), 0);
        assert_eq!([6, 7].map(|count| agreed_after(9, but(count))), [13, 1]);
        assert_eq!([9, -9, 4].map(|before| agreed_after(before, but(5))), [13, 1, 1]);
        assert_eq!(super::agreed(&[5, 5, 5], 5, 0), 0);
    }
}
