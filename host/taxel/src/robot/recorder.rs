//! One recording of all boards of a robot.
//!
//! An MCAP file like that of one board, with the topics of each board below its name: `/taxel/BOARD/wire`,
//! `/taxel/BOARD/frames` and so on, and attachments and metadata such as `BOARD/garment.toml`, `BOARD/taxel`,
//! `BOARD/counts`. `robot.toml` is attached; metadata `robot` has the robot's name and those of its boards.
//! [Topics](RobotRecorder::topic) about the robot may be added. Log time is the host's time, which all boards
//! share. Each board's messages are in chunks of their own: its thread fills them, and whoever reads one board by the
//! file's index need not unpack the others'.

use super::file::ReadRobot;
use super::record_teller::{BoardRecord, RecordTeller};
use super::recorded_board::SharedBoard;
use crate::client::clock::SteadyTime;
use crate::error::{Context, RecordingError, Result};
use crate::files::calibrate::Calibration;
use crate::files::output::{Begun, Force, Output};
use crate::record::{COUNTS, NS, Tally};
use crate::recording::{Format, Writer, attachment_of, scan};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time between two chunks: the loss by a kill, plus as much again for the disk to write it.
const CHUNK: Duration = Duration::from_millis(500);

/// A recording of a robot in progress.
#[derive(Debug)]
pub struct RobotRecorder {
    path: PathBuf,
    begun: Begun,
    writer: Option<Writer<File>>,
    boards: Vec<NamedBoard>,
    kept: Instant,
    /// Bytes of the file.
    bytes: u64,
}

/// A topic of a recording about the robot as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RobotTopic(u16);

impl RobotTopic {
    /// Declares `/taxel/NAME`, whose messages are JSON of this schema.
    fn open(writer: &mut Writer<File>, name: &str, schema: &str) -> Result<RobotTopic> {
        let title = format!("taxel.{name}");
        let format = Format { encoding: "json", schema: &title, schema_encoding: "jsonschema", text: schema };
        Ok(RobotTopic(writer.channel(&format!("/taxel/{name}"), &format)?))
    }
}

/// A board of the recording.
#[derive(Debug)]
struct NamedBoard {
    name: String,
    board: SharedBoard,
    calibration: Option<Calibration>,
    /// Its first description is attached.
    says_what: bool,
}

impl RobotRecorder {
    /// Creates the file. It gets its name once it is readable or, if it replaces another, once frames are in
    /// it.
    pub fn create(robot: &ReadRobot, path: &Path, force: Force) -> Result<RobotRecorder> {
        let inputs = robot.inputs.iter().map(PathBuf::from);
        let (file, mut begun) = Output::file(path, force, inputs)?.begin()?;
        let what = || format!("{} cannot be written", path.display());
        let mut writer = Writer::create(file, "").with_context(what)?;
        let mut boards = Vec::new();
        for board in &robot.boards {
            let shared = SharedBoard::open(&mut writer, &board.name).with_context(what)?;
            let (name, calibration) = (board.name.clone(), board.calibration.clone());
            boards.push(NamedBoard { name, board: shared, calibration, says_what: false });
        }
        let names: Vec<&str> = robot.boards.iter().map(|board| board.name.as_str()).collect();
        let words = [("name", robot.name.clone()), ("boards", names.join(","))];
        let words: BTreeMap<_, _> = words.map(|(name, value)| (name.to_string(), value)).into();
        writer.metadata("robot", words).with_context(what)?;
        let now = SteadyTime::start().now_us().saturating_mul(NS);
        writer.attach("robot.toml", "application/toml", robot.text.as_bytes(), now).with_context(what)?;
        begun.open()?;
        Ok(RobotRecorder {
            path: path.into(),
            begun,
            writer: Some(writer),
            boards,
            kept: Instant::now(),
            bytes: 0,
        })
    }

    /// Records the events of a board of the robot, in the board's thread. Panics if the robot has no board of this
    /// number.
    pub fn teller(&self, board: usize) -> RecordTeller {
        let NamedBoard { board, calibration, .. } = &self.boards[board];
        RecordTeller::new(board.clone(), calibration.clone())
    }

    /// Writes what the record of an event of a board makes ready. On error the recording ends: what was recorded
    /// before stays, and the file is completed.
    pub fn take(&mut self, board: usize, record: &BoardRecord) -> Result<()> {
        let done = if record.is_ready { self.write_filled(board) } else { Ok(()) };
        self.guard(done)
    }

    /// Adds a topic about the robot as a whole, `/taxel/NAME`, whose messages are JSON of this schema. Error as
    /// of [`RobotRecorder::take`].
    pub fn topic(&mut self, name: &str, schema: &str) -> Result<RobotTopic> {
        let Some(writer) = &mut self.writer else {
            fail!(RecordingError::Record, "{}: it has ended", self.path.display());
        };
        let opened = RobotTopic::open(writer, name, schema);
        self.guard(opened)
    }

