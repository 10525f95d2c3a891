//! Saves of the settings: they are limited, because the flash is used up by them, and wait for touches to end.

use super::quota::Quota;
use crate::format::Micros;

/// Twelve saves in a row, each granted again after five minutes: twelve an hour. With some ten sectors for
/// the largest garment, a flash of 100,000 erasures lasts a year of them, day and night.
type Allowance = Quota<12, 300_000_000>;
/// Time between the announcement and the save, in which the link sends what is pending.
const NOTICE_US: u64 = 50_000;
/// Longest time that a save waits for a touch to end; one that is back within [`NOTICE_US`] has not ended.
const PATIENCE_US: u64 = 2_000_000;
/// State of the saves: the allowance, and the steps of the present one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Saving {
    allowance: Allowance,
    announced: Option<Micros>,
    /// Time since which a save waits for a touch to end.
    waits: Option<Micros>,
    /// Time since which nothing is scanned.
    stopped: Option<Micros>,
    /// Time at which the board restarts.
    restart: Option<Micros>,
}

/// Next step of a save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    Announce,
    Wait,
    Refuse,
    Save,
}

impl Saving {
    pub const fn new() -> Saving {
        Saving { allowance: Allowance::new(), announced: None, waits: None, stopped: None, restart: None }
    }

    /// Limits the allowance to the saves that were left before a reset.
    pub fn resume(&mut self, left: u8) {
        self.allowance.resume(left);
    }

    /// Number of saves left after the next one.
    pub fn left_after(&self) -> u8 {
        self.allowance.known().saturating_sub(1)
    }

    /// Error if the flash must not be written yet: minutes to wait.
    pub fn allowed(&mut self, now: Micros) -> Result<(), u64> {
        match self.allowance.wait_us(now) {
            0 => Ok(()),
            us => Err(us.div_ceil(60_000_000)),
        }
    }

    /// Next step of a requested save; `busy`: something touches the garment.
    pub fn next(&mut self, now: Micros, busy: bool) -> Next {
        if busy {
            // A pause in which the save could have been made ends a touch. A shorter one does not, so that a
            // save is answered under a touch that trembles, too.
            if self.announced.take().is_some_and(|at| now.since(at) >= NOTICE_US) {
                self.waits = None;
            }
            let since = *self.waits.get_or_insert(now);
            return if now.since(since) < PATIENCE_US { Next::Wait } else { Next::Refuse };
        }
        match self.announced {
            None => {
                self.announced = Some(now);
                Next::Announce
            }
            Some(at) if now.since(at) < NOTICE_US => Next::Wait,
            Some(_) => Next::Save,
        }
    }

    /// Ends a save, made or refused: the next one is announced again.
    pub fn taken(&mut self) {
        (self.announced, self.waits) = (None, None);
    }

    /// Records a write of the flash.
    pub fn charge(&mut self, now: Micros) {
        self.allowance.charge(now);
    }

    /// Records that scanning stops for other work.
    pub fn stop(&mut self, now: Micros) {
        self.stopped = Some(now);
    }

    /// Records the end of that work. Returns the time without scans, us; none if no work had begun.
    pub fn ended(&mut self, now: Micros) -> Option<u64> {
        self.stopped.take().map(|stopped| now.since(stopped))
    }

    /// Restarts the board once what is pending has been sent.
    pub fn restart_soon(&mut self, now: Micros) {
        self.restart = Some(Micros(now.0.saturating_add(NOTICE_US)));
    }

    /// True if the board is to restart now.
    pub fn restarts(&self, now: Micros) -> bool {
        self.restart.is_some_and(|at| at <= now)
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
            saving.charge(minute(1));
        }
        assert_eq!(saving.allowed(minute(1)), Err(5));
        assert_eq!(saving.allowed(minute(4)), Err(2));
        assert_eq!(saving.allowed(minute(6)), Ok(()));
        saving.charge(minute(6));
        assert_eq!(saving.allowed(minute(6)), Err(5));
        assert_eq!(saving.allowed(minute(600)), Ok(()));
        assert_eq!(saving.left_after(), 11);
    }

    #[test]
    fn a_save_is_announced_first() {
        let mut saving = Saving::new();
        let steps = [0, 10, 49_999, 50_000, 50_001].map(|us| saving.next(Micros(us), false));
        assert_eq!(steps, [Next::Announce, Next::Wait, Next::Wait, Next::Save, Next::Save]);
        saving.taken();
        saving.stop(Micros(50_000));
        assert_eq!((saving.ended(Micros(90_000)), saving.ended(Micros(95_000))), (Some(40_000), None));
        assert_eq!(saving.next(Micros(95_000), false), Next::Announce);
    }

    #[test]
    fn a_touch_delays_a_save_and_a_long_one_prevents_it() {
        let mut saving = Saving::new();
        let steps = [(0, false), (40_000, true), (60_000, false), (110_000, false)];
        let steps = steps.map(|(us, busy)| saving.next(Micros(us), busy));
        assert_eq!(steps, [Next::Announce, Next::Wait, Next::Announce, Next::Save]);
        saving.taken();
        let steps = [0, 1_999_999, 2_000_000].map(|us| saving.next(Micros(us), true));
        assert_eq!(steps, [Next::Wait, Next::Wait, Next::Refuse]);
    }

    /// Frames may be so long that a touch ends and another begins between the steps of a save.
    #[test]
    fn a_touch_that_has_ended_does_not_count_for_the_next_one() {
        let of = |steps: [(u64, bool); 5]| {
            let mut saving = Saving::new();
            steps.map(|(ms, busy)| saving.next(Micros(ms * 1000), busy))
        };
        let short = of([(0, true), (100, false), (2_100, true), (4_099, true), (4_100, true)]);
        assert_eq!(short, [Next::Wait, Next::Announce, Next::Wait, Next::Wait, Next::Refuse]);
        // A shorter pause than a save needs ends no touch, so that every save is answered.
        let trembling = of([(0, true), (1_000, false), (1_049, true), (1_990, false), (2_010, true)]);
        assert_eq!(trembling, [Next::Wait, Next::Announce, Next::Wait, Next::Announce, Next::Refuse]);
    }
}
