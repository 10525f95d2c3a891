//! A quota: a number of uses in a row, each granted again after a time.

use crate::format::Micros;

/// `MOST` uses, each of which is granted again after `REFILL_US`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quota<const MOST: u8, const REFILL_US: u64> {
    left: u8,
    /// Time since which fewer than `MOST` are left, or of the last refill.
    since: Micros,
}

impl<const MOST: u8, const REFILL_US: u64> Quota<MOST, REFILL_US> {
    /// A full quota.
    pub const fn new() -> Self {
        Quota { left: MOST, since: Micros(0) }
    }

    /// Limits the remaining uses to `left`, counted from the start of the board.
    pub fn resume(&mut self, left: u8) {
        self.left = self.left.min(left);
    }

    /// Number of uses left at the last query.
    pub const fn known(&self) -> u8 {
        self.left
    }

    /// Number of uses left.
    pub fn left(&mut self, now: Micros) -> u8 {
        while self.left < MOST && now.since(self.since) >= REFILL_US {
            self.left += 1;
            self.since = Micros(self.since.0.saturating_add(REFILL_US));
        }
        self.left
    }

    /// Time until a use is granted, us; 0 if one is left.
    pub fn wait_us(&mut self, now: Micros) -> u64 {
        if self.left(now) > 0 { 0 } else { REFILL_US.saturating_sub(now.since(self.since)) }
    }

    /// Records a use.
    pub fn charge(&mut self, now: Micros) {
        if self.left == MOST {
            self.since = now;
        }
        self.left = self.left.saturating_sub(1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_in_a_row_then_one_at_a_time() {
        let mut quota = Quota::<3, 100>::new();
        for left in [3, 2, 1] {
            assert_eq!((quota.left(Micros(1_000)), quota.wait_us(Micros(1_000))), (left, 0));
            quota.charge(Micros(1_000));
        }
        assert_eq!([1_000, 1_060, 1_100].map(|us| quota.wait_us(Micros(us))), [100, 40, 0]);
        quota.charge(Micros(1_100));
        assert_eq!(quota.wait_us(Micros(1_110)), 90);
        assert_eq!((quota.left(Micros(9_000)), quota.left(Micros(9_000))), (3, 3));
    }

    #[test]
    fn what_was_left_before_a_reset_is_left_after_it() {
        let mut quota = Quota::<3, 100>::new();
        quota.resume(200);
        assert_eq!(quota.left(Micros(50)), 3);
        quota.resume(0);
        assert_eq!((quota.left(Micros(99)), quota.left(Micros(100)), quota.left(Micros(250))), (0, 1, 2));
    }
}
