//! State shared by the threads of the boards of a recording.

use super::limit::Rotate;
use super::recorded_board::RecordedBoard;
use super::recording_files::RecordingFiles;
use crate::client::{Client, Event, RetainedState, Stamp, time_of};
use crate::error::Result;
use crate::recording;
use crate::text::progress::Progress;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Most board time between two chunks for sources faster than real time, us, so that readers can seek to any
/// second. A chunk of more than half of it ends before a key frame, so that the next one stands alone.
const CHUNK_US: u64 = 1_000_000;

/// A recording, for the threads of its boards: each fills its part, and what goes to the file are whole chunks, packed.
#[derive(Debug)]
pub struct Recording {
    /// The files.
    pub files: RecordingFiles,
    /// Boards of the recording.
    pub boards: Vec<Mutex<RecordedBoard>>,
    /// The progress on the terminal.
    pub shown: Mutex<Progress>,
}

impl Recording {
    /// Locks what is recorded of a board. A panic of another thread does not poison it.
    pub fn lock(&self, board: usize) -> MutexGuard<'_, RecordedBoard> {
        self.boards[board].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The progress on the terminal.
    pub fn shown(&self) -> MutexGuard<'_, Progress> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows how far it is, by one of its boards.
    pub fn show(&self, board: &RecordedBoard) {
        let line = || {
            let (path, _, bytes) = self.files.summary();
            let boards = match self.boards.len() {
                1 => format!("{} frames", board.counters.frames),
                count => format!("{count} boards"),
            };
            format!("{}: {boards}, {:.2} MB", path.display(), bytes as f64 / 1e6)
        };
        self.shown().show(board.counters.board_us(), line);
    }

    /// Returns when to continue in another file.
    pub(crate) fn rotates(&self) -> Option<Rotate> {
        self.files.rotates()
    }

    /// Ends the recording on an error.
    pub fn guard<T>(&self, done: Result<T>) -> Result<T> {
        done.map_err(|error| match self.files.is_over() {
            true => error,
            false => {
                self.shown().clear();
                self.files.fail(error)
            }
        })
    }

    /// Records an event of a board. An error ends the recording.
    pub fn take(&self, board: usize, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let mut board = self.lock(board);
        self.guard(self.add(&mut board, client, event, stamp))
    }

    /// Adds an event. What is ready goes to the files.
    fn add(&self, board: &mut RecordedBoard, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let files = &self.files;
        retain(&mut board.retained, client, event);
        board.is_timed |= time_of(client, event).is_some();
        self.rotate(board, client, event, stamp)?;
        board.counters.take(client, event, board.is_timed.then_some(stamp));
        if *event == Event::Hello {
            files.stay(board);
            if client.description() != board.description.as_ref() {
                board.description = client.description().cloned();
                self.attach(board, client.line(), stamp)?;
            }
        }
        let is_key = matches!(event, Event::Frame { alone: true, .. });
        let most = if is_key { CHUNK_US / 2 } else { CHUNK_US };
        if stamp.board_us.abs_diff(board.chunk_us) >= most {
            board.chunk_us = stamp.board_us;
            board.part.close();
            files.close(board)?;
        }
        board.part.put(|messages| messages.frames(client, stamp))?;
        board.part.event(client, event, stamp)?;
        if matches!(event, Event::Other { .. }) && files.rotates().is_some() {
            // A file is of one board: the `Hello` of this one follows.
            (board.retained, board.description) = (RetainedState::default(), None);
            self.go_on(board)?;
        }
        match event {
            Event::Lost { .. } => files.leave(board),
            _ if board.part.is_ready() => files.write(board),
            _ => Ok(()),
        }
    }

    /// Continues in another file when due. It begins with a key frame, so that the file stands alone: with the one
    /// next to the requested time, or the first one after another board has begun a file.
    fn rotate(&self, board: &mut RecordedBoard, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        let files = &self.files;
        let Some(limit) = files.rotates() else { return Ok(()) };
        let is_key = matches!(event, Event::Frame { alone: true, .. });
        if !is_key && !files.has_ended(board.file) {
            return Ok(());
        }
        if is_key && !files.is_behind(board) {
            let passed = board.counters.passed_until(stamp);
            let since_key = passed - std::mem::replace(&mut board.key_us, passed);
            let is_due = match limit {
                Rotate::After(time) => passed.saturating_add(since_key / 2) >= time.as_micros() as u64,
                Rotate::Bytes(bytes) => files.bytes(board.file) >= bytes,
            };
            if !is_due {
                return Ok(());
            }
        }
        self.go_on(board)?;
        if let Some(hello) = board.retained.hello() {
            self.attach(board, &hello, stamp)?;
        }
        // The host's own events have no frame that these could precede.
        let Some(line) = client.lines().next() else { return Ok(()) };
        let lasting = board.retained.lasting();
        // Numbered so that this event's follows them.
        let first = recording::sequence(line)?.wrapping_sub(lasting.len() as u32);
        for (frame, number) in lasting.iter().zip(0u32..) {
            let frame = recording::renumbered(frame, first.wrapping_add(number))?;
            board.part.put(|messages| messages.wire(stamp, &frame))?;
        }
        Ok(())
    }

    /// Continues in another file.
    fn go_on(&self, board: &mut RecordedBoard) -> Result<()> {
        board.part.close();
        self.files.go_on(board)?;
        board.counters.next_file();
        board.key_us = 0;
        Ok(())
    }

    /// Describes the board in its file.
    fn attach(&self, board: &mut RecordedBoard, hello: &[u8], stamp: Stamp) -> Result<()> {
        let RecordedBoard { description: Some(description), origin, part, file, .. } = board else {
            return Ok(());
        };
        self.files.attach(*file, part, |file, part| file.attach(part, description, hello, origin, stamp))
    }
}

/// Retains what an event's frames of the wire say that lasts. Those of most events say only what is now.
fn retain(retained: &mut RetainedState, client: &Client, event: &Event) {
    let is_of_now = matches!(
        event,
        Event::Frame { .. }
            | Event::Raw { .. }
            | Event::Contacts { .. }
            | Event::Symbols(_)
            | Event::Intent(_)
            | Event::Pressing(_)
            | Event::Folds(_)
    );
    if !is_of_now || client.lines().nth(1).is_some() {
        client.lines().for_each(|line| retained.take_frame(line));
    }
}
