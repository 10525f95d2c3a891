//! Places for frames that a converter fills one after the other while one of them is being read.

use crate::format::Micros;

/// Places of a ring: one that is read, one that is complete, one that is being filled, and one that comes
/// next, which has to be known before the converter gets there.
pub const PLACES: usize = 4;

/// Places that [`Ring::turn`] goes round in.
pub const TURN_PLACES: usize = PLACES - 1;

/// A complete frame that nobody overwrites until the next one is lent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lent {
    /// Where it is.
    pub place: u8,
    /// When its first address was selected.
    pub start: Micros,
    /// Time from then to the first address of the frame after it, microseconds.
    pub duration_us: u32,
    /// Frames before it, since the one that was lent last, that were overwritten unseen.
    pub missed: u32,
}

/// Which frame is where. Whoever calls [`Ring::complete`] may interrupt whoever calls [`Ring::lend`] at any
/// time, but not in the midst of it.
#[derive(Debug, Clone)]
pub struct Ring {
    filling: u8,
    next: u8,
    started: Micros,
    lent: Option<u8>,
    fresh: Option<Lent>,
}

impl Ring {
    /// The converter begins with place 0, at `now`, and goes on with [`Ring::next`].
    pub const fn new(now: Micros) -> Ring {
        Ring { filling: 0, next: 1, started: now, lent: None, fresh: None }
    }

    /// The place that the converter fills after the present one.
    pub const fn next(&self) -> u8 {
        self.next
    }

    /// The place that is being filled.
    pub const fn filling(&self) -> u8 {
        self.filling
    }

    /// The place that was lent last.
    pub const fn lent(&self) -> Option<u8> {
        self.lent
    }

    /// The converter has gone on, at `now`: what comes after that is in [`Ring::next`].
    pub fn complete(&mut self, now: Micros) {
        let duration_us = now.since(self.started).min(u64::from(u32::MAX)) as u32;
        let missed = self.fresh.map_or(0, |unseen| unseen.missed.saturating_add(1));
        let done = Lent { place: self.filling, start: self.started, duration_us, missed };
        (self.fresh, self.filling, self.started) = (Some(done), self.next, now);
        let taken = [Some(done.place), Some(self.filling), self.lent];
        // Three of four places at most are taken.
        self.next = (0..PLACES as u8).find(|place| !taken.contains(&Some(*place))).unwrap_or(0);
    }

    /// A frame is complete, at `now`, of those that are put into their places as they come, by whoever calls
    /// this: the place of the next one. It need not be known before, so [`TURN_PLACES`] are enough.
    pub fn turn(&mut self, now: Micros) -> u8 {
        let done = self.filling;
        self.complete(now);
        let free = (0..TURN_PLACES as u8).find(|place| *place != done && Some(*place) != self.lent);
        (self.filling, self.next) = (free.unwrap_or(0), free.unwrap_or(0));
        self.filling
    }

    /// Lends the latest complete frame, once, and takes back the one before.
    pub fn lend(&mut self) -> Option<Lent> {
        let lent = self.fresh.take()?;
        self.lent = Some(lent.place);
        Some(lent)
    }

    /// The latest complete frame, once, beside the one that is lent, which stays so: to be read at once, and
    /// good if [`Ring::is_whole`] afterwards.
    pub fn show(&mut self) -> Option<Lent> {
        self.fresh.take()
    }

    /// Whether the converter has not come to a place that was shown.
    pub fn is_whole(&self, shown: Lent) -> bool {
        self.filling != shown.place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum of frames: the first is lent, the others are shown beside it.
    #[test]
    fn what_is_summed_up_stays_while_others_are_shown() {
        let mut ring = Ring::new(Micros(0));
        ring.complete(Micros(5_000));
        let sum = ring.lend().unwrap();
        assert_eq!((sum.place, ring.show()), (0, None));
        for frame in 2..200 {
            ring.complete(Micros(5_000 * frame));
            let shown = ring.show().unwrap();
            assert!(shown.place != sum.place && ring.filling != sum.place && ring.next() != sum.place);
            assert_eq!((shown.start, shown.missed), (Micros(5_000 * (frame - 1)), 0));
            assert!(ring.is_whole(shown));
        }
        // Whoever looks at a frame for longer than the next two take may find the converter there.
        ring.complete(Micros(2_000_000));
        let shown = ring.show().unwrap();
        ring.complete(Micros(2_005_000));
        assert!(ring.is_whole(shown));
        ring.complete(Micros(2_010_000));
        assert!(!ring.is_whole(shown));
    }
}
