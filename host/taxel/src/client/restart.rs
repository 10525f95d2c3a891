//! Detects that a board has restarted, and requests its settings again.

use super::again::Restored;
use super::{BoardDescription, Client, Event, Identity};
use crate::files::calibrate::ForceScale;
use crate::time::Instant;
use std::time::Duration;
use taxel_core::format::Micros;
use taxel_core::wire::{Receiver, Request, encode, frame_bound};

/// Number of `Hello`s in a row, without another message between them, that shows that the board has not been
/// started.
const LONELY: u8 = 2;

impl Client {
    /// Follows only the board of this identity: any other is refused, and its settings are kept for it.
    pub fn recognise(&mut self, identity: Identity) {
        (self.identity, self.is_only) = (identity, true);
    }

    /// Returns why the board that answers is refused, once: nothing that it says is taken.
    pub fn refused(&mut self) -> Option<String> {
        self.life.refused.take()
    }

    /// The link to a board is open: the short name of its source, and its serial number on USB if there is one.
    pub fn linked(&mut self, label: &str, usb_serial: Option<&str>) {
        self.link = (label.into(), usb_serial.map(String::from));
    }

    /// Forces are computed by this scale from now on.
    pub fn weigh_by(&mut self, scale: ForceScale) {
        self.scale = scale;
        self.weigh();
    }

    /// Newtons on the garment that the board has now.
    pub(super) fn weigh(&mut self) {
        let on = |it: &BoardDescription| self.scale.on(&it.layout, &it.calibration, it.is_simulated());
        self.newtons = self.description.as_ref().map(on);
    }

    /// The link was reopened. Discards a partial message, and asks the board to stream; its `Hello` shows which
    /// board it is and whether it has restarted, and nothing before it counts.
    pub fn reconnected(&mut self) {
        *self.receiver = Receiver::new();
        self.line.clear();
        self.requests = vec![0];
        self.syncs.restart();
        (self.life.met, self.life.started, self.life.hellos) = (false, false, 0);
        (self.life.reopened, self.life.stepped_back, self.life.is_known) = (true, false, false);
        self.ask_to_start();
    }

    /// Repeats `Start` at once, if the board was asked to stream.
    pub(crate) fn ask_to_start(&mut self) {
        let mut room = [0; frame_bound(8)];
        if self.streaming
            && let Ok(frame) = encode(&Request::Start, &mut room)
        {
            self.requests.extend_from_slice(frame);
        }
    }

    /// True once a `Hello` was received since the link was opened.
    pub fn is_met(&self) -> bool {
        self.life.met
    }

    /// True while the board's settings are being restored.
    pub fn is_restoring(&self) -> bool {
        self.life.again.is_under_way() || self.life.reopened
    }

    /// True if the board restored last has probably kept running, and only its link was lost.
    pub(crate) fn has_lived_on(&self) -> bool {
        self.life.lived_on
    }

    /// Returns the result of a restore, once.
    pub fn restored(&mut self) -> Option<Restored> {
        self.life.again.ended()
    }

    /// True if a request has been unanswered for so long that the board cannot have received it.
    pub(crate) fn is_overdue(&self, patience: Duration) -> bool {
        !self.is_restoring() && self.life.wanted.is_overdue(patience)
    }

    /// Restores all settings, as after a restart of the board.
    pub(crate) fn set_again(&mut self) {
        (self.life.reopened, self.life.lived_on) = (false, false);
        if self.streaming {
            let settings = self.life.wanted.all();
            self.life.again.begin(settings);
        }
    }

    /// Handles message numbers that have stepped back: a restart, or another board.
    pub(super) fn stepped_back(&mut self) {
        match self.life.reopened {
            true => self.life.stepped_back = true,
            false => self.begun_anew(),
        }
    }

    /// Handles a restart: discards earlier state.
    fn begun_anew(&mut self) {
        self.counts.restarts += 1;
        self.forget();
        self.shapes.clear();
        self.syncs.restart();
        (self.life.started, self.life.hellos, self.life.is_known) = (false, 0, false);
        self.set_again();
    }

    /// Handles another board than the one before: it gets nothing that was asked of that one, or is refused.
    fn replaced(&mut self, how: &str) {
        let why = format!("{} answers with another board: {how}", self.link.0);
        if self.is_only {
            self.life.reopened = true;
            // Reported once, not with each `Hello`.
            if self.life.reported_other.as_ref() != Some(&why) {
                self.say(Event::Other { why: why.clone() });
            }
            (self.life.refused, self.life.reported_other) = (Some(why.clone()), Some(why));
            return;
        }
        self.forget();
        self.shapes.clear();
        self.syncs.restart();
        (self.surface_regions, self.held, self.beside, self.identity) = Default::default();
        (self.health, self.budget, self.celsius) = (None, None, None);
        let was_asked = std::mem::take(&mut self.life).reopened;
        if !was_asked {
            self.ask_to_start();
        }
        self.say(Event::Other { why });
    }

    /// Handles a `Hello`, before it replaces the last one. Returns false if the board is refused.
    pub(super) fn greeted(&mut self, now: &BoardDescription) -> bool {
        let is_due = !self.life.is_known || self.identity.states_garment();
        if let Some(how) = self.identity.differs(self.link.1.as_deref(), now).filter(|_| is_due) {
            self.replaced(&how);
            if self.is_only {
                return false;
            }
        }
        self.recognised(now);
        self.identity.learn(self.link.1.as_deref(), now);
        (self.life.is_known, self.life.reported_other) = (true, None);
        true
    }

    /// Handles the `Hello` of the board that is followed: decides what it is to be set again.
    fn recognised(&mut self, now: &BoardDescription) {
        self.life.met = true;
        self.life.hellos = self.life.hellos.saturating_add(1);
        let goes_on = self.life.goes_on(now.clock) && !self.life.stepped_back;
        let is_same = self.life.wanted.agrees(now)
            && self
                .description
                .as_ref()
                .is_some_and(|before| before.garment == now.garment && before.calibration == now.calibration);
        if self.life.reopened {
            if goes_on && is_same {
                self.life.reopened = false;
                self.life.lived_on = true;
                let settings = self.life.wanted.unproven();
                self.life.again.begin(settings);
            } else if self.description.is_none() {
                // It was lost before it had said what it is: it need not have restarted.
                self.set_again();
                self.life.lived_on = goes_on;
            } else {
                self.begun_anew();
            }
        } else if self.life.started && !self.is_restoring() && self.life.hellos >= LONELY {
            self.begun_anew();
        }
        self.note_time(now.clock);
    }

    /// Handles any message except `Hello`.
    pub(super) fn spoken(&mut self) {
        self.life.hellos = 0;
    }

    /// Handles the current board time.
    pub(super) fn note_time(&mut self, clock: Micros) {
        self.life.clock = Some((clock, Instant::now()));
    }

    /// Last known board time.
    pub fn board_time(&self) -> Option<Micros> {
        self.life.clock.map(|(clock, _)| clock)
    }

    /// Handles an answer of the board.
    pub(super) fn answered(&mut self, number: u8, refusal: Option<&str>) {
        self.life.started |= number == Request::Start.number() && refusal.is_none();
        self.life.wanted.answered(number, refusal.is_none());
        self.life.again.answered(number, refusal);
    }
}
