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
pub(super) struct Doubt {
    raised: bool,
    /// The test in progress was started by evidence.
    followed: bool,
    /// Evidence before this time is ignored.
    until: Micros,
    doublings: u8,
}

impl Doubt {
    /// No evidence.
    pub const fn new() -> Doubt {
        Doubt { raised: false, followed: false, until: Micros(0), doublings: 0 }
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

    /// Takes the end of a test. `is_new`: its findings differ from those before; `ill`: there are faults.
    /// Returns true if the test was started by evidence.
    pub fn settle(&mut self, now: Micros, is_new: bool, ill: bool) -> bool {
        self.raised = false;
        let followed = core::mem::take(&mut self.followed);
        if is_new {
            self.doublings = 0;
        }
        if followed || ill {
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
        let mut doubt = Doubt::new();
        let second = |s: u64| Micros(s * 1_000_000);
        let mut tried = heapless::Vec::<u64, 16>::new();
        for s in 0..2_000 {
            doubt.raise(second(s));
            if doubt.follow() {
                assert!(doubt.settle(second(s), false, false));
                let _ = tried.push(s);
            }
        }
        assert_eq!(tried, [0, 10, 30, 70, 150, 310, 630, 1270, 1910]);
        doubt.raise(second(3_000));
        assert!(doubt.follow() && doubt.settle(second(3_000), true, true));
        doubt.raise(second(3_009));
        assert!(!doubt.follow());
        doubt.raise(second(3_010));
        assert!(doubt.follow());
    }

    #[test]
    fn a_test_that_was_asked_for_and_finds_all_well_delays_nothing() {
        let mut doubt = Doubt::new();
        assert!(!doubt.settle(Micros(5), true, true));
        doubt.raise(Micros(6));
        assert!(!doubt.follow());
        assert!(!doubt.settle(Micros(7), true, false));
        doubt.raise(Micros(8));
        assert!(doubt.follow());
    }
}
