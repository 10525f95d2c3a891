//! Contacts that may be nothing but drift: their baseline is unsure, and no intention follows from them.
//!
//! | | |
//! |---|---|
//! | input | the contacts of a frame, what each panel has drifted, the time |
//! | output | which of them are unsure |
//! | latency | 0.5 s: before that a new contact counts as sure |
//! | RAM | 24 bytes a contact |
//! | M0+ cycles | about 60 a contact |
//!
//! A patch of a garment that warms shows the codes of a thing that presses as slowly, and nothing that is measured tells them apart. A
//! contact is unsure until its peak has risen by more than [`RISE`] within [`WINDOW_US`], which no drift does that the
//! garment is meant for (5 counts/s in a patch, half as much again for a taxel). It is unsure again once its panel has drifted, since
//! the contact began, by twice its peak or more: taxels drift at 0.5 to 1.5 times the rate of their panel, so that all of it may be drift.

use crate::body::Placed;
use crate::format::Micros;
use heapless::Vec;

/// A touch rises within this time by more than drift does, us.
const WINDOW_US: u64 = 500_000;

/// What drift and noise may add to a peak within [`WINDOW_US`], counts: four for the drift of a patch, twelve for noise.
const RISE: u16 = 16;

/// What is remembered of the contacts of the last frame, in the order of their onset.
#[derive(Debug, Clone)]
pub struct UnsureState<const CONTACTS: usize> {
    watched: Vec<Watched, CONTACTS>,
    changed: bool,
}

/// A contact, by its peak.
#[derive(Debug, Clone)]
struct Watched {
    id: u32,
    /// When the window began.
    since: Micros,
    /// What its panel had drifted when it came there, counts.
    drifted: i32,
    /// Least peak since the window began, counts.
    least: u16,
    panel: u8,
    rise: Rise,
    unsure: bool,
}

/// How a contact came.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rise {
    /// It is too young to tell.
    New,
    /// No faster than drift.
    Slow,
    /// Faster than drift.
    Quick,
}

impl<const CONTACTS: usize> UnsureState<CONTACTS> {
    /// Nothing touches.
    pub const fn new() -> Self {
        UnsureState { watched: Vec::new(), changed: false }
    }

    /// Whether the contact of this index of the last frame is unsure.
    pub fn is_unsure(&self, index: usize) -> bool {
        self.watched.get(index).is_some_and(|watched| watched.unsure)
    }

    /// Whether one has become unsure or sure with the last frame.
    pub const fn has_changed(&self) -> bool {
        self.changed
    }

    /// Ids of those that are unsure.
    pub fn ids(&self) -> impl Iterator<Item = u32> {
        self.watched.iter().filter(|watched| watched.unsure).map(|watched| watched.id)
    }

    /// Takes the contacts of a frame, in the order of their onset. A contact begins at a peak of `high` counts; `drifted` tells
    /// what a panel has drifted so far, counts.
    #[inline(never)] // M0+: out of line
    pub(crate) fn process(
        &mut self,
        present: &[Placed],
        high: u16,
        drifted: impl Fn(u8) -> i32,
        now: Micros,
    ) {
        self.changed = false;
        let ids = || present.iter().map(|placed| placed.contact.id);
        if !self.watched.iter().map(|watched| watched.id).eq(ids()) {
            self.watched.retain(|watched| ids().any(|id| id == watched.id));
        }
        for (index, placed) in present.iter().enumerate() {
            let (panel, peak) = (placed.contact.panel, placed.contact.peak);
            let drifted = drifted(panel);
            if index == self.watched.len() {
                let (id, since, rise) = (placed.contact.id, now, Rise::New);
                // As many places as contacts.
                let new = Watched { id, since, drifted, least: high, panel, rise, unsure: false };
                let _ = self.watched.push(new);
            }
            if let Some(watched) = self.watched.get_mut(index) {
                let was = watched.unsure;
                watched.follow(panel, peak, drifted, now);
                self.changed |= watched.unsure != was;
            }
        }
    }
}

