//! Host time of a board's events, from round trips of `Sync`: guaranteed bounds instead of an estimate.
//!
//! The host sent a request at `asked`, the board read it at `received` and handed the answer to the link at
//! `sent`, and the answer arrived at `answered`. The board's `received` is not before `asked`, and its `sent`
//! not after `answered`, however long and unequal the two ways were. So each round trip bounds the offset of
//! the two clocks from both sides. Bounds of earlier trips are widened by the possible drift since, and
//! intersected with the new ones. A trip that waited in a queue has wider bounds, and does no harm. The rate
//! is bounded likewise, from bounds of the offset that are minutes apart.
//!
//! Assumptions: the rates differ by `RATE_LIMIT` at most, and that difference changes by `WANDER` at
//! most. An empty intersection means that an assumption failed or a clock was set; then only the last trip is
//! kept.

use crate::time::{Instant, calendar};
use std::collections::VecDeque;
use taxel_core::format::Micros;

/// Largest difference of the rates of the two clocks: 500 ppm. Crystals differ by 100 ppm; a host that
/// follows a time server slews its clock by 500 ppm at most.
pub(crate) const RATE_LIMIT: f64 = 500e-6;
/// Fastest change of that difference, per second: 0.1 ppm/s, that of a cheap crystal that warms by 6 degrees
/// in a minute.
pub(crate) const WANDER: f64 = 0.1e-6;
/// Time between two bounds kept for the rate, us.
const SPACING: f64 = 4e6;
/// Number of bounds kept: two minutes of them. With older ones, wander costs more than the longer time gains.
const KEPT: usize = 32;

/// Host time of an event on a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HostTime {
    /// Microseconds since the epoch of the host's times.
    pub us: u64,
    /// Largest error, microseconds.
    pub uncertainty_us: u64,
}

/// A `Sync` and its answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RoundTrip {
    /// The host's time before the request was sent, us.
    pub asked: u64,
    /// The board's time when it was read.
    pub received: Micros,
    /// The board's time when the answer was handed to the link.
    pub sent: Micros,
    /// The host's time after the answer had come, us.
    pub answered: u64,
}

/// Model of a board's clock.
#[derive(Debug, Default, Clone)]
pub struct HostClock {
    known: Option<ClockEstimate>,
}

/// Inclusive bounds.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    low: f64,
    high: f64,
}

impl Bounds {
    fn cut(self, other: Bounds) -> Option<Bounds> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Bounds { low, high })
    }

    fn widened(self, by: f64) -> Bounds {
        Bounds { low: self.low - by, high: self.high + by }
    }
}

#[derive(Debug, Clone)]
struct ClockEstimate {
    /// Host time minus board time in the first trip, us; the origin of offsets.
    origin: i128,
    /// Board time of the bounds.
    at: Micros,
    offset: Bounds,
    /// Change of the offset, us per us of board time.
    rate: Bounds,
    earlier: VecDeque<(Micros, Bounds)>,
}

impl HostClock {
    /// Adds a round trip; ignores one that ends before it began.
    pub fn take(&mut self, trip: &RoundTrip) {
        self.take_within(trip, 0.0, ClockEstimate::carried_on);
    }

    /// Adds a round trip of one of several boards, which come in any order, and whose times may be off by
    /// this much, us.
    pub(super) fn take_any(&mut self, trip: &RoundTrip, off_us: f64) {
        self.take_within(trip, off_us, |known, sent, new| match span(known.at, sent) < 0.0 {
            true => known.looked_back(sent, new),
            false => known.carried_on(sent, new),
        });
    }

    fn take_within(
        &mut self,
        trip: &RoundTrip,
        off_us: f64,
        carry: impl FnOnce(ClockEstimate, Micros, Bounds) -> Option<ClockEstimate>,
    ) {
        let RoundTrip { asked, received, sent, answered } = *trip;
        let origin =
            self.known.as_ref().map_or(i128::from(answered) - i128::from(sent.0), |known| known.origin);
        let offset = |host: u64, board: Micros| (i128::from(host) - i128::from(board.0) - origin) as f64;
        // Drift during the short time on the board, and up to one microsecond of truncation by either clock.
        let slack = off_us + 1.0 + span(received, sent).abs() * RATE_LIMIT;
        let new =
            Bounds { low: offset(asked, received) - slack, high: offset(answered, sent) + 1.0 + off_us };
        if received > sent || new.low > new.high {
            return;
        }
        let carried = self.known.take().and_then(|known| carry(known, sent, new));
        self.known = Some(carried.unwrap_or_else(|| ClockEstimate {
            origin,
            at: sent,
            offset: new,
            rate: Bounds { low: -RATE_LIMIT, high: RATE_LIMIT },
            earlier: VecDeque::from([(sent, new)]),
        }));
    }

