//! Times of the scans, and the scans missed: those that fail, and those that other work leaves no time for.

use super::pace::Pace;
use crate::format::Micros;
use crate::scene::Scene;
use crate::wire::Health;

/// The scans.
pub(super) struct Scans {
    pace: Pace,
    /// True if the scene wants fewer scans than the board can make: it skips the others on purpose.
    is_limited: bool,
    is_scanning: bool,
    /// Number of scans that have failed since the last good one.
    failures: u16,
    /// True after an interruption whose lost frames are not counted yet.
    is_interrupted: bool,
}

impl Scans {
    /// Scans at the rate of no scene.
    pub const fn new() -> Scans {
        Scans { pace: Pace::NEVER, is_limited: false, is_scanning: false, failures: 0, is_interrupted: false }
    }

    /// Sets the rate of a scene, whose 0 means as many as possible.
    pub fn follow(&mut self, scene: &Scene) {
        self.is_limited = scene.rate_hz != 0;
        self.pace = Pace::new(if self.is_limited { scene.rate_hz } else { u16::MAX });
    }

    /// True if a scan is to begin, which then has begun.
    pub fn begin(&mut self, now: Micros) -> bool {
        let begins = !self.is_scanning && self.pace.due(now);
        self.is_scanning |= begins;
        begins
    }

    /// True while a scan is under way.
    pub fn is_scanning(&self) -> bool {
        self.is_scanning
    }

    /// Time of the next scan.
    pub fn next(&self) -> Micros {
        self.pace.next()
    }

    /// True if only what the converter cannot do limits the scans.
    pub fn is_limited(&self) -> bool {
        self.is_limited
    }

    /// A scan has ended, successfully or not.
    pub fn ended(&mut self) {
        self.is_scanning = false;
    }

    /// Counts a failed scan.
    pub fn failed(&mut self, health: &mut Health) {
        health.failed = health.failed.wrapping_add(1);
        self.failures = self.failures.saturating_add(1);
    }

    /// True if the last scan has failed.
    pub fn fail(&self) -> bool {
        self.failures > 0
    }

    /// Scanning was interrupted.
    pub fn interrupt(&mut self) {
        self.is_interrupted = true;
    }

    /// Counts a good scan. If it is the first one after failures or an interruption, counts the frames missed
    /// beside the failed ones, to the nearest scan, from the end of the last good one to the `start` of this.
    pub fn done(&mut self, start: Micros, last_end: Micros, health: &mut Health) {
        if self.failures > 0 || self.is_interrupted {
            let failed = u64::from(core::mem::take(&mut self.failures)) * u64::from(health.scan_us);
            self.is_interrupted = false;
            let half = u64::from(health.scan_us) / 2;
            self.count_missed((start.since(last_end) + half).saturating_sub(failed), health);
        }
        health.scans = health.scans.wrapping_add(1);
    }

    /// Counts as overruns the scans that fit into `us` without a scan.
    pub fn count_missed(&self, us: u64, health: &mut Health) {
        if !self.is_limited {
            let missed = us.checked_div(health.scan_us.into()).unwrap_or(0).min(u32::MAX.into()) as u32;
            health.overruns = health.overruns.wrapping_add(missed);
        }
    }
}
