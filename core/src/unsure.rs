//! Contacts that may be nothing but drift: their baseline is unsure, and no intention follows from them.
//!
//! | | |
//! |---|---|
//! | input | contacts of a frame, drift of each panel, time |
//! | output | the contacts that are unsure |
//! | latency | none |
//! | RAM | [`UnsureState`] of 32 contacts: 1,032 bytes |
//! | M0+ cycles | about 90 a contact |
//!
//! A patch of a garment that warms up shows the same codes as an object that presses equally slowly; no
//! measurement distinguishes the two. A contact is unsure from the start if it came up slowly: for 0.4 s
//! before, something was nearly a contact in its panel, or another contact there is unsure, of which it may
//! be a part, or its panel drifts and it begins with no more than drift and noise explain. It becomes sure
//! once its peak has risen within 0.5 s by more than they explain: 16 counts where nothing drifts and noise is
//! 3 counts rms, more by the measured noise and drift of its panel. It is unsure again once its panel has
//! drifted, since the contact began, by twice its peak or more: taxels drift at 0.5 to 1.5 times the rate of
//! their panel, so that all of it may be drift.
//!
//! What a contact covers while its panel drifts may grow by drift, too. It holds the baseline where it lay when
//! its peak last rose faster, or when it came to another place.

use crate::body::Placed;
use crate::contact::Contact;
use crate::format::Micros;
use crate::garment::{PANELS, Rect};
use heapless::Vec;

/// A touch is nearly a contact for less than this time before it becomes one, us. Drift at 7.5 counts/s takes
/// three times as long.
const SLOW_US: u64 = 400_000;

/// Longest pause that does not restart the time of being nearly a contact, us: noise interrupts it.
const PAUSE_US: u64 = 200_000;

/// Window within which a touch rises by more than drift does, us.
const WINDOW_US: u32 = 500_000;

/// State of the contacts of the last frame, in the order of their onset.
#[derive(Debug, Clone)]
pub struct UnsureState<const CONTACTS: usize> {
    watched: Vec<Watched, CONTACTS>,
    faint: [Faint; PANELS],
    changed: bool,
}

/// First and last time at which something was nearly a contact in a panel.
#[derive(Debug, Clone, Copy)]
struct Faint {
    since: Micros,
    last: Micros,
}

/// Drift and noise of a panel, as far as they may be a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DriftLimits {
    /// Drift so far, counts.
    pub drifted: i32,
    /// Rise of a peak within [`WINDOW_US`], counts.
    pub rise: u16,
    /// Least peak of a contact that begins, counts.
    pub least: u16,
    /// True if the panel does not drift.
    pub still: bool,
}

/// State of a contact.
#[derive(Debug, Clone)]
struct Watched {
    id: u32,
    /// Begin of the window, us modulo 2^32.
    since: u32,
    /// Drift of its panel when the contact came there, counts modulo 2^16: a converter has no more.
    drifted: i16,
    /// While it is slow, its least peak since the window began, counts; then its greatest of late.
    reference: u16,
    panel: u8,
    /// True until it rises faster than drift.
    slow: bool,
    unsure: bool,
    /// Where it holds the baseline: what it covered when it last rose faster than drift.
    rect: Rect,
}

impl<const CONTACTS: usize> UnsureState<CONTACTS> {
    /// State without contacts.
    pub const fn new() -> Self {
        let never = Faint { since: Micros(0), last: Micros(0) };
        UnsureState { watched: Vec::new(), faint: [never; PANELS], changed: false }
    }

    /// True if the contact of this index in the last frame is unsure.
    pub fn is_unsure(&self, index: usize) -> bool {
        self.watched.get(index).is_some_and(|watched| watched.unsure)
    }

    /// Where the contact of this index in the last frame holds the baseline, and whether it never rose faster
    /// than drift.
    pub(crate) fn hold(&self, index: usize) -> Option<(Rect, bool)> {
        self.watched.get(index).map(|watched| (watched.rect, watched.slow))
    }

    /// True if a contact became unsure or sure with the last frame.
    pub const fn has_changed(&self) -> bool {
        self.changed
    }

