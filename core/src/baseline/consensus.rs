//! Drift of the panels as a whole.

use super::missed::{Followed, Missed};
use super::rates::COMMON;
use crate::format::Code;
use crate::garment::{Area, PANELS};
use crate::image::slices::panel_of;

/// Witnesses of a panel: taxels sampled for its drift.
const WITNESSES: usize = 16;

/// Least number of votes that count for a panel.
const FEWEST: usize = 4;

/// Largest distance of a code from its baseline that counts as noise, counts.
const NOISE: i32 = 4;

/// Largest offset of a witness from the others that is kept, counts: the panel would follow noise otherwise.
const APART: i32 = 8;

/// Largest common step in a turn that counts as drift, counts; beyond it an input is broken.
const BROKEN: i32 = 2 * COMMON;

/// Drift in a turn above which a panel drifts, and above which it drifts fast, counts.
const DRIFTS: i32 = 2;
const FAST: i32 = 4;

/// Shift by which a panel's mean drift follows that of a turn, in each half-turn: noise of the witnesses is
/// smoothed. Shift by which its pace fades: drift that reverses is slow for seconds.
const SMOOTHED: u32 = 3;
const FADES: u32 = 6;

/// Mean distance of untouched codes from their baselines before any was measured, Q8: that of noise of 4.8
/// counts rms.
const USUAL_NOISE: i32 = 1_000;
/// Shift of a row's sum of distances: a turn or two of a panel of 32 rows set the mean, ten of one of four.
const SLOWLY: u32 = 10;
/// Most taxels of a row that are summed up: with more the mean would swing.
const MEASURED: i32 = 512;

/// How fast a panel drifts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DriftPace {
    /// Not at all, or as slowly as a taxel may differ from its panel.
    Still,
    Slow,
    /// Faster than any slow touch rises.
    Fast,
}

/// Drift of each panel per turn, counts.
///
/// Twice a turn, each untouched witness votes with its drift beyond the known drift of its panel. If seven
/// eighths of the votes have the sign of their median and at least a quarter of its size, the panel moves by
/// the median: drift is common to a panel, while under a slow press a part of the panel stays at rest. If
/// only a majority has the same sign, the panel moves by one count per turn. An offset of a witness from the
/// others beyond noise is forgotten by one count per turn, and at once if the panel moves fast, so that it
/// does not hide common drift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Consensus {
    panels: [PanelDrift; PANELS],
    /// True if one of the panels drifts fast in this turn, and if one does or did in the last seconds.
    fast: bool,
    was_fast: bool,
    /// Mean distance of the untouched codes of each panel from their baselines moved in common, counts in Q8
    /// beyond [`USUAL_NOISE`]: noise, and what is left of drift.
    noise: [i16; PANELS],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct PanelDrift {
    /// Code of each witness if it had drifted with the panel; limited to 0 and 65535.
    known: [u16; WITNESSES],
    begun: bool,
    /// What its witnesses miss.
    missed: Missed,
    /// Drift in the previous half-turn, and in this one.
    steps: [i8; 2],
    /// Total drift, modulo 2^32.
    drifted: i32,
    /// Mean drift in a turn over some half-turns, and its greatest size of late, counts in Q4.
    mean: i16,
    pace: u16,
}

impl PanelDrift {
    const NONE: PanelDrift = PanelDrift {
        known: [0; WITNESSES],
        begun: false,
        missed: Missed::NONE,
        steps: [0; 2],
        drifted: 0,
        mean: 0,
        pace: 0,
    };

    /// Drift in a whole turn.
    fn in_turn(&self) -> i32 {
        i32::from(self.steps[0]) + i32::from(self.steps[1])
    }

    fn pace(&self) -> DriftPace {
        match i32::from(self.pace) {
            pace if pace > FAST << 4 => DriftPace::Fast,
            pace if pace > DRIFTS << 4 => DriftPace::Slow,
            _ => DriftPace::Still,
        }
    }
}

impl Consensus {
    pub const fn new() -> Self {
        Consensus { panels: [PanelDrift::NONE; PANELS], fast: false, was_fast: false, noise: [0; PANELS] }
    }

