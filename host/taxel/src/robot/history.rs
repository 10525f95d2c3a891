//! Pressure and place of a touch in the past, between the scans of its board.

use std::collections::VecDeque;

/// Longest time that is remembered, us.
const REMEMBERED_US: u64 = 500_000;

/// The last scans of a touch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TouchHistory(VecDeque<TouchSample>);

/// A touch in a scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchSample {
    /// The host's time, us.
    pub host_us: u64,
    /// Its total, counts.
    pub total: f64,
    /// Its centroid, `[x, y]` in taxels of its panel.
    pub centroid: [f64; 2],
}

impl TouchHistory {
    /// Adds the newest scan.
    pub fn push(&mut self, sample: TouchSample) {
        self.0.retain(|old| old.host_us < sample.host_us);
        while self.0.front().is_some_and(|old| sample.host_us - old.host_us > REMEMBERED_US) {
            self.0.pop_front();
        }
        self.0.push_back(sample);
    }

    /// Change of the total from the last scan but one to the last, counts per second.
    pub fn rate(&self) -> f64 {
        let mut newest = self.0.iter().rev();
        let (Some(last), Some(before)) = (newest.next(), newest.next()) else { return 0.0 };
        (last.total - before.total) * 1e6 / (last.host_us - before.host_us) as f64
    }

    /// The touch at a time between two scans, or as in the first; none from the last on.
    pub fn at(&self, host_us: u64) -> Option<TouchSample> {
        let after = self.0.partition_point(|sample| sample.host_us <= host_us);
        let b = self.0.get(after)?;
        let Some(a) = after.checked_sub(1).and_then(|before| self.0.get(before)) else { return Some(*b) };
        let part = (host_us - a.host_us) as f64 / (b.host_us - a.host_us) as f64;
        let between = |a: f64, b: f64| a + (b - a) * part;
        let centroid = [0, 1].map(|axis| between(a.centroid[axis], b.centroid[axis]));
        Some(TouchSample { host_us, total: between(a.total, b.total), centroid })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_interpolated_between_scans() {
        let mut history = TouchHistory::default();
        let sample = |host_us: u64, total: f64| TouchSample { host_us, total, centroid: [total, 1.0] };
        for (host_us, total) in [(1000, 0.0), (2000, 10.0), (4000, 30.0)] {
            history.push(sample(host_us, total));
        }
        let at = |host_us: u64| history.at(host_us).map(|sample| (sample.total, sample.centroid));
        assert_eq!(at(1500), Some((5.0, [5.0, 1.0])));
        assert_eq!(at(3000), Some((20.0, [20.0, 1.0])));
        assert_eq!((at(500), at(4000)), (Some((0.0, [0.0, 1.0])), None));
        assert_eq!(history.rate(), 10_000.0);
        history.push(sample(600_000, 1.0));
        assert_eq!(history.0.len(), 1);
    }
}
