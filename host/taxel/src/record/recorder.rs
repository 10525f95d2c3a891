//! Records a board, or all boards of a robot, file after file.

use super::board_recorder::BoardRecorder;
use super::names;
use super::plan::Plan;
use super::recorded_board::RecordedBoard;
use super::recording::Recording;
use super::recording_files::RecordingFiles;
use super::robot_topic::RobotTopic;
use crate::error::Result;
use crate::text::progress::{Progress, Unit};
use serde::Serialize;
use std::fmt::Write;
use std::sync::{Arc, Mutex};

/// A recording in progress. Its boards' parts are filled by [observers](Recorder::board), each in the thread of its
/// board, which writes them, too: whoever follows many boards waits for none of them.
#[derive(Debug)]
pub struct Recorder {
    shared: Arc<Recording>,
}

impl Recorder {
    /// Creates the first file. It gets its name once it is readable or, if it replaces another, once frames are in it.
    pub fn create(plan: Plan) -> Result<Recorder> {
        if plan.rotate.is_some() && !plan.force {
            names::are_free(&plan.path)?;
        }
        let (files, parts) = RecordingFiles::begin(plan)?;
        let boards = parts.into_iter().zip(&files.plan().boards).zip(0..);
        let boards = boards
            .map(|((part, planned), number)| RecordedBoard::new(number, part, planned.origin.clone()))
            .map(Mutex::new)
            .collect();
        let shown = Mutex::new(Progress::of("recording", Unit::BoardTime, None));
        Ok(Recorder { shared: Arc::new(Recording { files, boards, shown }) })
    }

    /// Sets the expected duration in board time.
    pub fn expect(&self, seconds: f64) {
        self.shared.shown().expect((seconds * 1e6) as u64);
    }

    /// Records the board of this number. Panics if there is none.
    pub fn board(&self, number: usize) -> BoardRecorder {
        assert!(number < self.shared.boards.len(), "the plan has no board number {number}");
        BoardRecorder::new(self.shared.clone(), number)
    }

    /// True once nothing is recorded any longer, because it is finished or has failed.
    pub fn is_over(&self) -> bool {
        self.shared.files.is_over()
    }

    /// Adds a topic about the robot as a whole, `/taxel/NAME`, whose messages are JSON of this schema. On error the
    /// recording ends: what was recorded before stays, and the file is completed.
    pub fn topic(&self, name: &str, schema: &str) -> Result<RobotTopic> {
        self.shared.guard(self.shared.files.topic(name, schema))
    }

    /// Writes a message of such a topic, at a host time, us. Error as of [`Recorder::topic`].
    pub fn line(&self, topic: RobotTopic, host_us: u64, line: &impl Serialize) -> Result<()> {
        self.shared.guard(self.shared.files.line(topic, host_us, line))
    }

    /// Writes the end of the files, unless written already.
    pub fn finish(&self) -> Result<()> {
        let mut done = Ok(());
        for number in 0..self.shared.boards.len() {
            done = done.and(self.shared.files.leave(&mut self.shared.lock(number)));
        }
        self.shared.shown().clear();
        let done = self.shared.guard(done);
        done.and(self.shared.files.finish())
    }

    /// Returns what has been recorded: a line for a board alone, a line for each board of a robot and one for the
    /// file.
    pub fn summary(&self) -> String {
        let files = &self.shared.files;
        let (path, count, bytes) = files.summary();
        let megabytes = bytes as f64 / 1e6;
        let several = if count > 1 { format!(", {count} files") } else { String::new() };
        let names = files.plan().boards.iter().map(|board| board.name.as_deref());
        let wide = names.clone().flatten().map(str::len).max().unwrap_or(0);
        let mut text = String::new();
        for (number, name) in names.enumerate() {
            let mut board = self.shared.lock(number);
            if let Some(frames) = files.whole(&board) {
                board.counters.cut(frames);
            }
            let (counters, seconds) = (&board.counters, board.counters.board_us() as f64 / 1e6);
            let [now, _] = counters.tally();
            let lost = format!("{} lost, {} thinned", now.lost, now.thinned);
            // Writing to a string cannot fail.
            let _ = match name {
                None => write!(
                    text,
                    "{}: {seconds:.1} s, {} frames, {megabytes:.2} MB, {lost}{several}",
                    path.display(),
                    counters.frames
                ),
                Some(name) => {
                    writeln!(text, "{name:wide$}  {seconds:.1} s, {} frames, {lost}", counters.frames)
                }
            };
        }
        if files.plan().robot.is_some() {
            let _ = write!(text, "{}: {megabytes:.2} MB{several}", path.display());
        }
        text
    }
}
