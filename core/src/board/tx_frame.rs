//! The message in transmission to the host.

use crate::capacity::TAXELS;
use crate::wire::*;
use core::ops::Range;
use serde::Serialize;

/// Most data of a message: an image of any [`TAXELS`] taxels.
const DATA: usize = image_bound(TAXELS, 16);
/// Longest head of a message with data: numbers, time, sum, length of the data.
const HEAD: usize = 41;
/// Longest message. A full list of contacts is shorter.
const MESSAGE: usize = HEAD + DATA;
/// Offset of the data: before them is room for the head and for the start of the frame.
const START: usize = lead(MESSAGE) + HEAD;
/// Longest frame.
const FRAME: usize = frame_bound(MESSAGE);

/// Encodes one message at a time and hands out its bytes.
pub(super) struct TxFrame {
    seq: u32,
    wire: [u8; FRAME],
    /// A message that was put and is no frame yet.
    message: Option<Range<usize>>,
    from: usize,
    to: usize,
}

impl TxFrame {
    /// Begins with one 0x00, which ends whatever a booting board or an opening line put on the wire.
    pub const fn new() -> Self {
        TxFrame { seq: 0, wire: [0; FRAME], message: None, from: 0, to: 1 }
    }

    /// Bytes of the message that were not sent yet.
    pub fn rest(&self) -> &[u8] {
        self.wire.get(self.from..self.to).unwrap_or(&[])
    }

    /// Records that `count` more bytes were sent.
    pub fn sent(&mut self, count: usize) {
        self.from = self.from.saturating_add(count).min(self.to);
    }

    /// Writes a report of this number, which [`TxFrame::close`] makes a frame of; `seq` counts written messages
    /// only. Returns `false` if it does not fit.
    pub fn put<T: Serialize>(&mut self, number: u32, report: &T) -> bool {
        self.message = put(&(self.seq, number, report), &mut self.wire).ok();
        self.count()
    }

    /// Buffer for the data of a `Frame` or `Raw`.
    pub fn scratch(&mut self) -> &mut [u8] {
        self.wire.get_mut(START..START + DATA).unwrap_or(&mut [])
    }

    /// Writes a report like [`TxFrame::put`]. Its data, the last field, are the first `length` bytes of the
    /// scratch buffer; its other fields are written before them.
    pub fn put_data<T: Serialize>(&mut self, number: u32, without: &T, length: usize) -> bool {
        self.message = self.put_head(number, without, length).map(|start| start..START + length);
        self.count()
    }

    /// Turns the message that was put, if there is one, into the frame to send.
    pub fn close(&mut self, checksum: &mut impl Checksum) {
        let Some(message) = self.message.take() else { return };
        let frame = close(&mut self.wire, message, checksum);
        (self.from, self.to) = frame.map_or((0, 0), |frame| (frame.start, frame.end));
    }

    /// Writes the fields before data of this length; returns their offset.
    fn put_head<T: Serialize>(&mut self, number: u32, without: &T, length: usize) -> Option<usize> {
        let mut head = [0; HEAD];
        // A report without data ends with their length, 0.
        let start = write(&(self.seq, number, without), &mut head).ok()?.checked_sub(1)?;
        let end = start + write(&(length as u32), head.get_mut(start..)?).ok()?;
        let first = START.checked_sub(end)?;
        let place = self.wire.get_mut(first..START)?;
        place.iter_mut().zip(&head).for_each(|(to, from)| *to = *from);
        Some(first)
    }

    fn count(&mut self) -> bool {
        let fits = self.message.is_some();
        self.seq = self.seq.wrapping_add(u32::from(fits));
        fits
    }
}
