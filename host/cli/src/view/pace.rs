//! Paces saved bytes to the time in which they were recorded.

use std::time::{Duration, Instant};
use taxel_core::format::Micros;

/// Gap beyond which there is no waiting.
const GAP: Duration = Duration::from_secs(2);

/// Host time and board time of the same moment.
#[derive(Debug, Default)]
pub struct Pace(Option<(Instant, Micros)>);

impl Pace {
    /// Time to wait before a frame of this time; zero if its time went back or leapt.
    pub fn wait(&mut self, time: Micros, now: Instant) -> Duration {
        let (began, first) = *self.0.get_or_insert((now, time));
        let wait = began.checked_add(Duration::from_micros(time.since(first))).and_then(|due| {
            let wait = due.saturating_duration_since(now);
            (time >= first && wait <= GAP && now.saturating_duration_since(due) <= GAP).then_some(wait)
        });
        if wait.is_none() {
            self.0 = Some((now, time));
        }
        wait.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_wait_for_their_time_and_leaps_are_not_waited_for() {
        let (mut pace, start) = (Pace::default(), Instant::now());
        assert_eq!(pace.wait(Micros(7_000_000), start), Duration::ZERO);
        assert_eq!(pace.wait(Micros(7_005_000), start), Duration::from_millis(5));
        assert_eq!(pace.wait(Micros(7_010_000), start + Duration::from_millis(12)), Duration::ZERO);
        assert_eq!(pace.wait(Micros(99_000_000), start), Duration::ZERO);
        assert_eq!(pace.wait(Micros(99_001_000), start), Duration::from_millis(1));
        assert_eq!(pace.wait(Micros(3), start), Duration::ZERO);
    }
}
