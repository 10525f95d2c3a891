//! What is recorded of a board.

use super::counters::Counters;
use super::file::BoardPart;
use super::provenance::Origin;
use crate::client::{RetainedState, Worn};
use std::time::Instant;

/// What is recorded of a board.
#[derive(Debug)]
pub struct RecordedBoard {
    /// Its number.
    pub board: usize,
    /// Number of the file in which its messages are.
    pub file: u32,
    /// Its messages that are not written yet.
    pub part: BoardPart,
    /// Where its stream comes from.
    pub origin: Origin,
    /// It runs in real time, as all others do that do so.
    pub is_real_time: bool,
    /// What has been recorded so far.
    pub counters: Counters,
    /// When its chunk was ended last, so that a kill loses no more.
    pub kept: Instant,
    /// What a file that continues another begins with.
    pub retained: RetainedState,
    /// What it wears, as its file describes it.
    pub worn: Option<Worn>,
    /// It has told its time.
    pub is_timed: bool,
    /// Its time since the file began at the last key frame, us.
    pub key_us: u64,
    /// Its time at the start of the chunk, us.
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
            worn: None,
            is_timed: false,
            key_us: 0,
            chunk_us: 0,
        }
    }
}
