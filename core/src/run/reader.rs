//! Bytes of the link on their way to the board. What the board does not take yet waits here, and behind it in
//! the link's ring.

use super::{Link, Platform};
use crate::board::{Board, Input};

/// Bytes that are taken from the link at a time.
const PIECE: usize = 64;
/// Pieces and messages that are taken in one round of the loop, so that a host that sends without end keeps
/// nothing from being scanned: more than the longest request, and more than any host has to say in a frame.
const PIECES: u8 = 64;
const MESSAGES: u8 = 32;
/// Ends each message.
const END: u8 = 0;

/// Hands bytes over, message by message.
pub(super) struct Reader {
    bytes: [u8; PIECE],
    /// Those that the board has not taken yet.
    from: usize,
    to: usize,
}

impl Reader {
    pub const fn new() -> Reader {
        Reader { bytes: [0; PIECE], from: 0, to: 0 }
    }

    /// Takes the bytes that have come, as far as the board takes them and the bounds of a round go.
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

    /// The end of a message alone, else all up to the next one.
    fn piece(&self) -> &[u8] {
        let rest = self.rest();
        let length = rest.iter().position(|byte| *byte == END).unwrap_or(rest.len());
        rest.get(..length.max(1)).unwrap_or(rest)
    }
}
