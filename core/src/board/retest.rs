//! Evidence against a line or an input while the board runs starts a self-test, so that a line that breaks in
//! use is reported like one broken at the start. The time of the test is counted as lost scans.

use crate::format::Micros;

/// Least pause after a test without news, doubled each time: a press on the whole garment may look like a
/// fault, and a known fault is evidence in every frame.
const PAUSE_US: u64 = 10_000_000;
/// Most doublings of the pause, to 10 min.
const DOUBLINGS: u8 = 6;

/// State of self-tests that nobody has requested.
#[derive(Debug)]
pub(super) struct Retest {
    raised: bool,
    /// The test in progress was started by evidence.
    followed: bool,
    /// Evidence before this time is ignored.
    until: Micros,
    doublings: u8,
}

impl Retest {
    /// No evidence.
    pub const fn new() -> Retest {
        Retest { raised: false, followed: false, until: Micros(0), doublings: 0 }
    }

    /// Records evidence against a line or an input.
    pub fn raise(&mut self, now: Micros) {
        self.raised |= now >= self.until;
    }

    /// True if a test is to be started now.
    pub fn follow(&mut self) -> bool {
        self.followed |= self.raised;
        core::mem::take(&mut self.raised)
    }

    /// Takes the end of a test. `is_new`: its findings differ from those before; `faulty`: there are faults.
    /// Returns true if the test was started by evidence.
    pub fn settle(&mut self, now: Micros, is_new: bool, faulty: bool) -> bool {
        self.raised = false;
        let followed = core::mem::take(&mut self.followed);
        if is_new {
            self.doublings = 0;
        }
        if followed || faulty {
            self.until = Micros(now.0.saturating_add(PAUSE_US << self.doublings.min(DOUBLINGS)));
            self.doublings = self.doublings.saturating_add(u8::from(!is_new)).min(DOUBLINGS);
        } else {
            self.until = now;
        }
        followed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_finds_nothing_is_tried_less_and_less_often() {
        let mut retest = Retest::new();
        let second = |s: u64| Micros(s * 1_000_000);
        let mut tried = heapless::Vec::<u64, 16>::new();
        for s in 0..2_000 {
            retest.raise(second(s));
            if retest.follow() {
                assert!(retest.settle(second(s), false, false));
                let _ = tried.push(s);
            }
        }
        assert_eq!(tried, [0, 10, 30, 70, 150, 310, 630, 1270, 1910]);
        retest.raise(second(3_000));
        assert!(retest.follow() && retest.settle(second(3_000), true, true));
        retest.raise(second(3_009));
        assert!(!retest.follow());
        retest.raise(second(3_010));
        assert!(retest.follow());
    }

    #[test]
    fn a_test_that_was_asked_for_and_finds_all_well_delays_nothing() {
        let mut retest = Retest::new();
        assert!(!retest.settle(Micros(5), true, true));
        retest.raise(Micros(6));
        assert!(!retest.follow());
        assert!(!retest.settle(Micros(7), true, false));
        retest.raise(Micros(8));
        assert!(retest.follow());
    }
}
