//! The files of a recording, shared by the threads of its boards.

use super::file::{BoardPart, RecordingFile};
use super::limit::Rotate;
use super::names::{beside, numbered};
use super::plan::Plan;
use super::recorded_board::RecordedBoard;
use super::robot_topic::RobotTopic;
use super::tally::COUNTS;
use crate::client::NS;
use crate::client::clock::SteadyTime;
use crate::error::{Context, Error, RecordingError, Result};
use crate::files::output::{Begun, Force, Output};
use crate::recording::{attachment_of, of_board};
use crate::time::Instant;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Time between two flushes to the disk: the loss by a kill, plus as much again for the disk to write it.
pub const CHUNK: Duration = Duration::from_millis(500);
/// Most files that are open because boards keep to their own time.
const MOST: usize = 16;
/// Topic whose messages count as frames.
const FRAMES: &str = "/taxel/frames";

/// The files. Boards leave a file at a key frame, or when they are lost; it is complete once all have left it.
#[derive(Debug)]
pub struct RecordingFiles {
    plan: Plan,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    /// The files that are not complete, oldest first; none once the recording has ended.
    open: Vec<OpenRecording>,
    /// Number of the newest.
    number: u32,
    /// Topics about the robot, with their schemas: each file has them.
    topics: Vec<(String, String)>,
    kept: Instant,
    /// Files that are complete, and their bytes.
    ended: u32,
    bytes: u64,
    /// After an error: number of the last file, and the images of each board that are whole in it.
    whole: Option<(u32, Vec<u64>)>,
}

/// A file that is not complete.
#[derive(Debug)]
struct OpenRecording {
    number: u32,
    path: PathBuf,
    file: RecordingFile<File>,
    /// Names of the file and of the one beside it; those that replace others wait for frames.
    begun: Vec<Begun>,
    /// The parts of boards that are not in it yet.
    parts: Vec<Option<BoardPart>>,
    /// The boards that are in it.
    present: Vec<bool>,
    /// Frames of the board that has most in it.
    frames: u64,
    /// Counters of boards that have left it, as metadata.
    counts: BTreeMap<String, BTreeMap<String, String>>,
}

impl RecordingFiles {
    /// Begins the first file. Returns the boards' parts of it, too.
    pub fn begin(plan: Plan) -> Result<(RecordingFiles, Vec<BoardPart>)> {
        let mut first = OpenRecording::begin(&plan, 1, &[])?;
        let parts = first.parts.iter_mut().filter_map(Option::take).collect();
        let state = State {
            open: vec![first],
            number: 1,
            topics: Vec::new(),
            kept: Instant::now(),
            ended: 0,
            bytes: 0,
            whole: None,
        };
        Ok((RecordingFiles { plan, state: Mutex::new(state) }, parts))
    }

    /// Returns what is to be recorded.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Returns when to continue in another file.
    pub(crate) fn rotates(&self) -> Option<Rotate> {
        self.plan.rotate
    }

    /// True once nothing is written any longer.
    pub fn is_over(&self) -> bool {
        self.lock().open.is_empty()
    }

    /// True if the file of this number is complete.
    pub(crate) fn has_ended(&self, number: u32) -> bool {
        self.lock().open.iter().all(|open| open.number != number)
    }

    /// True if the board is to leave its file because others have. Boards that run in real time go together; simulations
    /// and recordings keep to their own time, as far as that leaves few files open.
    pub(crate) fn is_behind(&self, board: &RecordedBoard) -> bool {
        let state = self.lock();
        match board.is_real_time || state.open.len() >= MOST {
            true => state.number != board.file,
            false => false,
        }
    }

    /// Bytes of the file of this number.
    pub fn bytes(&self, number: u32) -> u64 {
        self.lock().file(number).map_or(0, |open| open.file.bytes())
    }

    /// Moves a board, whose chunk is ended, to a file after its own: to the newest if it runs in real time, else to the
    /// next. If there is none, it is begun.
    pub fn go_on(&self, board: &mut RecordedBoard) -> Result<()> {
        let mut state = self.lock();
        if state.open.is_empty() {
            return Ok(());
        }
        if state.number == board.file {
            let next = OpenRecording::begin(&self.plan, board.file + 1, &state.topics)?;
            state.number += 1;
            state.open.push(next);
        }
        state.leave(board, &self.plan)?;
        let is_newest = board.is_real_time || state.open.len() >= MOST;
        let mut after = state.open.iter_mut().filter(|open| open.number > board.file);
        if let Some(next) = if is_newest { after.next_back() } else { after.next() } {
            next.present[board.board] = true;
            board.file = next.number;
            if let Some(part) = next.parts[board.board].take() {
                let mut before = std::mem::replace(&mut board.part, part);
                // Of a file that has ended while the board was away: all files have the same channels.
                next.file.write(&mut before)?;
            }
        }
        state.end_left()
    }