    /// Begins again after baselines have been set.
    pub fn forget(&mut self) {
        let begin =
            |panel: &mut PanelDrift| *panel = PanelDrift { drifted: panel.drifted, ..PanelDrift::NONE };
        self.panels.iter_mut().for_each(begin);
        (self.fast, self.was_fast) = (false, false);
    }

    /// Drift of a panel in this turn, counts.
    pub fn step(&self, panel: u8) -> i32 {
        self.panels.get(usize::from(panel)).map_or(0, PanelDrift::in_turn)
    }

    /// Total drift of a panel, counts modulo 2^32.
    pub fn drifted(&self, panel: u8) -> i32 {
        self.panels.get(usize::from(panel)).map_or(0, |panel| panel.drifted)
    }

    /// Takes what an untouched row of a panel showed.
    pub fn measure(&mut self, panel: u8, row: Followed) {
        let index = usize::from(panel);
        if let Some(noise) = self.noise.get_mut(index) {
            let (sum, count) = (row.distance.min(0xffff) as i32, row.count.min(0xffff) as i32);
            let beyond = (sum << 8) - count * (USUAL_NOISE + i32::from(*noise));
            let step = if count > MEASURED { 0 } else { beyond >> SLOWLY };
            *noise = (i32::from(*noise) + step).clamp(-USUAL_NOISE, i16::MAX.into()) as i16;
        }
        if let Some(panel) = self.panels.get_mut(index) {
            panel.missed.add(row);
        }
    }

    /// Drift of a panel in this turn beyond the step of its witnesses, counts.
    pub fn missed(&self, panel: u8) -> i32 {
        self.panels.get(usize::from(panel)).map_or(0, |panel| panel.missed.step.into())
    }

    /// Least peak that is clear of the noise of each panel, counts: five times its standard deviation, which is
    /// a quarter more than the mean distance.
    pub fn clear_of_noise(&self) -> [u16; PANELS] {
        self.noise.map(|noise| ((noise_of(noise) * 25) >> 10) as u16)
    }

    /// Rise of a peak within half a second that drift and noise of a panel may cause, counts: four for a patch,
    /// four times the standard deviation of the noise, and what the fastest taxel drifts.
    pub fn unexplained_rise(&self, panel: u8) -> u16 {
        let index = usize::from(panel);
        let noise = self.noise.get(index).map_or(0, |noise| noise_of(*noise) / 51);
        let pace = self.panels.get(index).map_or(0, |panel| panel.pace >> 4);
        4 + noise.max(12) as u16 + 2 * pace
    }

    /// How fast a panel drifts, or did in the last seconds.
    pub fn pace(&self, panel: u8) -> DriftPace {
        self.panels.get(usize::from(panel)).map_or(DriftPace::Still, PanelDrift::pace)
    }

    /// True if one of the panels drifts fast in this turn.
    pub const fn is_fast(&self) -> bool {
        self.fast
    }

    /// True if one of the panels drifts fast, or did in the last seconds.
    pub const fn was_fast(&self) -> bool {
        self.was_fast
    }

    /// Takes the votes of a panel's witnesses, given the baselines and gains of all taxels. `whole`: a turn
    /// begins, else it is half over; `touched` returns true for taxels of the panel under a contact.
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
        let mut beyond = [None; WITNESSES];
        for ((at, known), beyond) in places().zip(&panel.known).zip(&mut beyond) {
            // Absent and dead taxels do not vote.
            if gain.get(at).is_some_and(|gain| *gain != 0)
                && let (Some(code), Some(rest)) = (codes.get(at), baseline.get(at))
            {
                *beyond = drift_beyond(*known, *rest, *code, || touched(at));
            }
        }
        let mut sorted = if is_middle_zero(&beyond) { SortedVotes::NONE } else { SortedVotes::of(&beyond) };
        if sorted.middle().abs() > NOISE + 1 {
            // The median is more than noise, so witnesses that moved less vote with their codes, too.
            for ((at, known), beyond) in places().zip(&panel.known).zip(&mut beyond) {
                if let (Some(beyond), Some(code)) = (beyond, codes.get(at)) {
                    *beyond = i32::from(code.0) - i32::from(*known);
                }
            }
            sorted = SortedVotes::of(&beyond);
        }
        let middle = sorted.middle();
        let step = agreed(&sorted, panel.steps[1].into(), whole).clamp(-COMMON / 2, COMMON / 2);
        panel.steps = [panel.steps[1], step as i8];
        panel.drifted = panel.drifted.wrapping_add(step);
        // At half a turn without a step nothing is forgotten.
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
        if whole {
            panel.missed.turn(panel.in_turn(), panel.mean.signum().into());
        }
        panel.mean += ((panel.in_turn() << 4) as i16 - panel.mean) >> SMOOTHED;
        let faded = panel.pace.saturating_sub((panel.pace >> FADES) + 1);
        panel.pace = panel.mean.unsigned_abs().max(faded);
        self.fast = self.panels.iter().any(|panel| panel.in_turn().abs() > FAST);
        self.was_fast = self.panels.iter().any(|panel| panel.pace() == DriftPace::Fast);
    }
}

