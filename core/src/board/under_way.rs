//! The message under way to the host.

use crate::wire::*;
use serde::Serialize;

/// Longest body of a message: an image of any 2,048 taxels and what stands before it. A full list of contacts is shorter.
const BODY: usize = image_bound(2048, 16) + 64;
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

    /// Where the data of a `Frame` or `Raw` are written first: what will be sent has room for them.
    pub fn scratch(&mut self) -> &mut [u8] {
        &mut self.wire
    }

    /// As [`UnderWay::put`]; its data are the first `length` bytes of the scratch.
    pub fn put_frame(&mut self, head: Frame<'static>, length: usize) -> bool {
        let data = self.wire.get(..length).unwrap_or(&[]);
        let packed = pack(&(self.seq, Report::FRAME, Frame { data, ..head }), &mut self.body);
        let length = packed.ok().and_then(|packed| stuff(packed, &mut self.wire));
        self.begin(length)
    }

    /// As [`UnderWay::put_frame`].
    pub fn put_raw(&mut self, head: Raw<'static>, length: usize) -> bool {
        let data = self.wire.get(..length).unwrap_or(&[]);
        let packed = pack(&(self.seq, Report::RAW, Raw { data, ..head }), &mut self.body);
        let length = packed.ok().and_then(|packed| stuff(packed, &mut self.wire));
        self.begin(length)
    }

    fn begin(&mut self, length: Option<usize>) -> bool {
        (self.from, self.to) = (0, length.unwrap_or(0));
        self.seq = self.seq.wrapping_add(u32::from(length.is_some()));
        length.is_some()
    }
}
