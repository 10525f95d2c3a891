//! The host's time, given to a client and asked of it.

use super::Client;
use super::clock::HostTime;
use taxel_core::format::Micros;

impl Client {
    /// Sets the host's time, microseconds since any epoch, never decreasing: before
    /// [`Client::take_requests`], whose bytes must then be sent at once, and after each read, before the
    /// bytes are pushed. The client then requests a streaming board's time, ten times in the first second,
    /// then once per second.
    pub fn tell_time(&mut self, host_us: u64) {
        self.syncs.now = Some(host_us);
    }

    /// Converts a board time to host time, with its uncertainty; none until the board has answered, or if the
    /// host's time is not set.
    pub fn host_time(&self, board: Micros) -> Option<HostTime> {
        self.syncs.clock.host_time(board)
    }

    /// Converts a host time, us, to board time; none until the board has answered, or if the host's time is
    /// not set.
    pub fn board_time_at(&self, host_us: u64) -> Option<Micros> {
        self.syncs.clock.board_time(host_us)
    }
}
