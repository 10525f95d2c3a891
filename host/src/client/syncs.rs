//! Round trips of `Sync`: quick ones at the start, then one a second.

use super::Client;
use crate::clock::{HostClock, HostTime, RoundTrip};
use std::collections::VecDeque;
use taxel_core::format::Micros;
use taxel_core::wire::{Request, SyncReport};

/// Round trips at the start, and the time between two of them, us.
const QUICK: (u32, u64) = (10, 100_000);
/// Time between two round trips afterwards, us.
const PERIOD: u64 = 1_000_000;
/// Requests whose answers are waited for.
const OPEN: usize = 16;

/// The host's side of the board's clock.
#[derive(Debug, Default, Clone)]
pub(super) struct Syncs {
    /// The host's time; none: nobody tells it, and nothing is asked.
    now: Option<u64>,
    due: u64,
    made: u32,
    token: u32,
    open: VecDeque<(u32, u64)>,
    clock: HostClock,
}

impl Syncs {
    /// The request that is due, which is to be sent at once.
    pub fn next(&mut self) -> Option<Request<'static>> {
        let now = self.now.filter(|now| *now >= self.due)?;
        if self.made == 0 {
            // Answers to a program that was here before are not taken for ours.
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

    /// Takes an answer.
    pub fn take(&mut self, report: &SyncReport) {
        let asked = self.open.iter().position(|(token, _)| *token == report.token);
        let Some((_, asked)) = asked.and_then(|index| self.open.remove(index)) else { return };
        let Some(answered) = self.now else { return };
        let SyncReport { received, sent, .. } = *report;
        self.clock.take(&RoundTrip { asked, received, sent, answered });
    }

    /// The board has started anew.
    pub fn restart(&mut self) {
        self.clock.forget();
        self.open.clear();
        (self.made, self.due) = (0, 0);
    }
}

/// Time.
impl Client {
    /// Tells the host's time, microseconds since whatever epoch, never back: before
    /// [`Client::take_requests`], whose bytes are then sent at once, and after each read of bytes, before
    /// they are pushed. The client then asks a streaming board for its time, ten times in the first second,
    /// once a second later.
    pub fn tell_time(&mut self, host_us: u64) {
        self.syncs.now = Some(host_us);
    }

    /// The host's time of a time of the board, and how far from it the truth can be; none until the board has
    /// answered, and where nobody tells the time.
    pub fn host_time(&self, board: Micros) -> Option<HostTime> {
        self.syncs.clock.host_time(board)
    }
}