    /// A board that was away is there again.
    pub fn stay(&self, board: &RecordedBoard) {
        if let Some(open) = self.lock().file(board.file) {
            open.present[board.board] = true;
        }
    }

    /// Writes what is ready of a board, which may stay away.
    pub fn leave(&self, board: &mut RecordedBoard) -> Result<()> {
        board.part.close();
        let mut state = self.lock();
        state.leave(board, &self.plan)?;
        state.end_left()
    }

    /// Writes what is ready of a board.
    pub fn write(&self, board: &mut RecordedBoard) -> Result<()> {
        self.lock().write(board)
    }

    /// Writes what is ready of a board, and ends the chunk of the file beside.
    pub fn close(&self, board: &mut RecordedBoard) -> Result<()> {
        let mut state = self.lock();
        state.write(board)?;
        state.file(board.file).map_or(Ok(()), |open| open.file.close())
    }

    /// Attaches something to a file.
    pub fn attach(
        &self,
        number: u32,
        part: &mut BoardPart,
        attach: impl FnOnce(&mut RecordingFile<File>, &mut BoardPart) -> Result<()>,
    ) -> Result<()> {
        self.lock().file(number).map_or(Ok(()), |open| attach(&mut open.file, part))
    }

    /// Writes what is ready of a board, and flushes the files to the disk if that is due.
    pub fn keep(&self, board: &mut RecordedBoard) -> Result<()> {
        board.part.close();
        let mut state = self.lock();
        state.write(board)?;
        if state.kept.elapsed() < CHUNK {
            return Ok(());
        }
        state.kept = Instant::now();
        for open in &mut state.open {
            open.file.flush()?;
            if open.frames > 0 {
                open.name()?;
            }
        }
        Ok(())
    }

    /// Adds a topic about the robot as a whole, `/taxel/NAME`, whose messages are JSON of this schema.
    pub fn topic(&self, name: &str, schema: &str) -> Result<RobotTopic> {
        let mut state = self.lock();
        state.topics.push((name.into(), schema.into()));
        let mut opened = None;
        for open in &mut state.open {
            opened = Some(RobotTopic::open(&mut open.file.writer, name, schema)?);
        }
        match opened {
            Some(topic) => Ok(topic),
            None => fail!(RecordingError::Record, "{}: it has ended", self.plan.path.display()),
        }
    }

    /// Writes a message of such a topic, at a host time, us, unless the recording has ended.
    pub fn line(&self, topic: RobotTopic, host_us: u64, line: &impl Serialize) -> Result<()> {
        let mut state = self.lock();
        let Some(newest) = state.open.last_mut() else { return Ok(()) };
        topic.write(&mut newest.file.writer, host_us, line)
    }

    /// Writes the ends of the files, unless written already. Each board has left its file.
    pub fn finish(&self) -> Result<()> {
        let mut state = self.lock();
        let mut done = Ok(());
        for open in std::mem::take(&mut state.open) {
            done = done.and(state.end(open));
        }
        done
    }

    /// Ends the recording after an error, to which this adds what is kept: earlier data stays, and the files are
    /// completed.
    pub fn fail(&self, error: Error) -> Error {
        let mut state = self.lock();
        let mut path = self.plan.path.clone();
        let mut kept = "what was recorded before is whole".to_string();
        for mut open in std::mem::take(&mut state.open) {
            path.clone_from(&open.path);
            // The last messages are lost in any case; the file itself shows whether it is complete.
            let _ = open.file.finish();
            let file = open.begun.first().map_or(&*open.path, Begun::path);
            let scan = crate::recording::scan(file).ok();
            state.bytes += std::fs::metadata(file).map_or(0, |known| known.len());
            state.ended += 1;
            let frames = self.plan.boards.iter().map(|board| {
                let topic = of_board(board.name.as_deref(), FRAMES);
                scan.as_ref().map_or(0, |scan| scan.contents.messages(&topic))
            });
            let frames: Vec<u64> = frames.collect();
            let is_empty = frames.iter().all(|count| *count == 0);
            let named = open.begun.iter_mut().try_for_each(|begun| begun.end(is_empty));
            let is_whole = scan.is_some_and(|scan| scan.whole);
            state.whole = Some((open.number, if is_whole { frames } else { vec![0; frames.len()] }));
            kept = match named {
                Err(why) => why.to_string(),
                Ok(()) if is_whole => kept,
                Ok(()) => incomplete(&open.path),
            };
        }
        error.context(format!("{} cannot be written, {kept}", path.display()))
    }

    /// After an error, images of a board in the file of this number that are whole.
    pub fn whole(&self, board: &RecordedBoard) -> Option<u64> {
        let state = self.lock();
        let (number, frames) = state.whole.as_ref()?;
        Some(if *number == board.file { *frames.get(board.board)? } else { 0 })
    }

