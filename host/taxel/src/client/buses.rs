//! One time of all boards on one USB host controller, from the starts of its frames.
//!
//! The controller starts a frame each millisecond, and all devices on its ports see the start at the same
//! moment, with the same number. So the frames are a clock that the boards share: each board's time is
//! converted to the time of the bus by the starts that it has noticed, and the round trips of all boards
//! bound the offset of the bus to the host together. Boards that disagree by milliseconds of their links then
//! agree by microseconds.
//!
//! Which boards share a controller is measured: numbers repeat after 2.048 s, and the start that a board has
//! noticed must be where the round trips allow the one of that number to be. Of 1,000 boards on another
//! controller one is there by chance. Nothing that is stated depends on it: the host's time of a board stays
//! within the bounds of its own round trips.

use super::clock::{HostClock, RoundTrip, span};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard};
use taxel_core::format::Micros;
use taxel_core::wire::StartOfFrame;

/// Time between two starts, us.
const FRAME_US: i64 = 1_000;
/// Numbers of frames, after which they repeat.
const NUMBERS: i64 = 2_048;
/// Most controllers: a board whose clock jumps seems to be on another one each time.
const MOST: usize = 64;
/// Starts kept of a board: those of 16 s.
const KEPT: usize = 16;
/// Least time between two starts that show a board's rate, us: notices are off by 20 us.
const RATE_US: f64 = 2e6;
/// Most by which a rate may differ from the bus's while it is not known: two crystals.
const RATE_LIMIT: f64 = 600e-6;
/// Most by which it may have changed since it was measured: crystals that warm.
const WANDERS: f64 = 10e-6;
/// Longest time after the last start for which the board is taken to be on the bus, us.
const LONGEST: f64 = 5e6;

/// The controllers that boards of a robot are on. Clones are the same.
#[derive(Debug, Default, Clone)]
pub struct Buses(Arc<Mutex<Vec<HostClock>>>);

/// A board's place among them.
#[derive(Debug, Clone)]
pub(super) struct BusSeat {
    buses: Buses,
    seat: Option<Seat>,
}

/// On one of the controllers.
#[derive(Debug, Clone)]
struct Seat {
    /// Number of the controller.
    bus: usize,
    /// Starts that were noticed: number since the controller was met, and the board's time.
    starts: VecDeque<(i64, Micros)>,
    /// Most by which the last one may have been before, us.
    late_us: u16,
}

/// A time of the host, us, and by how much it may be off.
type Within = (u64, u64);

impl Buses {
    fn clocks(&self) -> MutexGuard<'_, Vec<HostClock>> {
        self.0.lock().unwrap_or_else(|broken| broken.into_inner())
    }

    /// The controller on which a frame of this number started then, and the number since 1970: the nearest
    /// that the bounds of both times allow, or else a new one; none if there are too many.
    fn find(&self, number: u16, host: Within) -> Option<(usize, i64)> {
        let (host_us, uncertainty_us) = host;
        let mut clocks = self.clocks();
        let near = clocks.iter().enumerate().filter_map(|(bus, clock)| {
            let at = clock.board_time(host_us)?;
            let bound = clock.host_time(at)?.uncertainty_us.saturating_add(uncertainty_us);
            let frame = nearest(at.0, number);
            let off = (at.0 as i64).abs_diff(frame.saturating_mul(FRAME_US));
            (off <= bound).then_some((off, bus, frame))
        });
        if let Some((_, bus, frame)) = near.min() {
            return Some((bus, frame));
        }
        if clocks.len() >= MOST {
            return None;
        }
        let frame = nearest(host_us, number);
        let (received, sent) = (time_of(frame), time_of(frame));
        let [asked, answered] =
            [host_us.saturating_sub(uncertainty_us), host_us.saturating_add(uncertainty_us)];
        let mut clock = HostClock::default();
        clock.take(&RoundTrip { asked, received, sent, answered });
        clocks.push(clock);
        Some((clocks.len() - 1, frame))
    }
}

