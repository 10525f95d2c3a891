//! Pressure and place of a touch in the past, between the scans of its board.

use super::seam_change::SeamChange;
use super::touched::{BoardTouch, TouchMoment};
use std::collections::VecDeque;

/// Longest time that is remembered, us.
const REMEMBERED_US: u64 = 500_000;

/// The last scans of a touch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TouchHistory(VecDeque<TouchSample>);

/// A touch in a scan.
#[derive(Debug, Clone, PartialEq)]
struct TouchSample {
    /// The host's time, us.
    host_us: u64,
    /// As its board told it.
    told: BoardTouch,
    /// The same with what presses beyond seams.
    touch: BoardTouch,
}

impl TouchHistory {
    /// Adds the newest scan, as its board told it at the host's time, us.
    pub fn push(&mut self, host_us: u64, told: BoardTouch) {
        self.0.retain(|old| old.host_us < host_us);
        while self.0.front().is_some_and(|old| host_us - old.host_us > REMEMBERED_US) {
            self.0.pop_front();
        }
        self.0.push_back(TouchSample { host_us, touch: told.clone(), told });
    }

    /// True if nothing was told yet.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Makes in the scan at the host's time, us, those of the changes that lie at the touch, and takes them out.
    /// What was changed in that scan before is forgotten. Returns the touch, if it was there then.
    pub fn change(&mut self, host_us: u64, changes: &mut Vec<SeamChange>) -> Option<&BoardTouch> {
        let TouchSample { told, touch, .. } =
            self.0.iter_mut().rev().find(|sample| sample.host_us == host_us)?;
        touch.clone_from(told);
        changes.retain(|change| {
            let is_here = told.reaches(change.place, 1);
            if is_here {
                touch.change(change);
            }
            !is_here
        });
        Some(touch)
    }

    /// Time of the newest scan until a time of the host, us; none if all are later.
    pub fn newest_until(&self, host_us: u64) -> Option<u64> {
        self.0.iter().rev().map(|sample| sample.host_us).find(|at_us| *at_us <= host_us)
    }

    /// How far what is interpolated for a time of the host, us, may be off, in us^2: times half the second
    /// derivative, it is what a linear interpolation leaves. 0 at a scan, and where nothing is interpolated.
    pub fn interpolation_error(&self, host_us: u64) -> f64 {
        match self.around(host_us) {
            Some((a, b)) => (host_us - a.host_us) as f64 * (b.host_us - host_us) as f64,
            None => 0.0,
        }
    }

    /// The last scan until a time of the host, us, and the first after it.
    fn around(&self, host_us: u64) -> Option<(&TouchSample, &TouchSample)> {
        let after = self.0.partition_point(|sample| sample.host_us <= host_us);
        Some((self.0.get(after.checked_sub(1)?)?, self.0.get(after)?))
    }

    /// Change of the total from the last scan but one to the last, counts per second.
    pub fn rate(&self) -> f64 {
        let mut newest = self.0.iter().rev();
        let (Some(last), Some(before)) = (newest.next(), newest.next()) else { return 0.0 };
        let total = |sample: &TouchSample| f64::from(sample.touch.total);
        (total(last) - total(before)) * 1e6 / (last.host_us - before.host_us) as f64
    }

    /// The touch at a time between two scans, or as in the first; none from the last on.
    pub fn at(&self, host_us: u64) -> Option<TouchMoment> {
        let Some((a, b)) = self.around(host_us) else {
            return self.0.front().filter(|first| first.host_us > host_us).map(|first| first.touch.moment());
        };
        let (from, to) = (a.touch.moment(), b.touch.moment());
        let part = (host_us - a.host_us) as f64 / (b.host_us - a.host_us) as f64;
        let between = |a: f64, b: f64| a + (b - a) * part;
        let centroid = [0, 1].map(|axis| between(from.centroid[axis], to.centroid[axis]));
        Some(TouchMoment { total: between(from.total, to.total), centroid })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::{Place, Rect};

    fn touch(total: u32) -> BoardTouch {
        BoardTouch {
            contact: None,
            begins: false,
            panel: 0,
            total,
            peak: 0,
            area: 1,
            bounds: Rect { panel: 0, top: 4, bottom: 4, left: 4, right: 4 },
            centroid: [f64::from(total), 1.0],
            velocity: [0.0; 2],
            newtons_per_count: None,
        }
    }

    fn at(history: &TouchHistory, host_us: u64) -> Option<(f64, [f64; 2])> {
        history.at(host_us).map(|moment| (moment.total, moment.centroid))
    }

    #[test]
    fn it_is_interpolated_between_scans() {
        let mut history = TouchHistory::default();
        for (host_us, total) in [(1000, 0), (2000, 10), (4000, 30)] {
            history.push(host_us, touch(total));
        }
        assert_eq!(at(&history, 1500), Some((5.0, [5.0, 1.0])));
        assert_eq!(at(&history, 3000), Some((20.0, [20.0, 1.0])));
        assert_eq!((at(&history, 500), at(&history, 4000)), (Some((0.0, [0.0, 1.0])), None));
        assert_eq!(history.rate(), 10_000.0);
        assert_eq!(
            [999, 1000, 3999, 4001].map(|at_us| history.newest_until(at_us)),
            [None, Some(1000), Some(2000), Some(4000)]
        );
        let error = [500, 1000, 1250, 3000, 4000, 5000].map(|at_us| history.interpolation_error(at_us));
        assert_eq!(error, [0.0, 0.0, 187_500.0, 1e6, 0.0, 0.0]);
        history.push(600_000, touch(1));
        assert_eq!(history.0.len(), 1);
    }

    #[test]
    fn a_change_is_made_where_and_when_it_is_and_not_twice() {
        let mut history = TouchHistory::default();
        for (host_us, total) in [(1000, 10), (2000, 10), (3000, 20)] {
            history.push(host_us, touch(total));
        }
        let change = |row: u16, value: u16| SeamChange {
            taxel: row,
            place: Place { panel: 0, row, column: 5 },
            told: 2,
            value,
        };
        let mut changes = vec![change(5, 8), change(7, 100)];
        assert_eq!(history.change(2000, &mut changes).map(|touch| touch.total), Some(16));
        assert_eq!(changes, [change(7, 100)]);
        assert_eq!(history.change(2000, &mut vec![change(3, 0)]).map(|touch| touch.total), Some(8));
        assert_eq!(history.change(1500, &mut vec![change(5, 8)]), None);
        let totals = [1000, 2000, 2999].map(|host_us| at(&history, host_us).map(|(total, _)| total.round()));
        assert_eq!(totals, [Some(10.0), Some(8.0), Some(20.0)]);
    }
}
