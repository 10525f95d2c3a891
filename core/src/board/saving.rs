//! When settings may be stored: the flash wears out, and nothing is scanned meanwhile; nor while lines are examined.

use super::refusal::Refusal;
use super::{Board, Job, Saved, Work, request};
use crate::format::Micros;
use crate::wire::Level;

/// Saves that may follow each other.
const MOST: u8 = 12;
/// Each is granted again after this time: twelve an hour. At some ten sectors for the greatest garment a flash of 100,000 erasures
/// lasts a year of them, day and night.
const REFILL_US: u64 = 300_000_000;
/// From the announcement to the save: the link has carried away what it was given.
const NOTICE_US: u64 = 50_000;

/// How many saves are left, and whether one was announced.
#[derive(Debug, Clone, Copy)]
pub(super) struct Saving {
    left: u8,
    /// Since when fewer than all are left.
    since: Micros,
    announced: Option<Micros>,
    /// Since when nothing is scanned.
    stopped: Option<Micros>,
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
        Saving { left: MOST, since: Micros(0), announced: None, stopped: None }
    }

    /// Whether the flash may be written now; else after how many minutes.
    pub fn allowed(&mut self, now: Micros) -> Result<(), u64> {
        while self.left < MOST && now.since(self.since) >= REFILL_US {
            self.left += 1;
            self.since = Micros(self.since.0.saturating_add(REFILL_US));
        }
        if self.left > 0 {
            return Ok(());
        }
        Err(REFILL_US.saturating_sub(now.since(self.since)).div_ceil(60_000_000))
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
        if self.left == MOST {
            self.since = now;
        }
        self.left = self.left.saturating_sub(1);
    }

    /// Something else than a scan begins.
    pub fn stop(&mut self, now: Micros) {
        self.stopped = Some(now);
    }

    /// It has ended; for how long nothing was scanned. None: nothing had begun.
    pub fn ended(&mut self, now: Micros) -> Option<u64> {
        self.stopped.take().map(|stopped| now.since(stopped))
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// The next work beyond scanning, if it is time for it.
    pub(super) fn next_work(&mut self, now: Micros) -> Option<Job> {
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
        Some(match self.works.pop_front()? {
            Work::Save => Job::Save,
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
        self.outbox.answer(request::number_of(Work::Save), result.err().map(Refusal::of));
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
        assert_eq!(saving.left, 12);
    }

    #[test]
    fn a_save_is_announced_first() {
        let mut saving = Saving::new();
        let steps = [0, 10, 49_999, 50_000].map(|us| saving.next(Micros(us)));
        assert_eq!(steps, [Next::Announce, Next::Wait, Next::Wait, Next::Save]);
        assert_eq!((saving.ended(Micros(90_000)), saving.ended(Micros(95_000))), (Some(40_000), None));
    }
}
