//! Bytes of the last half minute.

use std::collections::VecDeque;
use taxel::client::passed::Passed;
use taxel::client::{Client, Event};
use taxel_core::format::Micros;
use taxel_core::wire::{Report, WireError, decode, encode, frame_bound, open};

/// Time for which bytes are kept, us of the board. Across restarts of the board's clock, time runs on.
const KEPT: u64 = 30_000_000;
/// Most bytes kept, whatever the clocks of the boards say.
const BYTES: usize = 64 << 20;

/// A message as a frame of the wire.
#[derive(Debug)]
struct Piece {
    /// Number of its bytes.
    length: usize,
    /// Elapsed board time, us.
    at: u64,
    /// True for a key frame.
    key: bool,
}

/// Keeps the latest bytes.
#[derive(Default)]
pub struct Recent {
    /// Frame of the last `Hello`.
    hello: Vec<u8>,
    /// Garment of the last `Hello`.
    garment: Vec<u8>,
    pieces: VecDeque<Piece>,
    /// Their bytes.
    bytes: VecDeque<u8>,
    /// Time of the last image.
    newest: Micros,
    passed: Passed,
    /// Number of other boards that share the room.
    others: usize,
}

impl Recent {
    /// Makes that of one of so many boards, which share the room.
    pub fn among(boards: usize) -> Recent {
        Recent { others: boards.saturating_sub(1), ..Recent::default() }
    }

    /// Keeps the bytes of an event, unless they were damaged.
    pub fn take(&mut self, client: &Client, event: &Event) {
        let key = match event {
            Event::Other { .. } => {
                // What is saved is of one board.
                self.pieces.clear();
                self.bytes.clear();
                return;
            }
            Event::Refused(_) => return,
            _ if client.is_own() => return,
            Event::Hello | Event::Unusable(_) => {
                self.greeted(client.line());
                false
            }
            Event::Frame { time, alone, .. } => {
                self.newest = *time;
                *alone
            }
            _ => false,
        };
        let at = self.passed.until(self.newest.0);
        for line in client.lines() {
            self.bytes.extend(line);
            self.pieces.push_back(Piece { length: line.len(), at, key: false });
        }
        // The event's own line is the last one.
        if let Some(piece) = self.pieces.back_mut() {
            piece.key = key;
        }
        self.forget(at);
    }

    /// Handles a `Hello`.
    fn greeted(&mut self, frame: &[u8]) {
        let mut bytes = frame.to_vec();
        let Ok((_, Report::Hello(hello))) = opened(&mut bytes) else { return };
        if self.garment != hello.garment {
            self.garment = hello.garment.to_vec();
            // Earlier messages cannot be decoded with this garment.
            self.pieces.clear();
            self.bytes.clear();
        }
        self.hello = frame.to_vec();
    }

    fn forget(&mut self, now: u64) {
        let most = BYTES / (1 + self.others);
        while let Some(gone) =
            self.pieces.pop_front_if(|oldest| now - oldest.at > KEPT || self.bytes.len() > most)
        {
            self.bytes.drain(..gone.length);
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
        let before: usize = self.pieces.range(..first).map(|piece| piece.length).sum();
        let length = self.pieces.get(first)?.length;
        let mut begin: Vec<u8> = self.bytes.range(before..before + length).copied().collect();
        let mut hello = self.hello.clone();
        let (seq, _) = opened(&mut begin).ok()?;
        let (_, hello) = opened(&mut hello).ok()?;
        let mut room = vec![0; frame_bound(self.hello.len())];
        // It gets the preceding number, so that nothing counts as lost.
        let mut frame = encode(&(seq.wrapping_sub(1), &hello), &mut room).ok()?.to_vec();
        frame.extend(self.bytes.range(before..));
        Some(frame)
    }
}

/// Number and content of the message of a frame of the wire with its 0x00.
fn opened(frame: &mut [u8]) -> Result<(u32, Report<'_>), WireError> {
    let end = frame.len().saturating_sub(1);
    decode(open(&mut frame[..end])?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::{Frame, Hello, MAGIC, PROTOCOL};

    fn sent(seq: u32, report: &Report<'_>) -> Vec<u8> {
        encode(&(seq, report), &mut vec![0; frame_bound(1000)]).unwrap().to_vec()
    }

    /// Keeps the events of these bytes.
    fn keep(recent: &mut Recent, client: &mut Client, mut bytes: &[u8]) {
        while !bytes.is_empty() {
            let (count, event) = client.push_all(bytes);
            event.iter().for_each(|event| recent.take(client, event));
            bytes = &bytes[count..];
        }
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
            chip: empty,
            boot: None,
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
        let (mut recent, mut board) = (Recent::default(), Client::new());
        assert!(recent.recording().is_none());
        let mut bytes = [b"noise\0".to_vec(), sent(0, &hello(b"one"))].concat();
        (1..=1234).for_each(|number| bytes.extend(sent(number, &image(number))));
        bytes.chunks(7).for_each(|part| keep(&mut recent, &mut board, part));
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
            keep(&mut recent, &mut board, &sent(seq, &image));
        }
        let kept = recent.recording().unwrap().iter().filter(|byte| **byte == 0).count();
        assert!((300..=330).contains(&kept), "{kept}");
        // Another garment: earlier messages are discarded.
        keep(&mut recent, &mut board, &sent(seq + 1, &hello(b"two")));
        assert!(recent.recording().is_none());
    }
}
