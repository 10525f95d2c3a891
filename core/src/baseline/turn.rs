//! Rotation of the rows that follow drift: each once in a [turn](TURN_US), whatever the frame rate.

use super::rates::TURN_US;
use crate::format::Micros;

/// The rotation of rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct RowRotation {
    /// Next row, over all panels.
    row: u16,
    /// Time at which it is due.
    due: Micros,
    /// Time between rows, us.
    row_us: u32,
}

impl RowRotation {
    /// Begins with the first row, at once.
    pub const fn new() -> Self {
        RowRotation { row: 0, due: Micros(0), row_us: 0 }
    }

    /// Returns the next of `rows` rows if it is due; in half the time if `hurried`. After a pause at most one
    /// whole turn is made up.
    pub fn next(&mut self, now: Micros, rows: u16, hurried: bool) -> Option<u16> {
        let turn = u64::from(TURN_US);
        // After the clock was set back, a row is due at once.
        if self.due.since(now) > turn {
            self.due = now;
        }
        if now < self.due {
            return None;
        }
        if self.row >= rows {
            self.row = 0;
        }
        if self.row == 0 {
            self.row_us = TURN_US.checked_div(rows.into())?;
        }
        let row_us = if hurried { self.row_us / 2 } else { self.row_us };
        let row = self.row;
        self.row += 1;
        self.due = Micros(self.due.0.max(now.0.saturating_sub(turn)).saturating_add(row_us.into()));
        Some(row)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    /// Rows visited in each frame.
    fn visits(times: impl Iterator<Item = u64>, rows: u16, hurried: bool) -> Vec<usize> {
        let mut turn = RowRotation::new();
        let mut want = 0;
        let mut frame = |now| {
            let mut count = 0;
            while let Some(row) = turn.next(Micros(now), rows, hurried) {
                assert_eq!(row, want);
                want = (want + 1) % rows;
                count += 1;
            }
            count
        };
        times.map(&mut frame).collect()
    }

    #[test]
    fn every_row_has_its_turn_once_in_700_ms_at_any_rate() {
        for rows in [1, 4, 27, 64, 128, 300] {
            for period_us in [640, 5_128, 16_667, 40_000, 111_111] {
                let frames = 70_000_000 / period_us;
                for (hurried, wanted) in [(false, 100.0), (true, 200.0)] {
                    let times = (0..frames).map(|frame| frame * period_us);
                    let seen: usize = visits(times, rows, hurried).iter().sum();
                    let turns = seen as f64 / f64::from(rows);
                    assert!(
                        (turns / wanted - 1.0).abs() < 0.02,
                        "{rows} rows each {period_us} us: {turns} turns"
                    );
                }
            }
        }
    }

    #[test]
    fn pauses_and_clocks_that_are_set_cost_a_turn_at_most() {
        let hour = 3_600_000_000;
        let seen =
            visits([hour, hour + 1, 3 * hour, 3 * hour + 10_000, 5, 10_000, 20_000].into_iter(), 64, false);
        assert!(seen.iter().all(|count| *count <= 66), "{seen:?}");
        assert!(seen[0] >= 64 && seen[2] >= 64 && seen[4] >= 1 && seen[6] >= 1, "{seen:?}");
    }
}
