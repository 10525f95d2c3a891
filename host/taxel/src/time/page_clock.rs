//! Clock of a page, as it was set last.

use std::ops::{Add, AddAssign, Sub};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::Duration;

/// Times of the page, us: steady, and since 1970.
static STEADY_US: AtomicU64 = AtomicU64::new(0);
static CALENDAR_US: AtomicU64 = AtomicU64::new(0);

/// Sets the clock, us: a time that never goes back, and the time since the beginning of 1970.
pub fn set_page_clock(steady_us: u64, calendar_us: u64) {
    STEADY_US.fetch_max(steady_us, Relaxed);
    CALENDAR_US.store(calendar_us, Relaxed);
}

/// Time since the beginning of 1970.
pub fn calendar() -> Duration {
    Duration::from_micros(CALENDAR_US.load(Relaxed))
}

/// Returns at once: a page is never kept waiting.
pub fn sleep(_: Duration) {}

/// Steady time, with those methods of `std::time::Instant` that are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant(Duration);

impl Instant {
    /// The time that was set last.
    pub fn now() -> Instant {
        Instant(Duration::from_micros(STEADY_US.load(Relaxed)))
    }

    /// Time since.
    pub fn elapsed(&self) -> Duration {
        Instant::now() - *self
    }

    /// This time later; none if that is no time.
    pub fn checked_add(&self, time: Duration) -> Option<Instant> {
        self.0.checked_add(time).map(Instant)
    }

    /// This time earlier; none if that is no time.
    pub fn checked_sub(&self, time: Duration) -> Option<Instant> {
        self.0.checked_sub(time).map(Instant)
    }

    /// Time since an earlier one; 0 if that is later.
    pub fn saturating_duration_since(&self, earlier: Instant) -> Duration {
        self.0.saturating_sub(earlier.0)
    }
}

impl Add<Duration> for Instant {
    type Output = Instant;

    fn add(self, time: Duration) -> Instant {
        Instant(self.0.saturating_add(time))
    }
}

impl AddAssign<Duration> for Instant {
    fn add_assign(&mut self, time: Duration) {
        *self = *self + time;
    }
}

impl Sub for Instant {
    type Output = Duration;

    fn sub(self, earlier: Instant) -> Duration {
        self.saturating_duration_since(earlier)
    }
}
