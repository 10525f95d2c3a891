//! Whether a board has started anew, and what is asked of it then.

use super::again::{Again, Restored};
use super::wanted::Wanted;
use super::{Client, Worn};
use std::time::{Duration, Instant};
use taxel_core::format::Micros;
use taxel_core::wire::{Receiver, Request, encode, frame_bound};

/// How far a board's clock may be from where it should be, besides a hundredth of the time that has passed, us.
const SLACK_US: u64 = 250_000;
/// `Hello`s after each other, and nothing else between them, by which a board says that nobody has started it.
const LONELY: u8 = 2;

/// What is known of a board's life.
#[derive(Debug, Default, Clone)]
pub(super) struct Life {
    /// What was asked of it.
    pub wanted: Wanted,
    /// What is set again.
    pub again: Again,
    /// It has answered `Start` since the last restart.
    started: bool,
    /// A `Hello` has come since the link was opened.
    met: bool,
    /// The link was opened again, and nothing says yet whether the board has lived on.
    reopened: bool,
    /// As far as can be told, the board did not restart when the link was lost last.
    lived_on: bool,
    /// `Hello`s since anything else came.
    hellos: u8,
    /// Its time when it was told last, and when that was.
    clock: Option<(Micros, Instant)>,
}

impl Life {
    /// Whether a clock that shows this time has gone on since it was told last.
    fn goes_on(&self, clock: Micros) -> bool {
        self.clock.is_some_and(|(then, told)| {
            let passed = u64::try_from(told.elapsed().as_micros()).unwrap_or(u64::MAX);
            let expected = then.0.saturating_add(passed);
            clock >= then && clock.0.abs_diff(expected) <= SLACK_US.saturating_add(passed / 100)
        })
    }
}

/// Restarts.
impl Client {
    /// The link was lost and is open again: what is left of the last message is no part of the next, and the
    /// board is asked to stream. Whether it has lived on meanwhile, its messages tell.
    pub fn reconnected(&mut self) {
        *self.receiver = Receiver::new();
        self.line.clear();
        self.requests = vec![0];
        self.syncs.restart();
        self.picture = Default::default();
        (self.life.met, self.life.started, self.life.hellos) = (false, false, 0);
        self.life.reopened = self.worn.is_some();
        self.ask_to_start();
    }

    /// Asks a board that was asked to stream once more, at once.
    pub fn ask_to_start(&mut self) {
        let mut room = [0; frame_bound(8)];
        if self.streaming
            && let Ok(frame) = encode(&Request::Start, &mut room)
        {
            self.requests.extend_from_slice(frame);
        }
    }

    /// Whether a `Hello` has come since the link was opened.
    pub fn is_met(&self) -> bool {
        self.life.met
    }

    /// Whether the board is being set again.
    pub fn is_restoring(&self) -> bool {
        self.life.again.is_under_way() || self.life.reopened
    }

    /// Whether the board that was set again last seems to have lived on, and only its link was lost.
    pub fn has_lived_on(&self) -> bool {
        self.life.lived_on
    }

    /// How setting the board again has ended, told once.
    pub fn restored(&mut self) -> Option<Restored> {
        self.life.again.ended()
    }

    /// Whether the board has left a request without its answer for so long that it cannot have had it.
    pub fn is_overdue(&self, patience: Duration) -> bool {
        !self.is_restoring() && self.life.wanted.is_overdue(patience)
    }

    /// Sets everything again that was set, as for a board that has started anew.
    pub fn set_again(&mut self) {
        (self.life.reopened, self.life.lived_on) = (false, false);
        if self.streaming {
            let wishes = self.life.wanted.all();
            self.life.again.begin(wishes);
        }
    }

    /// The numbers of messages say that the board has started anew: what it said before holds no more.
    pub(super) fn begun_anew(&mut self) {
        self.forget();
        self.shapes.clear();
        self.syncs.restart();
        (self.life.started, self.life.hellos) = (false, 0);
        self.set_again();
    }

    /// A `Hello` of this board, which said `before` until now.
    pub(super) fn greeted(&mut self, now: &Worn) {
        self.life.met = true;
        self.life.hellos = self.life.hellos.saturating_add(1);
        let goes_on = self.life.goes_on(now.clock);
        let is_same = self.life.wanted.agrees(now)
            && self
                .worn
                .as_ref()
                .is_some_and(|before| before.garment == now.garment && before.calibration == now.calibration);
        if self.life.reopened {
            if goes_on && is_same {
                self.life.reopened = false;
                self.life.lived_on = true;
                let wishes = self.life.wanted.unproven();
                self.life.again.begin(wishes);
            } else {
                self.counts.restarts += 1;
                self.begun_anew();
            }
        } else if self.life.started && !self.is_restoring() && self.life.hellos >= LONELY {
            self.counts.restarts += 1;
            self.begun_anew();
        }
        self.told_time(now.clock);
    }

    /// Something else than a `Hello` has come.
    pub(super) fn spoken(&mut self) {
        self.life.hellos = 0;
    }

    /// The board's time now.
    pub(super) fn told_time(&mut self, clock: Micros) {
        self.life.clock = Some((clock, Instant::now()));
    }

    /// The board's time when it was told last.
    pub fn board_time(&self) -> Option<Micros> {
        self.life.clock.map(|(clock, _)| clock)
    }

    /// An answer of the board.
    pub(super) fn answered(&mut self, number: u8, refusal: Option<&str>) {
        self.life.started |= number == Request::Start.number() && refusal.is_none();
        self.life.wanted.answered(number, refusal.is_none());
        self.life.again.answered(number, refusal);
    }
}