impl Watched {
    fn follow(&mut self, panel: u8, peak: u16, drifted: i32, now: Micros) {
        if panel != self.panel {
            (self.panel, self.drifted) = (panel, drifted);
        }
        if self.rise != Rise::Quick {
            if peak > self.least.saturating_add(RISE) {
                self.rise = Rise::Quick;
            } else if now.since(self.since) >= WINDOW_US {
                (self.rise, self.since, self.least) = (Rise::Slow, now, peak);
            } else {
                self.least = self.least.min(peak);
            }
        }
        let way = drifted.wrapping_sub(self.drifted).unsigned_abs();
        self.unsure = self.rise == Rise::Slow || way >= 2 * u32::from(peak);
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
    use crate::format::{Fixed16, Q15};
    use crate::garment::{Garment, Layout, Place, Rect};
    use crate::shape::Shape;

    const HIGH: u16 = 40;

    fn placed(id: u32, panel: u8, peak: u16) -> Placed {
        let contact = Contact {
            id,
            phase: crate::contact::Phase::Held,
            panel,
            total: u32::from(peak) * 9,
            peak,
            peak_at: Place { panel, row: 4, column: 4 },
            area: 9,
            perimeter: 8,
            edge: 0,
            bounds: Rect { panel, top: 3, bottom: 5, left: 3, right: 5 },
            x: Fixed16(4 << 16),
            y: Fixed16(4 << 16),
            azimuth: None,
            anisotropy: Q15(0),
            breadth: 300,
            peak_breadth: 300,
            dx: Fixed16(0),
            dy: Fixed16(0),
            vx: Fixed16(0),
            vy: Fixed16(0),
            slip: false,
            onset: Micros(0),
            duration_ms: 0,
            peak_total: 0,
        };
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        Placed::new(&layout, contact, Shape::default())
    }

    /// Whether a contact is unsure at the end of a course of its peak over seconds, on a panel that drifts at `rate` counts/s.
    fn is_unsure(period_us: u64, seconds: f64, peak: impl Fn(f64) -> f64, rate: f64) -> bool {
        let mut state = UnsureState::<4>::new();
        for now in (0..(seconds * 1e6) as u64).step_by(period_us as usize) {
            let t = now as f64 / 1e6;
            let present = [placed(7, 0, peak(t) as u16)];
            state.process(&present, HIGH, |_| (rate * t) as i32, Micros(now));
        }
        state.is_unsure(0)
    }

    #[test]
    fn what_creeps_is_unsure_at_any_rate() {
        for period_us in [640, 5_128, 40_000] {
            for rate in [0.5, 5.0, 7.5] {
                assert!(is_unsure(period_us, 20.0, |t| 40.0 + rate * t, 0.0), "{rate} counts/s");
            }
            for rate in [40.0, 400.0, 40_000.0] {
                assert!(!is_unsure(period_us, 4.0, |t| (40.0 + rate * t).min(3_000.0), 0.0), "{rate} counts/s");
            }
            // It has come at once, and lies there.
            assert!(!is_unsure(period_us, 60.0, |_| 60.0, 0.0));
            // It is too young to tell.
            assert!(!is_unsure(period_us, 0.4, |_| 41.0, 0.0));
        }
    }

    #[test]
    fn what_creeps_and_is_then_pressed_is_sure() {
        let course = |t: f64| if t < 10.0 { 40.0 + 5.0 * t } else { 300.0 };
        assert!(is_unsure(5_128, 10.0, course, 0.0) && !is_unsure(5_128, 10.2, course, 0.0));
    }

    #[test]
    fn what_is_held_is_unsure_once_its_panel_has_drifted_by_twice_as_much() {
        for rate in [20.0, -20.0] {
            assert!(!is_unsure(5_128, 59.0, |_| 600.0, rate), "{rate} counts/s");
            assert!(is_unsure(5_128, 61.0, |_| 600.0, rate), "{rate} counts/s");
        }
    }

    #[test]
    fn changes_are_told_once_and_those_that_have_gone_are_forgotten() {
        let mut state = UnsureState::<4>::new();
        let mut step = |ids: &[u32], ms: u64| {
            let present: heapless::Vec<Placed, 4> = ids.iter().map(|id| placed(*id, 0, 41)).collect();
            state.process(&present, HIGH, |_| 0, Micros(1_000 * ms));
            (state.ids().collect::<heapless::Vec<u32, 4>>(), state.has_changed())
        };
        let list = |ids: &[u32]| ids.iter().copied().collect::<heapless::Vec<u32, 4>>();
        assert_eq!(step(&[1, 2], 0), (list(&[]), false));
        assert_eq!(step(&[1, 2, 3], 500), (list(&[1, 2]), true));
        assert_eq!(step(&[1, 2, 3], 700), (list(&[1, 2]), false));
        assert_eq!(step(&[2, 3], 1_100), (list(&[2, 3]), true));
        assert_eq!(step(&[9], 1_200), (list(&[]), false));
        assert_eq!(step(&[], 1_300), (list(&[]), false));
    }

    #[test]
    fn a_contact_that_crosses_to_another_panel_counts_the_drift_of_that_one() {
        let mut state = UnsureState::<4>::new();
        for (ms, panel) in [(0, 0), (5, 0), (10, 1), (600, 1)] {
            let drifted = |panel: u8| 100_000 * i32::from(panel);
            state.process(&[placed(1, panel, 900)], HIGH, drifted, Micros(1_000 * ms));
            assert!(!state.is_unsure(0), "{ms} ms");
        }
    }
}
