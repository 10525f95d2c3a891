//! The bytes of the last half minute, as a file that `--source file:FILE` reads.

use crate::passed::Passed;
use std::collections::VecDeque;
use taxel_core::format::Micros;
use taxel_core::wire::{Receiver, Report, decode, encode, frame_bound};

/// How long bytes are kept, us of the board. Where it starts anew, its clock does, and time goes on from
/// where it was.
const KEPT: u64 = 30_000_000;
/// How many of them at most, whatever the board says of its time.
const BYTES: usize = 64 << 20;
/// Longest message of a board.
const LONGEST: usize = 8192;

/// A message in its frame.
#[derive(Debug)]
struct Piece {
    bytes: Vec<u8>,
    /// The board's time that had passed then, us.
    at: u64,
    /// Its number on the line.
    seq: u32,
    /// An image that stands alone.
    key: bool,
}

/// Keeps what came last.
#[derive(Default)]
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
    /// Time of the last image.
    newest: Micros,
    passed: Passed,
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
            let Some((seq, report)) = message.ok().and_then(read) else { continue };
            let key = match &report {
                Report::Hello(hello) => {
                    if self.garment != hello.garment {
                        self.garment = hello.garment.to_vec();
                        // What came before cannot be read any more.
                        self.pieces.clear();
                        self.held = 0;
                    }
                    self.hello = postcard::to_allocvec(&report).unwrap_or_default();
                    false
                }
                Report::Frame(image) => {
                    self.newest = image.time;
                    image.base.is_none()
                }
                _ => false,
            };
            self.held += frame.len();
            let at = self.passed.until(self.newest.0);
            self.pieces.push_back(Piece { bytes: frame, at, seq, key });
            self.forget(at);
        }
    }

    fn forget(&mut self, now: u64) {
        while self.pieces.front().is_some_and(|oldest| now - oldest.at > KEPT || self.held > BYTES) {
            let gone = self.pieces.pop_front();
            self.held -= gone.map_or(0, |piece| piece.bytes.len());
        }
    }

    /// Whether there is an image that stands alone, and so a recording.
    pub fn is_readable(&self) -> bool {
        self.pieces.iter().any(|piece| piece.key)
    }

    /// Time of the last image.
    pub fn newest(&self) -> Micros {
        self.newest
    }

    /// A `Hello` and all that came from the first image on that stands alone; none before there is one.
    pub fn recording(&self) -> Option<Vec<u8>> {
        let first = self.pieces.iter().position(|piece| piece.key)?;
        let seq = self.pieces.get(first)?.seq.wrapping_sub(1);
        let hello: Report<'_> = decode(&self.hello).ok()?;
        let mut room = vec![0; frame_bound(LONGEST)];
        // It takes the number before, so that nothing seems to be lost.
        let mut frame = encode(&(seq, &hello), &mut room).ok()?.to_vec();
        frame.extend(self.pieces.iter().skip(first).flat_map(|piece| &piece.bytes));
        Some(frame)
    }
}

fn read(message: &[u8]) -> Option<(u32, Report<'_>)> {
    let (seq, rest) = postcard::take_from_bytes::<u32>(message).ok()?;
    Some((seq, decode(rest).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::client::{Client, Event};
    use taxel_core::wire::{Frame, Hello, MAGIC, PROTOCOL};

    fn sent(seq: u32, report: &Report<'_>) -> Vec<u8> {
        encode(&(seq, report), &mut vec![0; frame_bound(LONGEST)]).unwrap().to_vec()
    }

    fn hello(garment: &[u8]) -> Report<'_> {
        let empty: &[u8] = &[];
        let said = Hello {
            magic: MAGIC,
            protocol: PROTOCOL,
            garment,
            firmware: empty,
            clock: empty,
            scene: empty,
            calibration: empty,
        };
        Report::Hello(said)
    }

    /// An image a tenth of a second, each tenth of which stands alone.
    fn image(number: u32) -> Report<'static> {
        let base = (!number.is_multiple_of(10)).then(|| number - 1);
        Report::Frame(Frame {
            frame: number,
            time: Micros(u64::from(number) * 100_000),
            base,
            sum: 0,
            data: &[],
        })
    }

    #[test]
    fn half_a_minute_is_kept_from_a_whole_image_on() {
        let mut recent = Recent::default();
        assert!(recent.recording().is_none());
        let mut bytes = [b"noise\0".to_vec(), sent(0, &hello(b"one"))].concat();
        (1..=1234).for_each(|number| bytes.extend(sent(number, &image(number))));
        bytes.chunks(7).for_each(|part| recent.push(part));
        let mut client = Client::new();
        let events = recent.recording().unwrap().into_iter().filter_map(|byte| client.push(byte));
        let frames: Vec<u32> = events
            .filter_map(|event| if let Event::Frame { frame, .. } = event { Some(frame) } else { None })
            .collect();
        assert_eq!((frames.first(), frames.last(), frames.len()), (Some(&940), Some(&1234), 295));
        assert_eq!((client.counts().lost, client.counts().messages), (0, 296));
        // The board starts anew every eight seconds: its clock does, too.
        let mut seq = 1234;
        for image in (0..20).flat_map(|_| (1..=80).map(image)) {
            seq += 1;
            recent.push(&sent(seq, &image));
        }
        let kept = recent.recording().unwrap().iter().filter(|byte| **byte == 0).count();
        assert!((300..=330).contains(&kept), "{kept}");
        // Another garment: nothing of before is of use.
        recent.push(&sent(seq + 1, &hello(b"two")));
        assert!(recent.recording().is_none());
    }
}
