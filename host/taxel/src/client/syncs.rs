//! Round trips of `Sync`: quick ones at the start, then one a second; and the starts of frames that come with
//! them.

use super::buses::BusSeat;
use super::clock::{HostClock, HostTime, RoundTrip};
use std::collections::VecDeque;
use taxel_core::format::Micros;
use taxel_core::wire::{Request, StartOfFrame, SyncReport};

/// Number of quick round trips at the start, and the time between them, us.
const QUICK: (u32, u64) = (10, 100_000);
/// Time between two round trips afterwards, us.
const PERIOD: u64 = 1_000_000;
/// Most requests awaiting answers.
const OPEN: usize = 16;
/// Time after which an answer is no longer expected at any moment, us.
const SOON: u64 = 50_000;

/// The host's model of the board's clock.
#[derive(Debug, Default, Clone)]
pub(super) struct Syncs {
    /// Host time; none if it is not provided, and then nothing is requested.
    pub now: Option<u64>,
    due: u64,
    made: u32,
    token: u32,
    open: VecDeque<(u32, u64)>,
    /// Time between the last request that was answered and its answer, us.
    pub round_trip: Option<u64>,
    /// The model itself.
    clock: HostClock,
    /// The board's place on a USB that it may share with others; none if nobody has asked for that.
    pub bus: Option<BusSeat>,
}

impl Syncs {
    /// Returns the request that is due; it must be sent at once.
    pub fn next(&mut self) -> Option<Request<'static>> {
        let now = self.now.filter(|now| *now >= self.due)?;
        if self.made == 0 {
            // Starts at the time, so that answers to an earlier program are not taken for ours.
            self.token = now as u32;
        }
        self.token = self.token.wrapping_add(1);
        self.due = now + if self.made < QUICK.0 { QUICK.1 } else { PERIOD };
        self.made = self.made.saturating_add(1);
        self.open.push_back((self.token, now));
        if self.open.len() > OPEN {
            self.open.pop_front();
        }
        Some(Request::Sync { token: self.token })
    }

    /// Handles an answer.
    pub fn take(&mut self, report: &SyncReport) {
        let asked = self.open.iter().position(|(token, _)| *token == report.token);
        let Some((_, asked)) = asked.and_then(|index| self.open.remove(index)) else { return };
        let Some(answered) = self.now else { return };
        let SyncReport { received, sent, .. } = *report;
        self.round_trip = Some(answered.saturating_sub(asked));
        let trip = RoundTrip { asked, received, sent, answered };
        self.clock.take(&trip);
        self.bus.iter_mut().for_each(|bus| bus.trip(&trip));
    }

    /// True if an answer is expected at any moment.
    pub(crate) fn awaits_answer(&self) -> bool {
        let asked = self.open.back().zip(self.now);
        asked.is_some_and(|((_, asked), now)| now.saturating_sub(*asked) < SOON)
    }

    /// Handles the start of a frame.
    pub fn start_of_frame(&mut self, start: &StartOfFrame) {
        self.bus.iter_mut().for_each(|bus| bus.take(start, &self.clock));
    }

    /// Host time of a board time; none before the first answer. That of the bus, if the board is on one, but
    /// never beyond the bounds of the board's own round trips.
    pub fn host_time(&self, board: Micros) -> Option<HostTime> {
        let own = self.clock.host_time(board)?;
        let Some(shared) = self.bus.as_ref().and_then(|bus| bus.host_us(board)) else { return Some(own) };
        let [low, high] =
            [own.us.saturating_sub(own.uncertainty_us), own.us.saturating_add(own.uncertainty_us)];
        let us = shared.clamp(low, high);
        Some(HostTime { us, uncertainty_us: (us - low).max(high - us) })
    }

    /// Board time of a host time, us: the inverse of [`Syncs::host_time`], within 1 us.
    pub fn board_time(&self, host_us: u64) -> Option<Micros> {
        let mut board = self.clock.board_time(host_us)?;
        for _ in 0..2 {
            let off = host_us.wrapping_sub(self.host_time(board)?.us) as i64;
            board = Micros(board.0.saturating_add_signed(off));
        }
        Some(board)
    }

    /// The board has restarted.
    pub fn restart(&mut self) {
        self.clock.forget();
        self.bus.iter_mut().for_each(BusSeat::leave);
        self.open.clear();
        self.round_trip = None;
        (self.made, self.due) = (0, 0);
    }
}
