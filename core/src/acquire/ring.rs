//! Buffers that a converter fills one after the other while one of them is being read.

use crate::format::Micros;

/// Places of a ring: one being read, one complete, one being filled, and the one after that, which must be
/// known before the converter gets there.
pub const PLACES: usize = 4;

/// Places that [`Ring::turn`] uses.
pub const TURN_PLACES: usize = PLACES - 1;

/// A complete frame, safe from being overwritten until the next one is lent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lent {
    /// Index of its buffer.
    pub place: u8,
    /// Time at which its first address was selected.
    pub start: Micros,
    /// Time from `start` to the first address of the next frame, microseconds.
    pub duration_us: u32,
    /// Number of frames since the previous loan that were overwritten unread.
    pub missed: u32,
}

/// Assignment of frames to places. The caller of [`Ring::complete`] may interrupt the caller of
/// [`Ring::lend`], but not during that call.
#[derive(Debug, Clone)]
pub struct Ring {
    filling: u8,
    next: u8,
    started: Micros,
    lent: Option<u8>,
    fresh: Option<Lent>,
}

impl Ring {
    /// The converter fills place 0 from `now` on, then [`Ring::next`].
    pub const fn new(now: Micros) -> Ring {
        Ring { filling: 0, next: 1, started: now, lent: None, fresh: None }
    }

    /// Place that the converter fills after the present one.
    pub const fn next(&self) -> u8 {
        self.next
    }

    /// Place being filled.
    pub const fn filling(&self) -> u8 {
        self.filling
    }

    /// Place lent last.
    pub const fn lent(&self) -> Option<u8> {
        self.lent
    }

    /// Records that the present frame is complete at `now` and the converter fills [`Ring::next`].
    pub fn complete(&mut self, now: Micros) {
        let duration_us = now.since(self.started).min(u64::from(u32::MAX)) as u32;
        let missed = self.fresh.map_or(0, |unseen| unseen.missed.saturating_add(1));
        let done = Lent { place: self.filling, start: self.started, duration_us, missed };
        (self.fresh, self.filling, self.started) = (Some(done), self.next, now);
        let taken = [Some(done.place), Some(self.filling), self.lent];
        // At most three of four places are taken.
        self.next = (0..PLACES as u8).find(|place| !taken.contains(&Some(*place))).unwrap_or(0);
    }

    /// Records that the present frame is complete at `now`; returns the place of the next one. For a caller
    /// that puts codes into their places itself: the next place need not be known earlier, so [`TURN_PLACES`]
    /// are enough.
    pub fn turn(&mut self, now: Micros) -> u8 {
        let done = self.filling;
        self.complete(now);
        let free = (0..TURN_PLACES as u8).find(|place| *place != done && Some(*place) != self.lent);
        (self.filling, self.next) = (free.unwrap_or(0), free.unwrap_or(0));
        self.filling
    }

    /// Lends the latest complete frame, once, and takes back the previous one.
    pub fn lend(&mut self) -> Option<Lent> {
        let lent = self.fresh.take()?;
        self.lent = Some(lent.place);
        Some(lent)
    }

    /// Returns the latest complete frame, once, without taking back the lent one. It may be overwritten: read
    /// it at once, and use the result only if [`Ring::is_whole`] afterwards.
    pub fn show(&mut self) -> Option<Lent> {
        self.fresh.take()
    }

    /// True if the converter has not reached the place of a shown frame.
    pub fn is_whole(&self, shown: Lent) -> bool {
        self.filling != shown.place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames that are summed: the first is lent, the others are shown beside it.
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
        // A frame that is read for longer than the next two take may be overwritten.
        ring.complete(Micros(2_000_000));
        let shown = ring.show().unwrap();
        ring.complete(Micros(2_005_000));
        assert!(ring.is_whole(shown));
        ring.complete(Micros(2_010_000));
        assert!(!ring.is_whole(shown));
    }
}
