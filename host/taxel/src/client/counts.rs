//! Counters of a connection.

use taxel_core::wire::WireError;

/// Counters since the connection began.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Counts {
    /// Bytes received.
    pub bytes: u64,
    /// Messages read.
    pub messages: u64,
    /// Frames (images) received.
    pub frames: u64,
    /// Messages lost on the link: gaps of `seq`.
    pub lost: u64,
    /// Images that the board left out: gaps of `frame` without a loss, in a scene that sends every image.
    pub thinned: u64,
    /// Images and raw codes that could not be decoded.
    pub undecoded: u64,
    /// Restarts of the board.
    pub restarts: u64,
    kinds: Vec<(WireError, u64)>,
    next: Option<u32>,
    last_frame: Option<u32>,
    lost_since_frame: u64,
}

impl Counts {
    /// Refused frames, by kind.
    pub fn refused_by_kind(&self) -> &[(WireError, u64)] {
        &self.kinds
    }

    /// Number of refused frames.
    pub fn refused(&self) -> u64 {
        self.kinds.iter().map(|(_, count)| count).sum()
    }

    pub(super) fn refuse(&mut self, error: WireError) {
        match self.kinds.iter_mut().find(|(kind, _)| *kind == error) {
            Some((_, count)) => *count += 1,
            None => self.kinds.push((error, 1)),
        }
    }

    /// Handles a message's number. Returns true if the board has restarted, or is another one.
    pub(super) fn sequence(&mut self, seq: u32) -> bool {
        let gap = self.next.map_or(0, |next| seq.wrapping_sub(next));
        self.next = Some(seq.wrapping_add(1));
        // A gap of more than half of the numbers is a step back.
        if gap > u32::MAX / 2 {
            self.last_frame = None;
            self.lost_since_frame = 0;
            return true;
        }
        self.lost += u64::from(gap);
        self.lost_since_frame += u64::from(gap);
        false
    }

    /// Handles an image's number; `every`: the scene sends the image of every scan.
    pub(super) fn frame(&mut self, frame: u32, every: bool) {
        self.frames += 1;
        let skipped = self.last_frame.map_or(0, |last| frame.wrapping_sub(last).saturating_sub(1));
        if every {
            self.thinned += u64::from(skipped).saturating_sub(self.lost_since_frame);
        }
        self.last_frame = Some(frame);
        self.lost_since_frame = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_losses_thinning_or_a_new_start() {
        let mut counts = Counts::default();
        for (seq, frame) in [(7, 3), (8, 4), (9, 6), (12, 8), (13, 9)] {
            assert!(!counts.sequence(seq));
            counts.frame(frame, true);
        }
        assert_eq!((counts.lost, counts.thinned), (2, 1));
        assert!(counts.sequence(0));
        counts.frame(1, true);
        assert_eq!((counts.lost, counts.thinned), (2, 1));
        let mut counts = Counts::default();
        assert!(!counts.sequence(u32::MAX) && !counts.sequence(0) && !counts.sequence(1));
        assert_eq!(counts.lost, 0);
    }
}
