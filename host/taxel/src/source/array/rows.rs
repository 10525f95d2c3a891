//! Text: a frame a line, or a row a line with an empty line behind each frame.

use super::frame::StreamFrame;
use super::words::{LineForm, LineKind};

/// Longest line, in bytes for each of its numbers and in front of them.
const NUMBER: usize = 32;
const FRONT: usize = 256;

/// Lines of a stream. The first line is dropped: it may have begun before.
#[derive(Debug)]
pub struct Rows {
    form: LineForm,
    /// Numbers of a line.
    across: usize,
    /// Lines of a frame; none if each line is a frame.
    down: Option<usize>,
    line: Vec<u8>,
    is_long: bool,
    has_begun: bool,
    frame: StreamFrame,
    /// Lines of the frame so far.
    lines: usize,
    is_damaged: bool,
    /// The frame may have begun before the stream did.
    is_cut: bool,
    /// Damaged frames.
    pub dropped: u64,
}

impl Rows {
    /// Frames of `down` lines of `across` numbers, or of one line.
    pub fn new(form: LineForm, across: usize, down: Option<usize>) -> Rows {
        Rows {
            form,
            across,
            down,
            line: Vec::new(),
            is_long: false,
            has_begun: false,
            frame: StreamFrame::default(),
            lines: 0,
            is_damaged: false,
            is_cut: false,
            dropped: 0,
        }
    }

    /// Declares that a whole line begins. Returns true if it is a whole frame.
    pub fn begin(&mut self) -> bool {
        self.has_begun = true;
        self.down.is_none()
    }

    /// Takes bytes; hands over each frame.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64, found: &mut dyn FnMut(StreamFrame)) {
        for piece in bytes.split_inclusive(|byte| *byte == b'\n') {
            let room = FRONT + NUMBER * self.across - self.line.len();
            self.is_long |= piece.len() > room;
            self.line.extend_from_slice(&piece[..room.min(piece.len())]);
            if piece.ends_with(b"\n") {
                self.end_line(arrival_us, found);
                self.line.clear();
                self.is_long = false;
            }
        }
    }

    fn end_line(&mut self, arrival_us: u64, found: &mut dyn FnMut(StreamFrame)) {
        if !std::mem::replace(&mut self.has_begun, true) {
            self.is_cut = self.down.is_some() && !self.line.trim_ascii().is_empty();
            return;
        }
        let before = self.frame.values.len();
        let kind = match self.is_long {
            true => LineKind::Damaged,
            false => self.form.read(&self.line, &mut self.frame),
        };
        match kind {
            LineKind::Other => {}
            LineKind::Empty if self.down.is_some() => self.end_frame(found),
            LineKind::Empty => {}
            kind => {
                let numbers = self.frame.values.len() - before;
                self.is_damaged |= kind == LineKind::Damaged || numbers != self.across;
                self.frame.arrival_us = arrival_us;
                self.lines += 1;
                let most = self.down.unwrap_or(1);
                if self.is_damaged || self.lines > most {
                    self.is_damaged = true;
                    self.frame.values.clear();
                }
                if self.down.is_none() {
                    self.end_frame(found);
                }
            }
        }
    }

    /// Hands over the frame, if it is whole.
    fn end_frame(&mut self, found: &mut dyn FnMut(StreamFrame)) {
        let frame = std::mem::take(&mut self.frame);
        let is_whole = !self.is_damaged && self.lines == self.down.unwrap_or(1);
        match (self.is_cut, is_whole) {
            (true, _) => {}
            (false, true) => found(frame),
            (false, false) => self.dropped += u64::from(self.lines > 0),
        }
        (self.lines, self.is_damaged, self.is_cut) = (0, false, false);
    }
}
