//! The host's time, given to a client and asked of it.

use super::Client;
use super::buses::{BusSeat, Buses};
use super::clock::HostTime;
use std::time::Duration;
use taxel_core::format::Micros;

impl Client {
    /// Sets the host's time, microseconds since any epoch, never decreasing: before
    /// [`Client::take_requests`], whose bytes must then be sent at once, and after each read, before the
    /// bytes are pushed. The client then requests a streaming board's time, ten times in the first second,
    /// then once per second.
    pub fn set_time(&mut self, host_us: u64) {
        self.syncs.now = Some(host_us);
    }

    /// The board may share a USB host controller with others, whose clients are sent the same `buses`: then
    /// all of them are on one time, within microseconds.
    pub fn share(&mut self, buses: Buses) {
        self.syncs.bus = Some(BusSeat::new(buses));
    }

    /// Number of the controller that the board is on, the same for all that share it; none until it is known.
    pub fn bus(&self) -> Option<usize> {
        self.syncs.bus.as_ref().and_then(BusSeat::bus)
    }

    /// True while the board is about to answer such a request: bytes that are read late then make the host's time
    /// of the board less certain.
    pub(crate) fn awaits_time(&self) -> bool {
        self.syncs.awaits_answer()
    }

    /// Time from the last of these requests that was answered to its answer; none until the board has answered, or
    /// if the host's time is not set.
    pub fn round_trip(&self) -> Option<Duration> {
        self.syncs.round_trip.map(Duration::from_micros)
    }

    /// Converts a board time to host time, with its uncertainty; none until the board has answered, or if the
    /// host's time is not set.
    pub fn host_time(&self, board: Micros) -> Option<HostTime> {
        self.syncs.host_time(board)
    }

    /// Converts a host time, us, to board time; none until the board has answered, or if the host's time is
    /// not set.
    pub fn board_time_at(&self, host_us: u64) -> Option<Micros> {
        self.syncs.board_time(host_us)
    }
}
