//! Round trips of `Sync`: quick ones at the start, then one a second.

use super::clock::{HostClock, RoundTrip};
use std::collections::VecDeque;
use taxel_core::wire::{Request, SyncReport};

/// Number of quick round trips at the start, and the time between them, us.
const QUICK: (u32, u64) = (10, 100_000);
/// Time between two round trips afterwards, us.
const PERIOD: u64 = 1_000_000;
/// Most requests awaiting answers.
const OPEN: usize = 16;

/// The host's model of the board's clock.
#[derive(Debug, Default, Clone)]
pub(super) struct Syncs {
    /// Host time; none if it is not provided, and then nothing is requested.
    pub now: Option<u64>,
    due: u64,
    made: u32,
    token: u32,
    open: VecDeque<(u32, u64)>,
    /// The model itself.
    pub clock: HostClock,
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
        self.clock.take(&RoundTrip { asked, received, sent, answered });
    }

    /// The board has restarted.
    pub fn restart(&mut self) {
        self.clock.forget();
        self.open.clear();
        (self.made, self.due) = (0, 0);
    }
}