/// Mean distance of a panel's codes, counts in Q8.
fn noise_of(beyond_usual: i16) -> u32 {
    (USUAL_NOISE + i32::from(beyond_usual)).max(0) as u32
}

/// Drift of a witness beyond the known drift; none if it does not vote: it is touched beyond noise.
#[inline(always)]
fn drift_beyond(known: u16, rest: u16, code: Code, touched: impl FnOnce() -> bool) -> Option<i32> {
    let (code, rest, known) = (i32::from(code.0), i32::from(rest), i32::from(known));
    match (code - rest).abs() > NOISE {
        true => (!touched()).then_some(code - known),
        false => Some(rest - known),
    }
}

/// True if the median is 0, the usual case: then there is no agreement, and sorting is not needed.
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

/// Returns the step on which the votes agree, given the previous step; 0 for none. Fast drift goes on while
/// five eighths agree, because noise may hide it from some.
fn agreed(beyond: &SortedVotes, before: i32, whole: bool) -> i32 {
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

/// Votes in ascending order.
struct SortedVotes {
    numbers: [i32; WITNESSES],
    count: usize,
}

impl SortedVotes {
    const NONE: SortedVotes = SortedVotes { numbers: [0; WITNESSES], count: 0 };

    fn of(numbers: &[Option<i32>]) -> SortedVotes {
        let mut sorted = SortedVotes::NONE;
        numbers.iter().flatten().for_each(|number| sorted.insert(*number));
        sorted
    }

    fn insert(&mut self, number: i32) {
        let Some(end) = self.numbers.get_mut(self.count) else { return };
        *end = number;
        self.count += 1;
        // Insertion: usually no earlier number is greater.
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

    /// The median; 0 of no votes.
    fn middle(&self) -> i32 {
        self.all().get(self.count / 2).copied().unwrap_or(0)
    }
}

/// Taxels of the witnesses in a panel: an odd distance apart, so that they do not lie in one column.
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
            let sorted = SortedVotes::of(&beyond);
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
            let mut list = SortedVotes::NONE;
            numbers.iter().for_each(|number| list.insert(*number));
            assert!(list.all().is_sorted() && list.all().len() == numbers.len());
            list
        };
        let agreed_after = |before: i32, numbers: [i32; 16]| agreed(&sorted(&numbers), before, true);
        let agreed = |numbers| agreed_after(0, numbers);
        let spread = [14, 7, 21, 9, 12, 8, 20, 15, 11, 13, 10, 16, 17, 18, 19, 14];
        assert_eq!((agreed(spread), agreed(spread.map(|off| -off))), (14, -14));
        // Two of 16 may differ; with more a majority decides, and half is no majority.
        let but = |count: usize| core::array::from_fn(|at| if at < count { 0 } else { spread[at] });
        assert_eq!([2, 3, 7, 8].map(|count| agreed(but(count))), [14, 1, 1, 0]);
        assert_eq!(agreed([1, 1, 0, 0, -1, -1, 0, 2, 0, -2, 1, -1, 3, -3, 0, 0]), 0);
        assert_eq!([6, 7].map(|count| agreed_after(9, but(count))), [13, 1]);
        assert_eq!([9, -9, 2].map(|before| agreed_after(before, but(5))), [13, 1, 1]);
        assert_eq!(super::agreed(&sorted(&[5, 5, 5]), 0, true), 0);
        // At half a turn a majority alone decides nothing.
        assert_eq!([2, 3].map(|count| super::agreed(&sorted(&but(count)), 0, false)), [14, 0]);
    }
}
