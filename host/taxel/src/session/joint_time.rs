//! Time at which positions of joints were read.

use crate::client::Client;
use taxel_core::format::Micros;

/// Time at which positions of joints were read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointTime {
    /// At this time of the board.
    Board(Micros),
    /// At this time of the host, us since 1970.
    Host(u64),
    /// Now.
    Now,
}

impl JointTime {
    /// The board's time, us, by its clock; before that is known, by what has passed since, if it is `now` on
    /// the board and `host_us` on the host. Below 0 before the board's start.
    pub(super) fn on_board(self, client: &Client, now: Micros, host_us: u64) -> i128 {
        match self {
            JointTime::Board(time) => time.0.into(),
            JointTime::Host(us) => {
                let ahead = i128::from(us) - i128::from(host_us);
                let by_clock = client.board_time_at(us).filter(|time| time.0 > 0);
                by_clock.map_or(i128::from(now.0) + ahead, |time| time.0.into())
            }
            JointTime::Now => now.0.into(),
        }
    }
}
