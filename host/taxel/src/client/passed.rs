//! Elapsed board time across restarts of the board's clock.

use std::time::Duration;

/// A larger step back is a restart; smaller ones are messages out of order.
const ANEW: Duration = Duration::from_secs(1);

/// Time since the first message.
#[derive(Debug, Default, Clone, Copy)]
pub struct Passed {
    last: Option<u64>,
    us: u64,
}

impl Passed {
    /// Handles a message's time, us of the board. Returns the time elapsed until then, us; a restart adds
    /// none.
    pub fn until(&mut self, time_us: u64) -> u64 {
        let last = self.last.unwrap_or(time_us);
        self.us = self.us.saturating_add(time_us.saturating_sub(last));
        let is_anew = last.saturating_sub(time_us) > ANEW.as_micros() as u64;
        self.last = Some(if is_anew { time_us } else { last.max(time_us) });
        self.us
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_takes_no_time_and_the_order_of_messages_does_not_matter() {
        let mut passed = Passed::default();
        let times = [7_000_000, 7_000_500, 7_000_100, 7_000_900, 300, 1_000, u64::MAX, 5];
        let until = times.map(|time| passed.until(time));
        assert_eq!(until[..6], [0, 500, 500, 900, 900, 1_600]);
        assert_eq!(until[6..], [u64::MAX; 2]);
    }
}
