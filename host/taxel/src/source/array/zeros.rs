//! Counted zeros: a byte of 1 to 254 is a value, 0 and a count stand for so many zeros, 255 ends the frame.

use super::frame::StreamFrame;

/// Frames of counted zeros. The first is dropped: it may have begun before.
#[derive(Debug)]
pub struct Zeros {
    length: usize,
    values: Vec<f64>,
    has_begun: bool,
    /// The last byte was 0, so that the next one is a count.
    counts: bool,
    is_damaged: bool,
    /// Damaged frames.
    pub dropped: u64,
}

impl Zeros {
    /// Frames of this number of values.
    pub fn new(length: usize) -> Zeros {
        Zeros { length, values: Vec::new(), has_begun: false, counts: false, is_damaged: false, dropped: 0 }
    }

    /// Takes bytes; hands over each frame.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64, found: &mut dyn FnMut(StreamFrame)) {
        for byte in bytes {
            match *byte {
                255 => self.end(arrival_us, found),
                byte if self.counts => {
                    self.add(usize::from(byte), 0.0);
                    self.is_damaged |= byte == 0;
                    self.counts = false;
                }
                0 => self.counts = true,
                byte => self.add(1, byte.into()),
            }
        }
    }

    fn add(&mut self, count: usize, value: f64) {
        if self.values.len() + count > self.length {
            self.is_damaged = true;
        } else {
            self.values.extend(std::iter::repeat_n(value, count));
        }
    }

    fn end(&mut self, arrival_us: u64, found: &mut dyn FnMut(StreamFrame)) {
        let is_whole = !self.is_damaged && !self.counts && self.values.len() == self.length;
        let values = std::mem::take(&mut self.values);
        match (std::mem::replace(&mut self.has_begun, true), is_whole) {
            (false, _) => {}
            (true, true) => found(StreamFrame { values, arrival_us, ..StreamFrame::default() }),
            (true, false) => self.dropped += 1,
        }
        (self.counts, self.is_damaged) = (false, false);
    }
}
