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

/// After so many halves of a turn at most a panel is no longer taken to drift fast, and each that is fast
/// counts for so many: noise hides the drift from the witnesses now and then, and when it turns it is slow
/// for seconds.
const LASTING: u8 = 40;
const LASTS: u8 = 4;

/// What each panel drifts in a turn, counts.
///
/// Twice in a turn those of its witnesses that nothing touches tell how far they have drifted beyond what the
/// panel is known to have. It moves by their median if seven eighths of them are beyond it the same way, by a
/// quarter of the median at least: drift is common, and where something presses slowly a part of a panel
/// stays at rest. If only most of them are beyond it, it moves by one count a turn. What sets a witness apart
/// from the others by more than noise is forgotten by a count a turn, and at once where the panel moves fast,
/// so that it does not hide what all have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Consensus {
    panels: [Panel; PANELS],
    /// One of them drifts fast.
    fast: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Panel {
    /// Where each witness would be, had it drifted as the panel has; below 0 or beyond 65535 it is held there.
    known: [u16; WITNESSES],
    begun: bool,
    /// Drift in the half of a turn before, and in this one.
    steps: [i8; 2],
    /// All of it so far, modulo 2^32.
    drifted: i32,
    /// Halves of a turn for which it is still taken to drift fast.
    lately: u8,
}

impl Panel {
    /// Drift in a whole turn.
    fn in_turn(&self) -> i32 {
        i32::from(self.steps[0]) + i32::from(self.steps[1])
    }
}

impl Consensus {
    pub const fn new() -> Self {
        let panel = Panel { known: [0; WITNESSES], begun: false, steps: [0; 2], drifted: 0, lately: 0 };
        Consensus { panels: [panel; PANELS], fast: false }
    }

    /// Begins anew, since baselines have been set.
    pub fn forget(&mut self) {
        let begin = |panel: &mut Panel| (panel.begun, panel.steps, panel.lately) = (false, [0; 2], 0);
        self.panels.iter_mut().for_each(begin);
        self.fast = false;
    }

    /// What a panel moves by in this turn, counts.
    pub fn step(&self, panel: u8) -> i32 {
        self.panels.get(usize::from(panel)).map_or(0, Panel::in_turn)
    }

    /// What a panel has drifted so far, counts modulo 2^32.
    pub fn drifted(&self, panel: u8) -> i32 {
        self.panels.get(usize::from(panel)).map_or(0, |panel| panel.drifted)
    }

    /// Whether this panel drifts fast, or did a moment ago.
    pub fn was_fast(&self, panel: u8) -> bool {
        self.panels.get(usize::from(panel)).is_some_and(|panel| panel.lately > 0)
    }

    /// Whether one of the panels drifts fast.
    pub const fn is_fast(&self) -> bool {
        self.fast
    }

    /// Asks the witnesses of a panel, given the baselines and gains of all taxels. `whole`: a turn begins, else
    /// it is half over; `touched` tells which of its taxels a contact holds.
    #[inline(never)] // M0+: out of line
    pub fn vote(
        &mut self,
        panel: u8,
        area: &Area,
        codes: &[Code],
        (baseline, gain): (&[u16], &[u16]),
        whole: bool,
        touched: impl Fn(usize) -> bool,
    ) {
        let Some(panel) = self.panels.get_mut(usize::from(panel)) else { return };
        let (baseline, gain) = (panel_of(baseline, area), panel_of(gain, area));
        let codes = panel_of(codes, area);
        let places = || witnesses(baseline.len());
        if !panel.begun {
            panel.begun = true;
            places().zip(&mut panel.known).for_each(|(at, known)| {
                *known = baseline.get(at).copied().unwrap_or(0);
            });
        }
        // How far each is beyond what is known, if it was asked.
        let mut beyond = [None; WITNESSES];
        for ((at, known), beyond) in places().zip(&panel.known).zip(&mut beyond) {
            // Absent and dead ones are not asked, nor what is held.
            if gain.get(at).is_some_and(|gain| *gain != 0)
                && let (Some(code), Some(rest)) = (codes.get(at), baseline.get(at))
            {
                let (code, rest, known) = (i32::from(code.0), i32::from(*rest), i32::from(*known));
                *beyond = match (code - rest).abs() > NOISE {
                    true => (!touched(at)).then_some(code - known),
                    false => Some(rest - known),
                };
            }
        }
        let mut sorted = if is_middle_zero(&beyond) { Sorted::NONE } else { Sorted::of(&beyond) };
        if sorted.middle().abs() > NOISE + 1 {
            // That is more than noise: those who have moved less are believed, too.
            for ((at, known), beyond) in places().zip(&panel.known).zip(&mut beyond) {
                if let (Some(beyond), Some(code)) = (beyond, codes.get(at)) {
                    *beyond = i32::from(code.0) - i32::from(*known);
                }
            }
            sorted = Sorted::of(&beyond);
        }
        let middle = sorted.middle();
        let step = agreed(&sorted, panel.steps[1].into(), whole).clamp(-COMMON / 2, COMMON / 2);
        panel.steps = [panel.steps[1], step as i8];
        panel.drifted = panel.drifted.wrapping_add(step);
        // In the middle of a turn in which nothing moves, nothing is forgotten either.
        let changed = if whole || step != 0 { WITNESSES } else { 0 };
        for (known, beyond) in panel.known.iter_mut().zip(beyond).take(changed) {
            let apart = beyond.map_or(0, |beyond| beyond - middle);
            let forgotten = match apart.abs() > APART {
                _ if step.abs() > FAST / 2 => apart,
                true if whole => apart.signum(),
                _ => 0,
            };
            *known = (i32::from(*known) + step + forgotten).clamp(0, 0xffff) as u16;
        }
        panel.lately = match panel.in_turn().abs() > FAST {
            true => panel.lately.saturating_add(LASTS).min(LASTING),
            false => panel.lately.saturating_sub(1),
        };
        self.fast = self.panels.iter().any(|panel| panel.in_turn().abs() > FAST);
    }
}