    /// Path of the newest file, number of files and bytes of all.
    pub fn summary(&self) -> (PathBuf, u32, u64) {
        let state = self.lock();
        let bytes: u64 = state.open.iter().map(|open| open.file.bytes()).sum();
        (numbered(&self.plan.path, state.number), state.ended, state.bytes + bytes)
    }

    /// The files. A panic of another thread does not poison them.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn file(&mut self, number: u32) -> Option<&mut OpenRecording> {
        self.open.iter_mut().find(|open| open.number == number)
    }

    fn write(&mut self, board: &mut RecordedBoard) -> Result<()> {
        let Some(open) = self.file(board.file) else { return Ok(()) };
        open.frames = open.frames.max(board.counters.file_frames());
        open.file.write(&mut board.part)
    }

    /// Writes what is ready of a board, and its counters: no more comes of it, or not soon.
    fn leave(&mut self, board: &mut RecordedBoard, plan: &Plan) -> Result<()> {
        self.write(board)?;
        let [now, before] = board.counters.tally();
        let name = attachment_of(plan.boards[board.board].name.as_deref(), COUNTS);
        let Some(open) = self.file(board.file) else { return Ok(()) };
        open.present[board.board] = false;
        open.counts.insert(name, now.words(before));
        Ok(())
    }

    /// Ends the files that all boards have left and to which none can come, which are the oldest.
    fn end_left(&mut self) -> Result<()> {
        let mut done = Ok(());
        while self.open.len() > 1 && !self.open[0].present.contains(&true) {
            let open = self.open.remove(0);
            done = done.and(self.end(open));
        }
        done
    }

    /// Completes a file.
    fn end(&mut self, open: OpenRecording) -> Result<()> {
        let OpenRecording { path, mut file, mut begun, frames, counts, .. } = open;
        let counted = counts.into_iter().try_for_each(|(name, words)| file.writer.metadata(&name, words));
        let ended = file.finish().map(|bytes| self.bytes += bytes);
        self.ended += 1;
        begun.iter_mut().try_for_each(|begun| begun.end(frames == 0))?;
        ended.and(counted).with_context(|| incomplete(&path))
    }
}

impl OpenRecording {
    /// Creates a file, and the one beside it. They get their names once they are readable: a crash leaves what was
    /// written, and a failed start leaves no file of that name. Those that replace others get them later.
    fn begin(plan: &Plan, number: u32, topics: &[(String, String)]) -> Result<OpenRecording> {
        let path = numbered(&plan.path, number);
        let output = |path: &Path| Output::file(path, Force { force: plan.force }, &plan.inputs);
        let main = output(&path)?;
        let ros2 = plan.ros2.then(|| output(&beside(&path))?.begin()).transpose()?;
        let (ros2, ros2_begun) = ros2.unzip();
        let (main, begun) = main.begin()?;
        let mut begun: Vec<Begun> = [begun].into_iter().chain(ros2_begun).collect();
        let what = || format!("{} cannot be written", path.display());
        let mut file = RecordingFile::create(main, ros2).with_context(what)?;
        let parts = declare(&mut file, plan, topics).with_context(what)?;
        if let Err(error) = begun.iter_mut().try_for_each(Begun::open) {
            // The file that already has its name becomes an empty recording instead of half of one. The first
            // of two errors is reported.
            _ = file.finish();
            return Err(error);
        }
        let present = plan.boards.iter().map(|board| number == 1 && board.is_there).collect();
        let parts = parts.into_iter().map(Some).collect();
        Ok(OpenRecording { number, path, file, begun, parts, present, frames: 0, counts: BTreeMap::new() })
    }

    /// Gives the files their names.
    fn name(&mut self) -> Result<()> {
        self.begun.iter_mut().try_for_each(Begun::name)
    }
}

/// Declares all topics, and says whose recording it is. Returns the boards' parts.
fn declare(
    file: &mut RecordingFile<File>,
    plan: &Plan,
    topics: &[(String, String)],
) -> Result<Vec<BoardPart>> {
    let boards = plan.boards.iter();
    let parts = boards.map(|board| file.board(board.name.as_deref(), board.body.as_ref()));
    let parts: Vec<BoardPart> = parts.collect::<Result<_>>()?;
    for (name, schema) in topics {
        RobotTopic::open(&mut file.writer, name, schema)?;
    }
    if let Some(robot) = &plan.robot {
        let names: Vec<&str> = plan.boards.iter().filter_map(|board| board.name.as_deref()).collect();
        let words = [("name", robot.name.clone()), ("boards", names.join(","))];
        let words: BTreeMap<_, _> = words.map(|(name, value)| (name.to_string(), value)).into();
        file.writer.metadata("robot", words)?;
        let now = SteadyTime::start().now_us().saturating_mul(NS);
        file.writer.attach("robot.toml", "application/toml", robot.text.as_bytes(), now)?;
    }
    Ok(parts)
}

fn incomplete(path: &Path) -> String {
    format!("{} could not be completed: `taxel info --repair` completes it", path.display())
}