    /// Ids of the unsure contacts.
    pub fn ids(&self) -> impl Iterator<Item = u32> {
        self.watched.iter().filter(|watched| watched.unsure).map(|watched| watched.id)
    }

    /// Takes the contacts of a frame, in the order of their onset. `faint` has a bit for each panel in which
    /// something is nearly a contact; `explained` returns the drift and noise of a panel.
    #[inline(never)] // M0+: out of line
    pub(crate) fn process(
        &mut self,
        present: &[Placed],
        faint: u8,
        explained: impl Fn(u8) -> DriftLimits,
        now: Micros,
    ) {
        self.changed = false;
        let ids = || present.iter().map(|placed| placed.contact.id);
        if !self.watched.iter().map(|watched| watched.id).eq(ids()) {
            self.begin(present, &explained, now);
        }
        for (watched, placed) in self.watched.iter_mut().zip(present) {
            let was = watched.unsure;
            let explained = explained(placed.contact.panel);
            watched.follow(&placed.contact, explained, now.0 as u32);
            self.changed |= watched.unsure != was;
        }
        if faint != 0 {
            let panels = self.faint.iter_mut().enumerate().filter(|(panel, _)| faint >> panel & 1 == 1);
            panels.for_each(|(_, faint)| faint.go_on(now));
        }
    }

    /// Forgets the contacts that have gone, and watches the new ones.
    fn begin(&mut self, present: &[Placed], explained: impl Fn(u8) -> DriftLimits, now: Micros) {
        self.watched.retain(|watched| present.iter().any(|placed| placed.contact.id == watched.id));
        for placed in present.iter().skip(self.watched.len()) {
            let (panel, peak, rect) = (placed.contact.panel, placed.contact.peak, placed.contact.bounds);
            let DriftLimits { drifted, rise, least, still } = explained(panel);
            let came_slowly = self.faint.get(usize::from(panel)).is_some_and(|faint| faint.is_slow(now));
            let before = if came_slowly { peak } else { peak.min(least - least / 4) };
            let slow = came_slowly
                || !still && peak <= before.saturating_add(rise)
                || self.watched.iter().any(|other| other.slow && other.panel == panel);
            let (id, since, drifted) = (placed.contact.id, now.0 as u32, drifted as i16);
            // Always room: as many places as contacts.
            let _ = self.watched.push(Watched {
                id,
                since,
                drifted,
                reference: before,
                panel,
                slow,
                unsure: false,
                rect,
            });
        }
    }
}

impl Faint {
    fn go_on(&mut self, now: Micros) {
        if now.since(self.last) > PAUSE_US {
            self.since = now;
        }
        self.last = now;
    }

    /// True if a contact that begins now came up slowly.
    fn is_slow(&self, now: Micros) -> bool {
        now.since(self.last) <= PAUSE_US && self.last.since(self.since) >= SLOW_US
    }
}

impl Watched {
    fn follow(&mut self, contact: &Contact, limits: DriftLimits, now: u32) {
        let (panel, peak, drifted) = (contact.panel, contact.peak, limits.drifted as i16);
        if panel != self.panel {
            (self.panel, self.drifted) = (panel, drifted);
        }
        let rises = peak > self.reference.saturating_add(limits.rise);
        let is_over = now.wrapping_sub(self.since) >= WINDOW_US;
        self.slow &= !rises;
        self.reference = match self.slow {
            false if is_over => peak.max(self.reference - self.reference / 4),
            false => peak.max(self.reference),
            true if is_over => peak,
            true => peak.min(self.reference),
        };
        if is_over {
            self.since = now;
        }
        let way = drifted.wrapping_sub(self.drifted).unsigned_abs() / 2;
        // Noise of the peak makes it sure no sooner than it is a quarter more.
        let doubted = if self.unsure { way.saturating_add(way / 4) } else { way };
        if limits.still || rises || self.slow || contact.bounds.has_left(&self.rect) {
            self.rect = contact.bounds;
        }
        self.unsure = self.slow || doubted >= peak;
    }
}

