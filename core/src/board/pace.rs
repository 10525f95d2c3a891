//! Rates: when something is due.

use crate::format::Micros;
use crate::scene::StreamConfig;

/// A rate, and the time of its next event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pace {
    /// Time between events; none: never due.
    period_us: Option<u64>,
    next: Micros,
}

impl Pace {
    /// Never due.
    pub const NEVER: Pace = Pace { period_us: None, next: Micros(0) };

    /// A rate of `hz` per second; 0: never, `u16::MAX`: always.
    pub fn new(hz: u16) -> Pace {
        let period_us = match hz {
            0 => None,
            u16::MAX => Some(0),
            hz => Some(u64::from(1_000_000 / u32::from(hz))),
        };
        Pace { period_us, next: Micros(0) }
    }

    /// True if due at `now`. The next time is then a period later, or a period after `now` if that has
    /// passed.
    pub fn due(&mut self, now: Micros) -> bool {
        let Some(period) = self.period_us else { return false };
        if now < self.next {
            return false;
        }
        let next = Micros(self.next.0.saturating_add(period));
        self.next = if next < now { Micros(now.0.saturating_add(period)) } else { next };
        true
    }

    /// True if it is never due.
    pub fn is_never(&self) -> bool {
        self.period_us.is_none()
    }

    /// Time of the next event.
    pub fn next(&self) -> Micros {
        self.next
    }
}

/// Rates and switches of the stream.
pub(super) struct Rates {
    pub contacts: Pace,
    pub frames: Pace,
    /// Longest time between two key frames.
    pub key_us: u64,
    pub symbols: bool,
    pub intent: bool,
    /// True if ages of forms are sent.
    pub form_ages: bool,
}

impl Rates {
    /// The rates of a scene.
    pub fn of(stream: &StreamConfig) -> Rates {
        Rates {
            contacts: Pace::new(stream.contacts_hz),
            frames: Pace::new(stream.frames_hz),
            key_us: 1000 * u64::from(stream.key_ms),
            symbols: stream.symbols,
            intent: stream.intent,
            form_ages: stream.form_ages,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates() {
        let times = |hz: u16, step: u64| {
            let mut pace = Pace::new(hz);
            (0..1_000_000 / step).filter(|i| pace.due(Micros(i * step))).count()
        };
        assert_eq!(times(0, 5128), 0);
        assert_eq!(times(u16::MAX, 5128), 195);
        assert_eq!(times(20, 5128), 20);
        assert_eq!(times(60, 1000), 60);
    }
}
