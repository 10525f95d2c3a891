//! Images of WiReSens, cut into packets that run over the end of an image into the next.
//!
//! A packet: id `i8`, start `u16`, N values `u16`, number `u32`, and over a serial link `"wr"`; little-endian. `start`
//! is the index of the first value in the image of rows x columns, row by row, the ground wire outer. Over TCP the
//! trailer is absent. In the intermittent mode packets that are not sent are counted, and `start` is 20,000 for a list
//! of pairs: such images are not delivered. Values fall from about 3,100 at rest to 0 at saturation.

use super::checksum::FrameCheck;
use super::frame::StreamFrame;
use super::marked::{Marked, RecordForm};
use super::number::NumberForm;
use super::stamp::SensorCount;
use super::timed_bytes::TimedBytes;

/// Bytes of a packet beside its values.
const BESIDE: usize = 7;
const TRAILER: &[u8] = b"wr";

/// Images from consecutive packets alone.
#[derive(Debug)]
pub struct Packets {
    cutter: PacketCutter,
    images: PacketImages,
}

#[derive(Debug)]
enum PacketCutter {
    /// Each ends with the trailer.
    Trailed(Marked),
    /// Nothing is between them.
    Bare(TimedBytes, usize),
}

#[derive(Debug)]
struct PacketImages {
    /// Values of an image.
    length: usize,
    /// The sensor that is followed: the first one, unless it is named.
    id: Option<i8>,
    numbers: SensorCount,
    values: Vec<f64>,
    /// True if all values since the start of the image are there.
    is_whole: bool,
    dropped: u64,
    missed: u64,
}

impl Packets {
    /// Packets of `nodes` values.
    pub fn new(length: usize, nodes: u16, id: Option<i8>, trailer: bool) -> Packets {
        let body = BESIDE + 2 * usize::from(nodes);
        let form = RecordForm {
            open: TRAILER.into(),
            body,
            close: TRAILER.into(),
            shares: true,
            frame: TRAILER.len()..TRAILER.len() + body,
            check: FrameCheck::None,
            checked: 0,
        };
        let cutter = match trailer {
            true => PacketCutter::Trailed(Marked::new(form)),
            false => PacketCutter::Bare(TimedBytes::default(), body),
        };
        let numbers = SensorCount::new(NumberForm::U32le);
        let images =
            PacketImages { length, id, numbers, values: Vec::new(), is_whole: false, dropped: 0, missed: 0 };
        Packets { cutter, images }
    }

    /// Takes bytes; hands over each image.
    pub fn push(&mut self, bytes: &[u8], arrival_us: u64, found: &mut dyn FnMut(StreamFrame)) {
        let Packets { cutter, images } = self;
        match cutter {
            PacketCutter::Trailed(marked) => {
                marked.push(bytes, arrival_us, &mut |packet, arrival, _| images.take(packet, arrival, found));
            }
            PacketCutter::Bare(waiting, length) => {
                for piece in bytes.chunks(*length) {
                    waiting.push(piece, arrival_us);
                    while let Some(packet) = waiting.bytes().get(..*length) {
                        let next = match images.is_packet(packet) {
                            true => {
                                images.take(packet, waiting.arrival(*length - 1), found);
                                *length
                            }
                            false => 1,
                        };
                        waiting.consume(next);
                    }
                }
            }
        }
    }

    /// Images that lack a packet, and packets that did not come.
    pub fn lost(&self) -> [u64; 2] {
        [self.images.dropped, self.images.missed]
    }
}

/// Number and start of a packet.
fn fields(packet: &[u8]) -> (u32, usize) {
    let number = NumberForm::U32le.count(&packet[packet.len() - 4..]);
    (number, NumberForm::U16le.count(&packet[1..]) as usize)
}

impl PacketImages {
    /// True if its start follows from its number: all packets are sent.
    fn is_packet(&self, packet: &[u8]) -> bool {
        let ((number, start), nodes) = (fields(packet), (packet.len() - BESIDE) / 2);
        start as u64 == u64::from(number) * nodes as u64 % self.length as u64
    }

    fn take(&mut self, packet: &[u8], arrival_us: u64, found: &mut dyn FnMut(StreamFrame)) {
        if *self.id.get_or_insert(packet[0] as i8) != packet[0] as i8 {
            return;
        }
        let (number, start) = fields(packet);
        let gap = self.numbers.gap(number);
        self.missed += gap;
        let follows = gap == 0 && start == self.values.len();
        if !follows {
            self.dropped += u64::from(self.is_whole && !self.values.is_empty());
            (self.is_whole, self.values) = (false, vec![0.0; start.min(self.length)]);
        }
        if start >= self.length {
            self.values.clear();
            return;
        }
        let mut values = Vec::new();
        NumberForm::U16le.read(&packet[3..packet.len() - 4], &mut values);
        for value in values {
            self.is_whole |= self.values.is_empty();
            self.values.push(value);
            if self.values.len() == self.length {
                let values = std::mem::take(&mut self.values);
                if self.is_whole {
                    found(StreamFrame { values, arrival_us, ..StreamFrame::default() });
                }
            }
        }
    }
}
