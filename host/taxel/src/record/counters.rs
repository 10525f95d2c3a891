//! Progress of a recording.

use crate::client::{Client, Event};
use std::fmt::Write;
use std::path::Path;

/// Counters shown while recording.
#[derive(Debug, Default)]
pub struct Counters {
    frames: u64,
    earlier_frames: u64,
    lost: u64,
    thinned: u64,
    passed_us: u64,
    earlier_us: u64,
    written: u64,
    files: u32,
}

impl Counters {
    /// Handles an event, `passed_us` after the start of the file.
    pub fn take(&mut self, client: &Client, event: &Event, passed_us: u64) {
        self.frames += u64::from(matches!(event, Event::Frame { .. }));
        (self.lost, self.thinned) = (client.counts().lost, client.counts().thinned);
        self.passed_us = self.passed_us.max(passed_us);
    }

    /// Handles the end of a file.
    pub fn ended(&mut self, bytes: u64) {
        self.earlier_us = self.board_us();
        self.passed_us = 0;
        self.earlier_frames += std::mem::take(&mut self.frames);
        self.written += bytes;
        self.files += 1;
    }

    /// Handles the premature end of a file with this many frames.
    pub fn cut(&mut self, bytes: u64, frames: u64) {
        self.frames = frames;
        self.ended(bytes);
    }

    /// Frames of the current file.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Board time recorded so far, us.
    pub fn board_us(&self) -> u64 {
        self.earlier_us.saturating_add(self.passed_us)
    }

    /// Formats one line; `bytes` is the size of the current file.
    pub fn line(&self, path: &Path, bytes: u64) -> String {
        let seconds = self.board_us() as f64 / 1e6;
        let megabytes = (self.written + bytes) as f64 / 1e6;
        let mut line = format!(
            "{}: {seconds:.1} s, {} frames, {megabytes:.2} MB, {} lost, {} thinned",
            path.display(),
            self.earlier_frames + self.frames,
            self.lost,
            self.thinned
        );
        if self.files > 1 {
            // Writing to a string cannot fail.
            let _ = write!(line, ", {} files", self.files);
        }
        line
    }
}
