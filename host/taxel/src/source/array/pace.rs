//! Times of a board whose frames come from elsewhere.

use super::frame::ArrayFrame;
use crate::time::Instant;
use std::time::Duration;
use taxel_core::format::Micros;

/// Silence after which a sensor's clock is followed anew.
const SILENCE_US: u64 = 1_000_000;

/// Clock of a perceived array, which never goes back.
#[derive(Debug)]
pub struct Pace {
    origin: Instant,
    /// Time of the last arrival in a recording, us.
    recorded_us: Option<u64>,
    /// Time of a frame, us, if only their number says it: the frames of a file.
    period_us: Option<f64>,
    count: u64,
    /// Board time less the sensor's own time, us.
    offset_us: Option<i64>,
    /// Time of the last frame or of what was attended to last.
    last: Micros,
    /// Arrival of the last frame, us.
    heard_us: u64,
}

impl Pace {
    /// A clock that starts now. With a rate, frames per second, time is the number of frames.
    pub fn start(rate: Option<f64>) -> Pace {
        let period_us = rate.map(|rate| 1e6 / rate);
        Pace {
            origin: Instant::now(),
            recorded_us: None,
            period_us,
            count: 0,
            offset_us: None,
            last: Micros(0),
            heard_us: 0,
        }
    }

    /// Time since the start, us: in a recording, that of what was heard last.
    pub fn now_us(&self) -> u64 {
        self.recorded_us.unwrap_or_else(|| self.origin.elapsed().as_micros() as u64)
    }

    /// Notes when bytes of a recording came.
    pub fn hear(&mut self, arrival_us: u64) {
        self.recorded_us = Some(arrival_us);
    }

    /// Time of a frame: by the sensor's clock if it has one, else that of its arrival.
    pub fn of(&mut self, frame: &ArrayFrame) -> Micros {
        let time = match (frame.time_us, self.period_us) {
            (Some(time), _) => {
                let time = i64::try_from(time).unwrap_or(i64::MAX);
                let offset = *self.offset_us.get_or_insert((frame.arrival_us as i64).saturating_sub(time));
                u64::try_from(time.saturating_add(offset)).unwrap_or(0)
            }
            (None, Some(period)) => (self.count as f64 * period) as u64,
            (None, None) => frame.arrival_us,
        };
        if time < self.last.0 {
            // Its clock was set back; it is followed from here on.
            self.offset_us = None;
        }
        self.count += 1;
        self.heard_us = self.now_us();
        self.last = Micros(time.max(self.last.0));
        self.last
    }

    /// Time of what is done between two frames: no frame may be older than it.
    pub fn between(&mut self) -> Micros {
        let now = self.now_us();
        if self.period_us.is_some() || self.offset_us.is_some() && now < self.heard_us + SILENCE_US {
            return self.last;
        }
        self.last = self.last.max(Micros(now));
        self.last
    }

    /// Time until a frame of this time is due.
    pub fn until(&self, time: Micros) -> Duration {
        Duration::from_micros(time.0).saturating_sub(self.origin.elapsed())
    }
}
