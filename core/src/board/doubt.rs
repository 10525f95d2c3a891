//! What speaks against a line or an input while the board runs is followed by a self-test: a line that breaks
//! in use is told as one that was broken at the start. What the test takes is counted as scans that are lost.

use crate::format::Micros;

/// After a test that said nothing new the next one waits at least so long, and twice as long each time: what
/// presses all of a garment may look like a fault, and a fault that is known already speaks again in every
/// frame.
const PAUSE_US: u64 = 10_000_000;
/// Times that it is doubled: 10 min.
const DOUBLINGS: u8 = 6;

/// Whether lines and inputs are to be examined without anybody having asked.
#[derive(Debug)]
pub(super) struct Doubt {
    raised: bool,
    /// The test under way is for this.
    followed: bool,
    /// Until then nothing is followed.
    until: Micros,
    doublings: u8,
}

impl Doubt {
    /// Nothing speaks against anything.
    pub const fn new() -> Doubt {
        Doubt { raised: false, followed: false, until: Micros(0), doublings: 0 }
    }

    /// Something speaks against a line or an input.
    pub fn raise(&mut self, now: Micros) {
        self.raised |= now >= self.until;
    }

    /// Whether a test is to be made now.
    pub fn follow(&mut self) -> bool {
        self.followed |= self.raised;
        core::mem::take(&mut self.raised)
    }

    /// A test has ended. `is_new`: it said something else than the one before; `ill`: there are faults.
    /// Whether it was for this.
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
