//! Hands received bytes to the board. Bytes that the board does not accept yet wait here, those after them in
//! the link's ring.

use super::services::{Link, Platform};
use crate::board::{Board, Input};

/// Most bytes read from the link at a time.
const PIECE: usize = 64;
/// Most pieces and messages handed over per round of the loop, so that a host that sends without pause does
/// not stop the scan. Enough for the longest request, and for more than any host has to send in a frame.
const PIECES: u8 = 64;
const MESSAGES: u8 = 32;
/// Last byte of each message.
const END: u8 = 0;

/// Splits received bytes at message ends and hands them to the board.
pub(super) struct Reader {
    bytes: [u8; PIECE],
    /// `bytes[from..to]` have not been handed over yet.
    from: usize,
    to: usize,
}

impl Reader {
    pub const fn new() -> Reader {
        Reader { bytes: [0; PIECE], from: 0, to: 0 }
    }

    /// Hands received bytes to the board until none is left, the board accepts no message, or the round's
    /// limits are reached.
    pub fn receive<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        link: &mut impl Link,
        platform: &mut impl Platform,
        board: &mut Board<TAXELS, RUNS, PARTS>,
    ) {
        let mut messages = MESSAGES;
        for _ in 0..PIECES {
            if self.rest().is_empty() {
                (self.from, self.to) = (0, link.try_read(&mut self.bytes).min(PIECE));
            }
            while let Some(first) = self.rest().first() {
                let now = platform.now();
                if *first == END {
                    if messages == 0 || !board.takes_message(now) {
                        return;
                    }
                    messages -= 1;
                }
                let piece = self.piece();
                let length = piece.len();
                board.step(now, Input::Received(piece), platform);
                self.from += length;
            }
            if self.to == 0 {
                return;
            }
        }
    }

    fn rest(&self) -> &[u8] {
        self.bytes.get(self.from..self.to).unwrap_or(&[])
    }

    /// The end byte of a message alone, or else all bytes before the next one.
    fn piece(&self) -> &[u8] {
        let rest = self.rest();
        let length = rest.iter().position(|byte| *byte == END).unwrap_or(rest.len());
        rest.get(..length.max(1)).unwrap_or(rest)
    }
}
