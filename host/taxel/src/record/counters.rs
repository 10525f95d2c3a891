//! Counts of what has been recorded of a board so far.

use super::tally::Tally;
use crate::client::passed::Passed;
use crate::client::{Client, Event, Stamp};

/// Counters of a board, over all files.
#[derive(Debug, Default)]
pub struct Counters {
    /// Images.
    pub frames: u64,
    /// Images before the current file.
    earlier_frames: u64,
    /// Board time since the current file began.
    passed: Passed,
    /// Board time since the current file began, us.
    passed_us: u64,
    /// Board time of earlier files, us.
    earlier_us: u64,
    /// Counters of the line so far, and when the current file began.
    tally: [Tally; 2],
}

impl Counters {
    /// Handles an event, and its time if the board has reported it.
    pub fn take(&mut self, client: &Client, event: &Event, stamp: Option<Stamp>) {
        self.frames += u64::from(matches!(event, Event::Frame { .. }));
        self.tally[0] = Tally::of(client.counts());
        if let Some(stamp) = stamp {
            self.passed_us = self.passed_us.max(self.passed.until(stamp.board_us));
        }
    }

    /// Board time since the current file began, us, at an event of this time.
    pub(crate) fn passed_until(&mut self, stamp: Stamp) -> u64 {
        self.passed.until(stamp.board_us)
    }

    /// Begins another file.
    pub(crate) fn next_file(&mut self) {
        self.earlier_us = self.board_us();
        (self.passed, self.passed_us) = (Passed::default(), 0);
        self.earlier_frames = self.frames;
        self.tally[1] = self.tally[0];
    }

    /// Counts only this many images of the current file as whole.
    pub fn cut(&mut self, frames: u64) {
        self.frames = self.earlier_frames + frames;
    }

    /// Images of the current file.
    pub(crate) fn file_frames(&self) -> u64 {
        self.frames - self.earlier_frames
    }

    /// Board time recorded so far, us.
    pub fn board_us(&self) -> u64 {
        self.earlier_us.saturating_add(self.passed_us)
    }

    /// Counters of the line, now and when the current file began.
    pub fn tally(&self) -> [Tally; 2] {
        self.tally
    }
}
