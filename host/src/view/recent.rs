//! The bytes of the last half minute, as a file that `--source file:FILE` reads.

use std::collections::VecDeque;
use taxel_core::format::Micros;
use taxel_core::wire::{Receiver, Report, decode, encode, frame_bound};

/// How long bytes are kept, us of the board.
const KEPT: u64 = 30_000_000;
/// How many of them at most, whatever the board says of its time.
const BYTES: usize = 64 << 20;
/// Longest message of a board.
const LONGEST: usize = 8192;

/// A message in its frame.
#[derive(Debug)]
struct Piece {
    bytes: Vec<u8>,
    /// Time of the last image so far.
    time: Micros,
    /// Its number on the line.
    seq: u32,
    /// An image that stands alone.
    key: bool,
}

/// Keeps what came last.
pub struct Recent {
    receiver: Box<Receiver<LONGEST>>,
    /// Bytes of the frame that has not ended.
    begun: Vec<u8>,
    /// The message of the last `Hello`.
    hello: Vec<u8>,
    /// The garment that it names.
    garment: Vec<u8>,
    pieces: VecDeque<Piece>,
    held: usize,
}

impl Default for Recent {
    fn default() -> Self {
        Recent {
            receiver: Box::default(),
            begun: Vec::new(),
            hello: Vec::new(),
            garment: Vec::new(),
            pieces: VecDeque::new(),
            held: 0,
        }
    }
}

impl Recent {
    /// Takes bytes in any split.
    pub fn push(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.begun.push(*byte);
            let Some(message) = self.receiver.push(*byte) else {
                self.begun.truncate(LONGEST);
                continue;
            };
            let frame = self.begun.clone();
            self.begun.clear();
            let before = self.pieces.back().map_or(Micros(0), |piece| piece.time);
            let Some((seq, report)) = message.ok().and_then(read) else { continue };
            let (time, key) = match &report {
                Report::Hello(hello) => {
                    if self.garment != hello.garment {
                        self.garment = hello.garment.to_vec();
                        // What came before cannot be read any more.
                        self.pieces.clear();
                        self.held = 0;
                    }
                    self.hello = postcard::to_allocvec(&report).unwrap_or_default();
                    (before, false)
                }
                Report::Frame(image) => (image.time, image.base.is_none()),
                _ => (before, false),
            };
            self.held += frame.len();
            self.pieces.push_back(Piece { bytes: frame, time, seq, key });
            self.forget(time);
        }
    }

    fn forget(&mut self, now: Micros) {
        while self.pieces.front().is_some_and(|oldest| now.since(oldest.time) > KEPT || self.held > BYTES) {
            let gone = self.pieces.pop_front();
            self.held -= gone.map_or(0, |piece| piece.bytes.len());
        }
    }

    /// A `Hello` and all that came from the first image on that stands alone; none before there is one.
    pub fn recording(&self) -> Option<Vec<u8>> {
        let first = self.pieces.iter().position(|piece| piece.key)?;
        let seq = self.pieces.get(first)?.seq.wrapping_sub(1);
        let hello: Report<'_> = decode(&self.hello).ok()?;
        let mut body = vec![0; LONGEST];
        let mut frame = vec![0; frame_bound(LONGEST)];
        // It takes the number before, so that nothing seems to be lost.
        let length = encode(&(seq, &hello), &mut body, &mut frame).ok()?;
        frame.truncate(length);
        frame.extend(self.pieces.iter().skip(first).flat_map(|piece| &piece.bytes));
        Some(frame)
    }
}

fn read(message: &[u8]) -> Option<(u32, Report<'_>)> {
    let (seq, rest) = postcard::take_from_bytes::<u32>(message).ok()?;
    Some((seq, decode(rest).ok()?))
}