/// The frame of this number nearest to a time of the bus, us, counted as if they had begun in 1970.
fn nearest(us: u64, number: u16) -> i64 {
    let at = us as i64 / FRAME_US;
    let off = (i64::from(number) - at + NUMBERS / 2).rem_euclid(NUMBERS) - NUMBERS / 2;
    at + off
}

/// Returns when a frame started, by the bus.
fn time_of(frame: i64) -> Micros {
    Micros(frame.saturating_mul(FRAME_US).max(0) as u64)
}

impl BusSeat {
    /// On no controller yet.
    pub fn new(buses: Buses) -> BusSeat {
        BusSeat { buses, seat: None }
    }

    /// Number of the controller; none before it is known.
    pub fn bus(&self) -> Option<usize> {
        self.seat.as_ref().map(|seat| seat.bus)
    }

    /// The board has restarted.
    pub fn leave(&mut self) {
        self.seat = None;
    }

    /// Takes a start that the board has noticed. `own`: the board's clock by its own round trips.
    pub fn take(&mut self, start: &StartOfFrame, own: &HostClock) {
        let Some(host) = own.host_time(start.noticed) else { return };
        let uncertainty_us = host.uncertainty_us.saturating_add(start.late_us.into());
        let Some((bus, frame)) = self.buses.find(start.number, (host.us, uncertainty_us)) else {
            self.seat = None;
            return;
        };
        let seat = self.seat.get_or_insert_with(|| Seat { bus, starts: VecDeque::new(), late_us: 0 });
        if seat.bus != bus || !seat.leads_to(frame, start.noticed) {
            *seat = Seat { bus, starts: VecDeque::new(), late_us: 0 };
        }
        seat.late_us = start.late_us;
        seat.starts.push_back((frame, start.noticed));
        if seat.starts.len() > KEPT {
            seat.starts.pop_front();
        }
    }

    /// Takes a round trip of the board for its controller.
    pub fn trip(&mut self, trip: &RoundTrip) {
        let Some((seat, at)) = self.seat.as_ref().and_then(|seat| Some((seat, seat.at(trip.sent)?))) else {
            return;
        };
        let Some(received) = seat.at(trip.received) else { return };
        if let Some(clock) = self.buses.clocks().get_mut(seat.bus) {
            clock.take_any(&RoundTrip { received: received.us, sent: at.us, ..*trip }, at.off_us);
        }
    }

    /// The host's time of a time of the board, us, by its controller; none if that is not known.
    pub fn host_us(&self, board: Micros) -> Option<u64> {
        let seat = self.seat.as_ref()?;
        let at = seat.at(board)?;
        Some(self.buses.clocks().get(seat.bus)?.host_time(at.us)?.us)
    }
}

/// A time of the bus, and by how much it may be off, us.
struct BusTime {
    us: Micros,
    off_us: f64,
}

impl Seat {
    /// The time of the bus at a time of the board; none long after the last start.
    fn at(&self, board: Micros) -> Option<BusTime> {
        let ((first, began), (last, ended)) = (self.starts.front()?, self.starts.back()?);
        let (passed, known) = (span(*ended, board), span(*began, *ended));
        if passed.abs() > LONGEST {
            return None;
        }
        let late = f64::from(self.late_us);
        let (rate, unsure) = match known >= RATE_US {
            true => ((last - first).saturating_mul(FRAME_US) as f64 / known, late / known + WANDERS),
            false => (1.0, RATE_LIMIT),
        };
        let us = Micros(time_of(*last).0.saturating_add_signed((passed * rate).round() as i64));
        Some(BusTime { us, off_us: late + passed.abs() * unsure })
    }

    /// True if this may be the start of that frame.
    fn leads_to(&self, frame: i64, noticed: Micros) -> bool {
        self.starts.back().is_none_or(|(last, then)| {
            let (frames, passed) = ((frame - last).saturating_mul(FRAME_US) as f64, span(*then, noticed));
            passed > 0.0 && (frames - passed).abs() <= f64::from(self.late_us) + 1.0 + RATE_LIMIT * passed
        })
    }
}
