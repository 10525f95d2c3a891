//! Rate limit for changes of garment or scene: each rebuilds the stages, and nothing is scanned meanwhile.

use super::quota::Quota;
use crate::format::Micros;
use crate::wire::Request;

/// Allows a change if a scan has ended since the last one, and the quota allows it: four in a row, ten a
/// second.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rebuilds {
    quota: Quota<4, 100_000>,
    /// True if no scan has ended since the last change.
    waits: bool,
}

impl Rebuilds {
    pub const fn new() -> Rebuilds {
        Rebuilds { quota: Quota::new(), waits: false }
    }

    /// True if a request of this number is such a change.
    pub fn count(number: u8) -> bool {
        number == Request::SetGarment(&[]).number() || number == Request::SetScene(&[]).number()
    }

    /// True if a change is allowed now.
    pub fn are_due(&mut self, now: Micros) -> bool {
        !self.waits && self.quota.left(now) > 0
    }

    /// Records a change.
    pub fn charge(&mut self, now: Micros) {
        self.quota.charge(now);
        self.waits = true;
    }

    /// Records the end of a scan, successful or not.
    pub fn scanned(&mut self) {
        self.waits = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_between_two_scans_and_ten_a_second() {
        let mut rebuilds = Rebuilds::new();
        let mut changes = heapless::Vec::<u64, 64>::new();
        for us in (0..2_000_000).step_by(1_000) {
            // A scan every 5 ms.
            if us % 5_000 == 0 {
                rebuilds.scanned();
            }
            if rebuilds.are_due(Micros(us)) {
                rebuilds.charge(Micros(us));
                changes.push(us).unwrap();
            }
        }
        assert_eq!(changes[..6], [0, 5_000, 10_000, 15_000, 100_000, 200_000]);
        assert_eq!(changes.len(), 4 + 19);
        // Without a scan no change is allowed, however much time passes.
        rebuilds.charge(Micros(2_000_000));
        assert!(!rebuilds.are_due(Micros(90_000_000)));
        rebuilds.scanned();
        assert!(rebuilds.are_due(Micros(90_000_000)));
    }
}
