//! Host times of a board's messages.

use crate::client::clock::SteadyTime;
use crate::client::{Client, Event};
use serde_json::Value;
use taxel_core::format::Micros;

/// Nanoseconds per microsecond.
pub(crate) const NS: u64 = 1000;

/// Times of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// The board's time, us; 0 before it has reported any.
    pub board_us: u64,
    /// The host's time of the same moment, us since 1970.
    pub host_us: u64,
    /// Uncertainty of the host's time, us; none before the first round trip.
    pub uncertainty_us: Option<u64>,
}

impl Stamp {
    /// Makes the stamp of a recording: of the host's time and the board's, ns.
    pub fn recorded(host_ns: u64, board_ns: u64) -> Stamp {
        Stamp { board_us: board_ns / NS, host_us: host_ns / NS, uncertainty_us: None }
    }

    /// The host's time, ns since 1970, as stored in recordings; saturates.
    pub fn host_ns(&self) -> u64 {
        self.host_us.saturating_mul(NS)
    }

    /// The board's time, ns; saturates.
    pub(crate) fn board_ns(&self) -> u64 {
        self.board_us.saturating_mul(NS)
    }

    /// Adds the host's time to a JSON line: `host_time_us`, and if its error has a bound
    /// `host_time_uncertainty_us`.
    pub fn mark(&self, line: &mut Value) {
        line["host_time_us"] = self.host_us.into();
        if let Some(uncertainty_us) = self.uncertainty_us {
            line["host_time_uncertainty_us"] = uncertainty_us.into();
        }
    }
}

/// Assigns host times.
#[derive(Debug)]
pub struct Stamps {
    time: SteadyTime,
    /// A board time, and the host's time when it was first received.
    heard: Option<(u64, u64)>,
    /// The board's time of the last event; none before it has reported any.
    last: Option<u64>,
}

impl Stamps {
    /// Starts now.
    pub fn start() -> Stamps {
        Stamps::by(SteadyTime::start())
    }

    /// Starts by a time that others go by, too.
    pub fn by(time: SteadyTime) -> Stamps {
        Stamps { time, heard: None, last: None }
    }

    /// Stamp of an event: by the clock of a board that has answered a `Sync`; else by the arrival of the
    /// first message, and the board time since. An event without a time has that of the one before, or that of its
    /// arrival.
    pub fn of(&mut self, client: &Client, event: &Event) -> Stamp {
        self.last = time_of(client, event).or(self.last);
        self.now(client)
    }

    /// True once the board has reported a time.
    pub fn is_known(&self) -> bool {
        self.last.is_some()
    }

    /// Stamp of an action of the host: that of the last message.
    pub fn now(&mut self, client: &Client) -> Stamp {
        let Some(board_us) = self.last else {
            return Stamp { board_us: 0, host_us: self.time.now_us(), uncertainty_us: None };
        };
        self.at(client, board_us)
    }

    /// Stamp of a time of the board, us, which may be before that of the last message.
    pub(crate) fn of_time(&self, client: &Client, board_us: u64) -> Stamp {
        if let Some(time) = client.host_time(Micros(board_us)) {
            return Stamp { board_us, host_us: time.us, uncertainty_us: Some(time.uncertainty_us) };
        }
        let (board, host) = self.heard.unwrap_or((board_us, self.time.now_us()));
        let host_us = host.saturating_add(board_us).saturating_sub(board);
        Stamp { board_us, host_us, uncertainty_us: None }
    }

    /// The board's time of a stamp, us: the inverse of `Stamps::of_time`. None before the first message,
    /// and for stamps from before the board's start.
    pub fn board_time(&self, client: &Client, host_us: u64) -> Option<Micros> {
        let by_clock = client.board_time_at(host_us).filter(|time| time.0 > 0);
        by_clock.or_else(|| {
            let (board, host) = self.heard?;
            board.checked_add(host_us)?.checked_sub(host).map(Micros)
        })
    }

    fn at(&mut self, client: &Client, board_us: u64) -> Stamp {
        if let Some(time) = client.host_time(Micros(board_us)) {
            return Stamp { board_us, host_us: time.us, uncertainty_us: Some(time.uncertainty_us) };
        }
        let (board, host) = match self.heard {
            // A restarted board begins anew.
            Some((board, host)) if board_us >= board => (board, host),
            _ => *self.heard.insert((board_us, self.time.now_us())),
        };
        Stamp { board_us, host_us: host.saturating_add(board_us - board), uncertainty_us: None }
    }
}

/// Board time of an event, us; none if it has none.
pub fn time_of(client: &Client, event: &Event) -> Option<u64> {
    let time = match event {
        Event::Hello => client.description()?.clock,
        Event::Frame { time, .. }
        | Event::Contacts { time, .. }
        | Event::HealthMap { time, .. }
        | Event::Log { time, .. }
        | Event::Note { time, .. }
        | Event::Raw { time, .. } => *time,
        Event::Symbols(list) => list.time,
        Event::Intent(report) => report.time,
        Event::Reaction(report) => report.time,
        Event::Reflex(report) => report.time,
        Event::Health(health) => health.time,
        Event::Budget(budget) => budget.time,
        Event::Temperature(temperature) => temperature.time,
        Event::Gesture(report) => report.time,
        Event::Pressing(report) => report.time,
        Event::Folds(report) => report.time,
        Event::Regions(report) => report.time,
        Event::SelfTest(report) => report.time,
        Event::Sync(report) => report.sent,
        Event::StartOfFrame(start) => start.noticed,
        Event::Shapes { .. }
        | Event::Unusable(_)
        | Event::Answer { .. }
        | Event::Refused(_)
        | Event::Lost { .. }
        | Event::Back { .. }
        | Event::Other { .. } => return None,
    };
    Some(time.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::SyncReport;

    #[test]
    fn what_is_said_before_the_board_has_sent_its_time_is_not_from_its_start() {
        let (mut stamps, client) = (Stamps::start(), Client::new());
        let asked = stamps.now(&client);
        let answered = stamps.of(&client, &Event::Answer { request: 0, refusal: None });
        assert!(!stamps.is_known());
        // The board has been on for an hour.
        let hour = Micros(3_600_000_000);
        let reported = stamps.of(&client, &Event::Sync(SyncReport { token: 1, received: hour, sent: hour }));
        assert!(stamps.is_known());
        assert_eq!([asked, answered, reported].map(|stamp| stamp.board_us), [0, 0, hour.0]);
        assert!(reported.host_us - asked.host_us < 60_000_000, "{asked:?} {reported:?}");
    }
}