    /// Discards the model: the board, and so its clock, has restarted.
    pub fn forget(&mut self) {
        self.known = None;
    }

    /// Converts a board time to host time; none before the first round trip.
    pub fn host_time(&self, board: Micros) -> Option<HostTime> {
        let known = self.known.as_ref()?;
        let Bounds { low, high } = known.offset_at(board);
        let middle =
            known.origin.saturating_add(board.0.into()).saturating_add(((low + high) / 2.0).round() as i128);
        Some(HostTime {
            us: clamped(middle),
            uncertainty_us: (((high - low) / 2.0).ceil() as u64).saturating_add(1),
        })
    }

    /// Converts a host time, us, to board time: the inverse of [`HostClock::host_time`], within 1 us. None
    /// before the first round trip; 0 for times before the board's start.
    pub fn board_time(&self, host_us: u64) -> Option<Micros> {
        let known = self.known.as_ref()?;
        let since = i128::from(host_us) - known.origin;
        let mut board = since;
        // The offset depends on the result, by 500 ppm at most: each round leaves that much of the error.
        for _ in 0..3 {
            let Bounds { low, high } = known.offset_at(Micros(clamped(board)));
            board = since.saturating_sub(((low + high) / 2.0).round() as i128);
        }
        Some(Micros(clamped(board)))
    }
}

/// The nearest time that there is.
fn clamped(us: i128) -> u64 {
    u64::try_from(us.max(0)).unwrap_or(u64::MAX)
}

impl ClockEstimate {
    /// Bounds of the offset at a board time, before or after the last trip.
    fn offset_at(&self, board: Micros) -> Bounds {
        let passed = span(self.at, board);
        let drifts = [self.rate.low * passed, self.rate.high * passed];
        let wander = WANDER * 1e-6 * passed * passed / 2.0;
        Bounds {
            low: self.offset.low + drifts[0].min(drifts[1]) - wander,
            high: self.offset.high + drifts[0].max(drifts[1]) + wander,
        }
    }

    /// Adds the bounds of a trip from before the last one; none if the intersection of all bounds is empty.
    fn looked_back(mut self, sent: Micros, then: Bounds) -> Option<ClockEstimate> {
        let passed = span(sent, self.at);
        let wander = WANDER * 1e-6 * passed * passed / 2.0;
        let Bounds { low, high } = then.widened(wander);
        let now = Bounds { low: low + self.rate.low * passed, high: high + self.rate.high * passed };
        self.offset = self.offset.cut(now)?;
        Some(self)
    }

    /// Adds the bounds of a new trip; none if the intersection of all bounds is empty.
    fn carried_on(mut self, sent: Micros, new: Bounds) -> Option<ClockEstimate> {
        let passed = span(self.at, sent);
        if passed < 0.0 {
            return None;
        }
        self.offset = self.offset_at(sent).cut(new)?;
        self.rate = self.rate.widened(WANDER * 1e-6 * passed);
        self.at = sent;
        for (then, before) in &self.earlier {
            let time = span(*then, sent);
            if time < SPACING / 8.0 {
                continue;
            }
            let mean = Bounds {
                low: (self.offset.low - before.high) / time,
                high: (self.offset.high - before.low) / time,
            };
            // The mean applies to the middle of the interval; the rate has wandered since.
            self.rate = self.rate.cut(mean.widened(WANDER * 1e-6 * time / 2.0))?;
        }
        let limit = Bounds { low: -RATE_LIMIT, high: RATE_LIMIT };
        self.rate = self.rate.cut(limit)?;
        if self.earlier.back().is_none_or(|(last, _)| span(*last, sent) >= SPACING) {
            self.earlier.push_back((sent, self.offset));
            if self.earlier.len() > KEPT {
                self.earlier.pop_front();
            }
        }
        Some(self)
    }
}

