//! Bytes of the last half minute, as a file for `--source file:FILE`.

use std::collections::VecDeque;
use taxel::client::passed::Passed;
use taxel_core::format::Micros;
use taxel_core::wire::{Receiver, Report, decode, encode, frame_bound};

/// Time for which bytes are kept, us of the board. Across restarts of the board's clock, time runs on.
const KEPT: u64 = 30_000_000;
/// Most bytes kept, whatever the clocks of the boards say.
const BYTES: usize = 64 << 20;
/// Longest message of a board.
const LONGEST: usize = 8192;

/// A message as a frame of the wire.
#[derive(Debug)]
struct Piece {
    bytes: Vec<u8>,
    /// Elapsed board time, us.
    at: u64,
    /// Message number.
    seq: u32,
    /// True for a key frame.
    key: bool,
}

/// Keeps the latest bytes.
#[derive(Default)]
pub struct Recent {
    receiver: Box<Receiver<LONGEST>>,
    /// Bytes of an incomplete frame.
    begun: Vec<u8>,
    /// Message of the last `Hello`.
    hello: Vec<u8>,
    /// Garment of the last `Hello`.
    garment: Vec<u8>,
    pieces: VecDeque<Piece>,
    held: usize,
    /// Time of the last image.
    newest: Micros,
    passed: Passed,
    /// Number of other boards that share the room.
    others: usize,
}

impl Recent {
    /// Of one of so many boards, which share the room.
    pub fn among(boards: usize) -> Recent {
        Recent { others: boards.saturating_sub(1), ..Recent::default() }
    }

    /// Handles bytes in any split.
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
                        // Earlier messages cannot be decoded with this garment.
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
        let most = BYTES / (1 + self.others);
        while self.pieces.front().is_some_and(|oldest| now - oldest.at > KEPT || self.held > most) {
            let gone = self.pieces.pop_front();
            self.held -= gone.map_or(0, |piece| piece.bytes.len());
        }
    }

    /// True if there is a key frame, and so a recording.
    pub fn is_readable(&self) -> bool {
        self.pieces.iter().any(|piece| piece.key)
    }

    /// Time of the last image.
    pub fn newest(&self) -> Micros {
        self.newest
    }

    /// Returns a `Hello` and everything from the first key frame on; none before the first.
    pub fn recording(&self) -> Option<Vec<u8>> {
        let first = self.pieces.iter().position(|piece| piece.key)?;
        let seq = self.pieces.get(first)?.seq.wrapping_sub(1);
        let hello: Report<'_> = decode(&self.hello).ok()?;
        let mut room = vec![0; frame_bound(LONGEST)];
        // It gets the preceding number, so that nothing counts as lost.
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
    use taxel::client::{Client, Event};
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

    /// An image every 0.1 s; every tenth is a key frame.
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
        // The board restarts every eight seconds, with its clock.
        let mut seq = 1234;
        for image in (0..20).flat_map(|_| (1..=80).map(image)) {
            seq += 1;
            recent.push(&sent(seq, &image));
        }
        let kept = recent.recording().unwrap().iter().filter(|byte| **byte == 0).count();
        assert!((300..=330).contains(&kept), "{kept}");
        // Another garment: earlier messages are discarded.
        recent.push(&sent(seq + 1, &hello(b"two")));
        assert!(recent.recording().is_none());
    }
}
