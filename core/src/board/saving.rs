//! When settings may be stored: the flash wears out, and nothing is scanned meanwhile; nor while lines are examined.

use super::quota::Quota;
use super::refusal::Refusal;
use super::{Board, Job, Saved, Work, request};
use crate::boot::Aside;
use crate::format::Micros;
use crate::wire::Level;

/// Twelve saves may follow each other, and each is granted again after five minutes: twelve an hour. At some
/// ten sectors for the greatest garment a flash of 100,000 erasures lasts a year of them, day and night.
type Allowance = Quota<12, 300_000_000>;
/// From the announcement to the save: the link has carried away what it was given.
const NOTICE_US: u64 = 50_000;

/// How many saves are left, and whether one was announced.
#[derive(Debug, Clone, Copy)]
pub(super) struct Saving {
    allowance: Allowance,
    announced: Option<Micros>,
    /// Since when nothing is scanned.
    stopped: Option<Micros>,
    /// When the board starts again.
    restart: Option<Micros>,
}

/// What the board does next about a save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    Announce,
    Wait,
    Save,
}

impl Saving {
    pub const fn new() -> Saving {
        Saving { allowance: Allowance::new(), announced: None, stopped: None, restart: None }
    }

    /// Before a reset so many saves were left.
    pub fn resume(&mut self, left: u8) {
        self.allowance.resume(left);
    }

    /// Saves that are left after one.
    pub fn left_after(&self) -> u8 {
        self.allowance.known().saturating_sub(1)
    }

    /// Whether the flash may be written now; else after how many minutes.
    pub fn allowed(&mut self, now: Micros) -> Result<(), u64> {
        match self.allowance.wait_us(now) {
            0 => Ok(()),
            us => Err(us.div_ceil(60_000_000)),
        }
    }

    /// A save was asked for.
    pub fn next(&mut self, now: Micros) -> Next {
        match self.announced {
            None => {
                self.announced = Some(now);
                Next::Announce
            }
            Some(at) if now.since(at) < NOTICE_US => Next::Wait,
            Some(_) => {
                self.announced = None;
                self.stop(now);
                Next::Save
            }
        }
    }

    /// The flash was written.
    pub fn spend(&mut self, now: Micros) {
        self.allowance.spend(now);
    }

    /// Something else than a scan begins.
    pub fn stop(&mut self, now: Micros) {
        self.stopped = Some(now);
    }

    /// It has ended; for how long nothing was scanned. None: nothing had begun.
    pub fn ended(&mut self, now: Micros) -> Option<u64> {
        self.stopped.take().map(|stopped| now.since(stopped))
    }

    /// Whether it is time to start again.
    fn restarts(&self, now: Micros) -> bool {
        self.restart.is_some_and(|at| at <= now)
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// The next work beyond scanning, if it is time for it: one between two scans.
    pub(super) fn next_work(&mut self, now: Micros) -> Option<Job> {
        if self.saving.restarts(now) {
            return Some(Job::Restart);
        }
        if self.worked {
            return None;
        }
        if self.works.front() == Some(&Work::Save) {
            match self.saving.next(now) {
                Next::Announce => {
                    let text = format_args!("scanning stops while the settings are stored");
                    self.outbox.tell(Level::Info, text);
                    return None;
                }
                Next::Wait => return None,
                Next::Save => {}
            }
        }
        let work = self.works.pop_front()?;
        self.worked = true;
        Some(match work {
            Work::Save => Job::Save,
            Work::Reset { undo } => {
                self.saving.stop(now);
                Job::ResetSettings { undo }
            }
            Work::SelfTest => {
                self.saving.stop(now);
                Job::Examine
            }
        })
    }

    /// The settings are to be stored, if the flash can take it.
    pub(super) fn save(&mut self, now: Micros) -> Result<(), Refusal> {
        if self.taring {
            return Err(Refusal::of("a tare is under way"));
        }
        self.saving.allowed(now).map_err(|minutes| {
            Refusal::from(format_args!(
                "the flash has been written often enough: it can be written again in {minutes} min"
            ))
        })
    }

    /// A save has ended.
    pub(super) fn saved(&mut self, now: Micros, result: Result<Saved, &'static str>) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
        // After a failure, too, something may have been written.
        if result != Ok(Saved::Unchanged) {
            self.saving.spend(now);
        }
        if result.is_ok()
            && let Some(boot) = &mut self.boot
        {
            // What is stored now is in force.
            boot.aside = Aside::No;
        }
        self.outbox.answer(request::number_of(Work::Save), result.err().map(Refusal::of));
    }

    /// The stored settings were put aside, or taken up again; what that means shows when the board starts,
    /// which it does as soon as the answer has gone.
    #[inline(never)]
    pub(super) fn settings_reset(&mut self, now: Micros, result: Result<Saved, &'static str>) {
        let us = self.saving.ended(now).unwrap_or(0);
        self.not_scanned(us);
        if result.is_ok() {
            self.saving.restart = Some(Micros(now.0.saturating_add(NOTICE_US)));
        }
        let number = request::number_of(Work::Reset { undo: false });
        self.outbox.answer(number, result.err().map(Refusal::of));
    }

    /// Before a reset so many saves were left: it grants no more.
    pub fn resume_saving(&mut self, left: u8) {
        self.saving.resume(left);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_saves_then_one_in_five_minutes() {
        let mut saving = Saving::new();
        let minute = |m: u64| Micros(m * 60_000_000);
        for _ in 0..12 {
            assert_eq!(saving.allowed(minute(1)), Ok(()));
            saving.spend(minute(1));
        }
        assert_eq!(saving.allowed(minute(1)), Err(5));
        assert_eq!(saving.allowed(minute(4)), Err(2));
        assert_eq!(saving.allowed(minute(6)), Ok(()));
        saving.spend(minute(6));
        assert_eq!(saving.allowed(minute(6)), Err(5));
        assert_eq!(saving.allowed(minute(600)), Ok(()));
        assert_eq!(saving.left_after(), 11);
    }

    #[test]
    fn a_save_is_announced_first() {
        let mut saving = Saving::new();
        let steps = [0, 10, 49_999, 50_000].map(|us| saving.next(Micros(us)));
        assert_eq!(steps, [Next::Announce, Next::Wait, Next::Wait, Next::Save]);
        assert_eq!((saving.ended(Micros(90_000)), saving.ended(Micros(95_000))), (Some(40_000), None));
    }
}