    /// Writes a message of such a topic, at a host time, us. Error as of [`RobotRecorder::take`].
    pub fn line(&mut self, topic: RobotTopic, host_us: u64, line: &impl Serialize) -> Result<()> {
        let done = write_line(&mut self.writer, topic, host_us, line);
        self.guard(done)
    }

    /// Flushes to the disk what is due. Error as of [`RobotRecorder::take`].
    pub fn keep(&mut self) -> Result<()> {
        if self.kept.elapsed() < CHUNK {
            return Ok(());
        }
        self.kept = Instant::now();
        let written = self.write_all().and_then(|()| self.writer.as_mut().map_or(Ok(()), Writer::flush));
        let done = written.and_then(|()| if self.frames() > 0 { self.begun.name() } else { Ok(()) });
        self.guard(done)
    }

    /// Frames of all boards.
    fn frames(&self) -> u64 {
        self.boards.iter().map(|of| of.board.lock().tally.frames).sum()
    }

    /// Writes the end of the file, unless written already.
    pub fn finish(&mut self) -> Result<()> {
        let written = self.write_all();
        let Some(mut writer) = self.writer.take() else { return Ok(()) };
        let path = self.path.display().to_string();
        let incomplete = || format!("{path} could not be completed: `taxel info --repair` completes it");
        let mut counted = Ok(());
        for NamedBoard { name, board, .. } in &self.boards {
            let words = board.lock().tally.words(Tally::default());
            counted = counted.and(writer.metadata(&attachment_of(Some(name), COUNTS), words));
        }
        let ended = writer.finish().map(|bytes| self.bytes = bytes);
        self.begun.end(self.frames() == 0)?;
        written.and(ended).and(counted).with_context(incomplete)
    }

    /// A line for each board: images, their time, losses; and the size of the file.
    pub fn summary(&self) -> String {
        let wide = self.boards.iter().map(|board| board.name.len()).max().unwrap_or(0);
        let mut text = String::new();
        for NamedBoard { name, board, .. } in &self.boards {
            let (tally, frames_us) = {
                let board = board.lock();
                (board.tally, board.frames_us)
            };
            let seconds = frames_us.map_or(0.0, |[first, last]| last.saturating_sub(first) as f64 / 1e6);
            text += &format!(
                "{name:wide$}  {seconds:.1} s, {} frames, {} lost, {} thinned\n",
                tally.frames, tally.lost, tally.thinned
            );
        }
        let bytes = self.writer.as_ref().map_or(self.bytes, Writer::bytes);
        text + &format!("{}: {:.2} MB\n", self.path.display(), bytes as f64 / 1e6)
    }

    /// Ends the chunks of all boards, and writes them.
    fn write_all(&mut self) -> Result<()> {
        (0..self.boards.len()).try_for_each(|board| {
            self.boards[board].board.lock().end_chunk();
            self.write_filled(board)
        })
    }

    /// Writes what is ready of a board.
    fn write_filled(&mut self, board: usize) -> Result<()> {
        let Some(NamedBoard { name, board, says_what, .. }) = self.boards.get_mut(board) else {
            return Ok(());
        };
        // The board's thread does not wait for the disk.
        let filled = board.lock().take();
        self.writer.as_mut().map_or(Ok(()), |writer| filled.write(writer, name, says_what))
    }

    /// Ends the recording on a write error.
    fn guard<T>(&mut self, done: Result<T>) -> Result<T> {
        let error = match done {
            Ok(done) => return Ok(done),
            Err(error) => error,
        };
        // The first of two errors is reported.
        let kept = match self.writer.take().map(Writer::finish) {
            Some(Ok(bytes)) => {
                self.bytes = bytes;
                "what was recorded before is whole"
            }
            _ => "its end is missing: `taxel info --repair` completes it",
        };
        let found = scan(self.begun.path());
        let has_frames = |of: &NamedBoard| {
            let topic = format!("/taxel/{}/frames", of.name);
            found.as_ref().is_ok_and(|scan| scan.contents.messages(&topic) > 0)
        };
        let named = self.begun.end(!self.boards.iter().any(has_frames));
        let kept = named.map_or_else(|why| why.to_string(), |()| kept.into());
        Err(error).with_context(|| format!("{} cannot be written, {kept}", self.path.display()))
    }
}

/// Writes a message about the robot, unless the recording has ended.
fn write_line(
    writer: &mut Option<Writer<File>>,
    topic: RobotTopic,
    host_us: u64,
    line: &impl Serialize,
) -> Result<()> {
    let Some(writer) = writer else { return Ok(()) };
    let ns = host_us.saturating_mul(NS);
    writer.message(topic.0, ns, ns, &serde_json::to_vec(line)?)
}