/// Whether the one in the middle has not moved, as mostly: then they agree on nothing, and need not be sorted.
fn is_middle_zero(beyond: &[Option<i32>; WITNESSES]) -> bool {
    let (mut below, mut above, mut asked) = (0, 0, 0);
    for beyond in beyond.iter().flatten() {
        below += usize::from(*beyond < 0);
        above += usize::from(*beyond > 0);
        asked += 1;
    }
    let middle = asked / 2;
    below <= middle && above < asked - middle
}

/// What witnesses agree on, given how far they are beyond what is known and the step before; 0 for nothing.
/// Fast drift goes on while five eighths agree: noise may hide it from some.
fn agreed(beyond: &Sorted, before: i32, whole: bool) -> i32 {
    let (all, middle) = (beyond.all(), beyond.middle());
    if all.len() < FEWEST {
        return 0;
    }
    let with = |other: &&i32| other.signum() == middle.signum() && 4 * other.abs() >= middle.abs();
    let goes_on = before.abs() > FAST / 2 && before.signum() == middle.signum();
    let eighths = if goes_on { 5 } else { 7 };
    if middle.abs() <= BROKEN && all.iter().filter(with).count() * 8 >= all.len() * eighths {
        return middle;
    }
    let side = |way: i32| all.iter().filter(|beyond| beyond.signum() == way).count() * 2 > all.len();
    if whole { i32::from(side(1)) - i32::from(side(-1)) } else { 0 }
}

/// What witnesses told, in ascending order.
struct Sorted {
    numbers: [i32; WITNESSES],
    count: usize,
}

impl Sorted {
    const NONE: Sorted = Sorted { numbers: [0; WITNESSES], count: 0 };

    fn of(told: &[Option<i32>]) -> Sorted {
        let mut sorted = Sorted::NONE;
        told.iter().flatten().for_each(|number| sorted.insert(*number));
        sorted
    }

    fn insert(&mut self, number: i32) {
        let Some(end) = self.numbers.get_mut(self.count) else { return };
        *end = number;
        self.count += 1;
        // Down to its place: mostly none of those before is greater.
        let mut left = self.numbers.get_mut(..self.count).unwrap_or(&mut []);
        while let [rest @ .., before, last] = left
            && *before > *last
        {
            core::mem::swap(before, last);
            let length = rest.len() + 1;
            left = left.get_mut(..length).unwrap_or(&mut []);
        }
    }

    fn all(&self) -> &[i32] {
        self.numbers.get(..self.count).unwrap_or(&[])
    }

    /// The one in the middle; 0 of none.
    fn middle(&self) -> i32 {
        self.all().get(self.count / 2).copied().unwrap_or(0)
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
    fn where_the_middle_is_zero_nothing_is_agreed() {
        let mut state = 1u32;
        let mut next = |end: u32| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (state >> 8) % end
        };
        let mut zeros = 0;
        for _ in 0..20_000 {
            let (silent, span) = (next(16), 1 + 2 * next(4));
            let beyond: [Option<i32>; WITNESSES] =
                core::array::from_fn(|_| (next(16) >= silent).then(|| next(span) as i32 - span as i32 / 2));
            let sorted = Sorted::of(&beyond);
            let is_zero = !sorted.all().is_empty() && sorted.middle() == 0;
            assert_eq!(is_middle_zero(&beyond), is_zero, "{beyond:?}");
            if sorted.middle() == 0 {
                zeros += 1;
                let before = next(40) as i32 - 20;
                assert_eq!([true, false].map(|whole| agreed(&sorted, before, whole)), [0, 0], "{beyond:?}");
            }
        }
        assert!((2_000..18_000).contains(&zeros));
    }

    #[test]
    fn most_move_it_by_a_count_and_seven_eighths_by_what_they_agree_on() {
        let sorted = |numbers: &[i32]| {
            let mut list = Sorted::NONE;
            numbers.iter().for_each(|number| list.insert(*number));
            assert!(list.all().is_sorted() && list.all().len() == numbers.len());
            list
        };
        let agreed_after = |before: i32, numbers: [i32; 16]| agreed(&sorted(&numbers), before, true);
        let agreed = |numbers| agreed_after(0, numbers);
        let spread = [14, 7, 21, 9, 12, 8, 20, 15, 11, 13, 10, 16, 17, 18, 19, 14];
        assert_eq!((agreed(spread), agreed(spread.map(|off| -off))), (14, -14));
        // Of 16 two may be elsewhere; then most decide, and half are not most.
        let but = |count: usize| core::array::from_fn(|at| if at < count { 0 } else { spread[at] });
        assert_eq!([2, 3, 7, 8].map(|count| agreed(but(count))), [14, 1, 1, 0]);
        assert_eq!(agreed([1, 1, 0, 0, -1, -1, 0, 2, 0, -2, 1, -1, 3, -3, 0, 0]), 0);
        assert_eq!([6, 7].map(|count| agreed_after(9, but(count))), [13, 1]);
        assert_eq!([9, -9, 2].map(|before| agreed_after(before, but(5))), [13, 1, 1]);
        assert_eq!(super::agreed(&sorted(&[5, 5, 5]), 0, true), 0);
        // In the middle of a turn most alone decide nothing.
        assert_eq!([2, 3].map(|count| super::agreed(&sorted(&but(count)), 0, false)), [14, 0]);
    }
}
