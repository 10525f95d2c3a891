//! Records a board, in its thread.

use super::recording::Recording;
use super::recording_files::CHUNK;
use crate::client::{Client, Event, Stamp};
use crate::error::Result;
use crate::session::{JointPositions, Observer};
use crate::source::Source;
use crate::source::array::OriginalBytes;
use crate::time::Instant;
use std::sync::Arc;

/// Records the stream of a board into its part of a recording. A write error ends the recording and all its boards'
/// streams: earlier data stays, and the file is completed.
#[derive(Debug, Clone)]
pub struct BoardRecorder {
    recording: Arc<Recording>,
    board: usize,
}

impl BoardRecorder {
    /// Makes the recorder of the board of this number.
    pub(super) fn new(recording: Arc<Recording>, board: usize) -> BoardRecorder {
        BoardRecorder { recording, board }
    }
}

impl Observer for BoardRecorder {
    fn opened(&mut self, source: &Source) -> Result<()> {
        let mut board = self.recording.lock(self.board);
        board.origin.label.clone_from(&source.label);
        board.origin.scale = source.scale.with(board.origin.scale.calibration());
        board.is_real_time = source.real_time;
        Ok(())
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        if event.remark().is_some() {
            // Whoever prints it begins on a line of its own.
            self.recording.shown().clear();
        }
        self.recording.take(self.board, client, event, stamp)
    }

    fn sent(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<()> {
        let mut board = self.recording.lock(self.board);
        self.recording.guard(board.part.put(|messages| messages.requests(client, bytes, stamp)))
    }

    fn original(&mut self, _: &Client, bytes: &OriginalBytes, stamp: Stamp) -> Result<()> {
        let mut board = self.recording.lock(self.board);
        self.recording.guard(board.part.put(|messages| messages.original(bytes, stamp)))
    }

    fn joints(&mut self, _: &Client, joints: &JointPositions, stamp: Stamp) -> Result<()> {
        let mut board = self.recording.lock(self.board);
        self.recording.guard(board.part.put(|messages| messages.joints(joints, stamp)))
    }

    fn idle(&mut self, _: &mut Client) -> Result<()> {
        let mut board = self.recording.lock(self.board);
        if board.kept.elapsed() < CHUNK {
            return Ok(());
        }
        board.kept = Instant::now();
        self.recording.guard(self.recording.files.keep(&mut board))?;
        self.recording.show(&board);
        Ok(())
    }

    fn ended(&mut self, _: &Client, _: Stamp) -> Result<()> {
        let mut board = self.recording.lock(self.board);
        self.recording.guard(self.recording.files.leave(&mut board))
    }

    fn is_done(&self) -> bool {
        self.recording.files.is_over()
    }

    /// True if another file follows.
    fn follows_another(&self) -> bool {
        self.recording.rotates().is_some()
    }
}