/// Signed time from `from` to `to`, us.
pub(super) fn span(from: Micros, to: Micros) -> f64 {
    (i128::from(to.0) - i128::from(from.0)) as f64
}

/// Steady host time: microseconds since 1970 at creation, then monotonic even if the calendar is set.
#[derive(Debug, Clone, Copy)]
pub struct SteadyTime {
    began: Instant,
    began_us: u64,
}

impl SteadyTime {
    /// Starts now.
    pub fn start() -> SteadyTime {
        SteadyTime { began: Instant::now(), began_us: calendar().as_micros() as u64 }
    }

    /// Current time, us.
    pub fn now_us(&self) -> u64 {
        self.began_us + self.began.elapsed().as_micros() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trip(asked: u64, received: u64, sent: u64, answered: u64) -> RoundTrip {
        RoundTrip { asked, received: Micros(received), sent: Micros(sent), answered }
    }

    #[test]
    fn a_trip_bounds_the_offset_by_half_its_time_on_the_way() {
        let mut clock = HostClock::default();
        assert_eq!(clock.host_time(Micros(5)), None);
        clock.take(&trip(1_000_000, 500, 700, 1_001_200));
        // At board time 700 the host's time is between 1,000,200 (if the trip took no time there) and
        // 1,001,200.
        let time = clock.host_time(Micros(700)).unwrap();
        assert_eq!((time.us, time.uncertainty_us), (1_000_700, 503));
        // A trip that waited a second in a queue adds nothing, and costs only the drift.
        clock.take(&trip(2_000_000, 1_000_000, 1_000_100, 3_001_500));
        let later = clock.host_time(Micros(1_000_100)).unwrap();
        assert!((500..=1_010).contains(&later.uncertainty_us), "{later:?}");
    }

    #[test]
    fn a_clock_that_was_set_is_learnt_anew() {
        let mut clock = HostClock::default();
        for second in 0..20 {
            let now = second * 1_000_000;
            clock.take(&trip(now + 7_000_000, now + 100, now + 150, now + 7_000_300));
        }
        // Back to zero, and ten seconds ahead.
        for board in [40, 10_000_000] {
            clock.take(&trip(30_000_000, board, board + 10, 30_000_200));
            let time = clock.host_time(Micros(board)).unwrap();
            assert!(
                time.us.abs_diff(30_000_095) <= time.uncertainty_us && time.uncertainty_us < 110,
                "{time:?}"
            );
        }
        clock.forget();
        assert_eq!(clock.host_time(Micros(0)), None);
    }

    #[test]
    fn times_of_the_host_are_times_of_the_board() {
        let mut clock = HostClock::default();
        assert_eq!(clock.board_time(5), None);
        // The board's clock is fast by 400 ppm, for ten minutes.
        for second in 0..600 {
            let (host, board) = (5_000_000_000 + second * 1_000_000, 70 + second * 1_000_400);
            clock.take(&trip(host, board + 40, board + 60, host + 100));
        }
        for board in [0, 70, 300_000_000, 600_000_000, 610_000_000] {
            let host = clock.host_time(Micros(board)).unwrap().us;
            assert!(clock.board_time(host).unwrap().0.abs_diff(board) <= 1, "{board}");
        }
        assert_eq!(clock.board_time(0), Some(Micros(0)));
    }

    #[test]
    fn nonsense_does_no_harm() {
        let mut clock = HostClock::default();
        clock.take(&trip(10, 50, 40, 20));
        clock.take(&trip(20, 10, 10, 10));
        assert_eq!(clock.host_time(Micros(0)), None);
        for times in [[0, u64::MAX, u64::MAX, u64::MAX], [u64::MAX, 0, u64::MAX, u64::MAX], [0, 0, 0, 0]] {
            clock.take(&trip(times[0], times[1], times[2], times[3]));
            let _ = clock.host_time(Micros(u64::MAX)).is_some_and(|time| time.us > 0);
            let _ = clock.host_time(Micros(0));
            let _ = clock.board_time(0).max(clock.board_time(u64::MAX));
        }
    }
}