impl<const CONTACTS: usize> Default for UnsureState<CONTACTS> {
    fn default() -> Self {
        UnsureState::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Contact;
    use crate::garment::{Garment, Layout};
    use crate::shape::Shape;

    fn at(drifted: i32) -> DriftLimits {
        DriftLimits { drifted, rise: 16, least: 40, still: drifted == 0 }
    }

    fn placed(id: u32, panel: u8, peak: u16) -> Placed {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        Placed::new(&layout, Contact::of_nine(id, panel, u32::from(peak) * 9), Shape::default())
    }

    /// True if a contact with this peak over time, from 40 counts on, is unsure at the end, on a panel that
    /// drifts at `rate` counts/s.
    fn is_unsure(period_us: u64, seconds: f64, peak: impl Fn(f64) -> f64, rate: f64) -> bool {
        let mut state = UnsureState::<4>::new();
        for now in (0..(seconds * 1e6) as u64).step_by(period_us as usize) {
            let t = now as f64 / 1e6;
            let present = [placed(7, 0, peak(t) as u16)];
            let count = usize::from(present[0].contact.peak >= 40);
            let faint = u8::from(count == 0 && present[0].contact.peak >= 30);
            state.process(&present[..count], faint, |_| at((rate * t) as i32), Micros(now));
        }
        state.is_unsure(0)
    }

    #[test]
    fn what_creeps_is_unsure_at_any_rate() {
        for period_us in [640, 5_128, 40_000] {
            for rate in [0.5, 5.0, 7.5, 12.0] {
                assert!(is_unsure(period_us, 100.0 / rate, |t| rate * t, 0.0), "{rate} counts/s");
            }
            for rate in [40.0, 400.0, 40_000.0] {
                assert!(!is_unsure(period_us, 4.0, |t| (rate * t).min(3_000.0), 0.0), "{rate} counts/s");
            }
            // Comes at once, and stays.
            assert!(!is_unsure(period_us, 60.0, |t| if t < 1.0 { 0.0 } else { 41.0 }, 0.0));
        }
    }

    #[test]
    fn what_creeps_and_is_then_pressed_is_sure() {
        let course = |t: f64| if t < 20.0 { 5.0 * t } else { 300.0 };
        assert!(is_unsure(5_128, 20.0, course, 0.0) && !is_unsure(5_128, 20.2, course, 0.0));
    }

    #[test]
    fn noise_around_the_threshold_is_slow_and_a_long_pause_begins_anew() {
        for (pause_ms, slow) in [(150, true), (300, false)] {
            let mut state = UnsureState::<4>::new();
            let mut step = |ms: u64, contacts: &[Placed], faint: u8| {
                state.process(contacts, faint, |_| at(0), Micros(1_000 * ms));
                state.is_unsure(0)
            };
            for ms in (0..2_000).step_by(5) {
                step(ms, &[], 1);
            }
            assert_eq!(step(2_000 + pause_ms, &[placed(1, 0, 41)], 0), slow, "{pause_ms} ms");
        }
    }

    #[test]
    fn what_begins_beside_what_is_unsure_may_be_a_part_of_it() {
        let mut state = UnsureState::<4>::new();
        for ms in (0..1_000).step_by(5) {
            state.process(&[], 1, |_| at(0), Micros(1_000 * ms));
        }
        let later = [placed(1, 0, 44), placed(2, 0, 44), placed(3, 1, 44)];
        state.process(&later[..1], 0, |_| at(0), Micros(1_000_000));
        state.process(&later, 0, |_| at(0), Micros(3_000_000));
        assert_eq!([0, 1, 2].map(|index| state.is_unsure(index)), [true, true, false]);
    }

    #[test]
    fn what_is_held_is_unsure_once_its_panel_has_drifted_by_twice_as_much() {
        let held = |t: f64| if t < 1.0 { 0.0 } else { 600.0 };
        for rate in [20.0, -20.0] {
            assert!(!is_unsure(5_128, 60.0, held, rate), "{rate} counts/s");
            assert!(is_unsure(5_128, 62.0, held, rate), "{rate} counts/s");
        }
    }

    #[test]
    fn changes_are_reported_once_and_those_that_have_gone_are_forgotten() {
        let mut state = UnsureState::<4>::new();
        let mut step = |ids: &[u32], peak: u16, faint: u8, ms: u64| {
            let present: heapless::Vec<Placed, 4> = ids.iter().map(|id| placed(*id, 0, peak)).collect();
            state.process(&present, faint, |_| at(0), Micros(1_000 * ms));
            (state.ids().collect::<heapless::Vec<u32, 4>>(), state.has_changed())
        };
        let list = |ids: &[u32]| ids.iter().copied().collect::<heapless::Vec<u32, 4>>();
        for ms in 0..1_000 {
            assert_eq!(step(&[], 0, 1, ms), (list(&[]), false));
        }
        assert_eq!(step(&[1, 2], 41, 0, 1_000), (list(&[1, 2]), true));
        assert_eq!(step(&[1, 2], 42, 0, 1_200), (list(&[1, 2]), false));
        assert_eq!(step(&[2], 42, 0, 1_400), (list(&[2]), false));
        assert_eq!(step(&[2], 60, 0, 1_500), (list(&[]), true));
        assert_eq!(step(&[9], 41, 0, 1_600), (list(&[]), false));
        assert_eq!(step(&[], 0, 0, 1_700), (list(&[]), false));
    }

    #[test]
    fn what_a_contact_covers_grows_with_its_peak_alone_while_its_panel_drifts() {
        let mut state = UnsureState::<4>::new();
        let mut step = |ms: u64, peak: u16, right: u16, still: bool| {
            let mut contact = placed(1, 0, peak);
            contact.contact.bounds.right = right;
            let limits = |_: u8| DriftLimits { still, ..at(0) };
            state.process(&[contact], 0, limits, Micros(1_000 * ms));
            state.hold(0).map(|(rect, slow)| (rect.right, slow))
        };
        assert_eq!(step(0, 900, 5, true), Some((5, false)));
        assert_eq!(step(5, 900, 6, true), Some((6, false)));
        for ms in 2..200 {
            assert_eq!(step(5 * ms, 900 + (ms % 10) as u16, 9, false), Some((6, false)));
        }
        assert_eq!(step(1_000, 930, 9, false), Some((9, false)));
        // In another place it is as it is, unless it has spread.
        let mut at_columns = |left: u16, right: u16| {
            let mut contact = placed(1, 0, 930);
            (contact.contact.bounds.left, contact.contact.bounds.right) = (left, right);
            state.process(&[contact], 0, |_| DriftLimits { still: false, ..at(0) }, Micros(1_005_000));
            state.hold(0).map(|(rect, _)| (rect.left, rect.right))
        };
        assert_eq!(at_columns(10, 15), Some((10, 15)));
        assert_eq!(at_columns(11, 16), Some((10, 15)));
        assert_eq!(at_columns(16, 28), Some((10, 15)));
        assert_eq!(at_columns(16, 26), Some((16, 26)));
    }

    #[test]
    fn a_touch_on_a_drifting_panel_is_sure_once_it_exceeds_what_drift_explains() {
        for (peak, slow) in [(40, true), (46, true), (47, false), (90, false)] {
            let mut state = UnsureState::<4>::new();
            let limits = |_: u8| DriftLimits { still: false, ..at(0) };
            state.process(&[placed(1, 0, peak)], 0, limits, Micros(0));
            assert_eq!(state.is_unsure(0), slow, "{peak}");
        }
    }

    #[test]
    fn a_contact_that_crosses_to_another_panel_counts_the_drift_of_that_one() {
        let mut state = UnsureState::<4>::new();
        for (ms, panel) in [(0, 0), (5, 0), (10, 1), (600, 1)] {
            let drifted = |panel: u8| at(3_000 * i32::from(panel));
            state.process(&[placed(1, panel, 900)], 0, drifted, Micros(1_000 * ms));
            assert!(!state.is_unsure(0), "{ms} ms");
        }
    }
}
