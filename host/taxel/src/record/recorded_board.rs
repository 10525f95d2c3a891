//! A board's part of a recording.

use super::counters::Counters;
use super::file::BoardPart;
use super::provenance::Origin;
use crate::client::{BoardDescription, RetainedState};
use crate::time::Instant;

/// State of a board's part of a recording.
#[derive(Debug)]
pub struct RecordedBoard {
    /// Number of the board.
    pub board: usize,
    /// Number of the file in which its messages are.
    pub file: u32,
    /// Messages that are not written yet.
    pub part: BoardPart,
    /// Origin of its stream.
    pub origin: Origin,
    /// True of a board in real time: it goes on to the next file with the others.
    pub is_real_time: bool,
    /// Counters over all files.
    pub counters: Counters,
    /// Time of the last end of a chunk: a kill loses no more.
    pub kept: Instant,
    /// Beginning of a file that continues another.
    pub retained: RetainedState,
    /// Garment and scene, as its file describes them.
    pub description: Option<BoardDescription>,
    /// True once it has sent its time.
    pub is_timed: bool,
    /// Time since the file began at the last key frame, us of the board.
    pub key_us: u64,
    /// Start of the chunk, us of the board.
    pub chunk_us: u64,
}

impl RecordedBoard {
    /// A board of which nothing is recorded yet, in the first file.
    pub fn new(board: usize, part: BoardPart, origin: Origin) -> RecordedBoard {
        RecordedBoard {
            board,
            file: 1,
            part,
            origin,
            is_real_time: true,
            counters: Counters::default(),
            kept: Instant::now(),
            retained: RetainedState::default(),
            description: None,
            is_timed: false,
            key_us: 0,
            chunk_us: 0,
        }
    }
}
