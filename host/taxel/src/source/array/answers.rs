//! Answers to requests, with nothing around them: a frame is what came until the line was quiet.

/// The answer that is being received.
#[derive(Debug)]
pub struct Answers {
    length: usize,
    bytes: Vec<u8>,
    arrival_us: u64,
    /// True if more bytes came than a frame has.
    is_long: bool,
    /// Answers of another length.
    pub dropped: u64,
}

impl Answers {
    /// Answers of this length.
    pub fn new(length: usize) -> Answers {
        Answers { length, bytes: Vec::new(), arrival_us: 0, is_long: false, dropped: 0 }
    }

    /// Takes bytes.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64) {
        let room = self.length - self.bytes.len();
        self.bytes.extend_from_slice(&bytes[..room.min(bytes.len())]);
        self.is_long |= bytes.len() > room;
        self.arrival_us = arrival_us;
    }

    /// Ends the answer; hands it over if it has the right length.
    pub fn quiet(&mut self, found: &mut dyn FnMut(&[u8], u64)) {
        match self.bytes.len() == self.length && !self.is_long {
            true => found(&self.bytes, self.arrival_us),
            false => self.dropped += u64::from(!self.bytes.is_empty()),
        }
        self.bytes.clear();
        self.is_long = false;
    }
}
