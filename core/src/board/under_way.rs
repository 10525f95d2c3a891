//! The message under way to the host.

use crate::wire::*;
use serde::Serialize;

/// Most data of a message: an image of any 2,048 taxels.
const DATA: usize = image_bound(2048, 16);
/// What stands before them: numbers, time, sum.
const HEAD: usize = 44;
/// Longest body of a message. A full list of contacts is shorter.
const BODY: usize = HEAD + DATA + 20;
/// Its frame.
const FRAME: usize = frame_bound(BODY);

/// Encodes one message at a time and hands out its bytes.
pub(super) struct UnderWay {
    seq: u32,
    body: [u8; BODY],
    wire: [u8; FRAME],
    from: usize,
    to: usize,
}

impl UnderWay {
    /// One 0x00 first: whatever a booting board or an opening line put on the wire ends there.
    pub const fn new() -> Self {
        UnderWay { seq: 0, body: [0; BODY], wire: [0; FRAME], from: 0, to: 1 }
    }

    /// What is left of the message.
    pub fn rest(&self) -> &[u8] {
        self.wire.get(self.from..self.to).unwrap_or(&[])
    }

    /// The first `count` bytes have been taken.
    pub fn sent(&mut self, count: usize) {
        self.from = self.from.saturating_add(count).min(self.to);
    }

    /// Encodes a report of this number; `seq` counts only what was encoded. `false`: it does not fit.
    pub fn put<T: Serialize>(&mut self, number: u32, report: &T) -> bool {
        let UnderWay { seq, body, wire, .. } = self;
        let length = pack(&(*seq, number, report), body).ok().and_then(|packed| stuff(packed, wire));
        self.begin(length)
    }

    /// Where the data of a `Frame` or `Raw` are written first.
    pub fn scratch(&mut self) -> &mut [u8] {
        self.body.get_mut(HEAD..HEAD + DATA).unwrap_or(&mut [])
    }

    /// As [`UnderWay::put`]; the data, which come last, are the first `length` bytes of the scratch: what goes before them is
    /// written before them.
    pub fn put_data<T: Serialize>(&mut self, number: u32, without: &T, length: usize) -> bool {
        let length = self.pack_data(number, without, length);
        self.begin(length)
    }

    fn pack_data<T: Serialize>(&mut self, number: u32, without: &T, length: usize) -> Option<usize> {
        let mut head = [0; HEAD];
        // Without data a report ends with their length, 0.
        let (_, start) = postcard::to_slice(&(self.seq, number, without), &mut head).ok()?.split_last()?;
        let (start, mut tail) = (start.len(), [0; 5]);
        let tail = postcard::to_slice(&(length as u32), &mut tail).ok()?;
        let at = HEAD.checked_sub(start + tail.len())?;
        let message = self.body.get_mut(at..HEAD + length + CRC_BYTES)?;
        for (to, from) in message.iter_mut().zip(head.iter().take(start).chain(tail.iter())) {
            *to = *from;
        }
        stuff(sealed(message)?, &mut self.wire)
    }

    fn begin(&mut self, length: Option<usize>) -> bool {
        (self.from, self.to) = (0, length.unwrap_or(0));
        self.seq = self.seq.wrapping_add(u32::from(length.is_some()));
        length.is_some()
    }
}
