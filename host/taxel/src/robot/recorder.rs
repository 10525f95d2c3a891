//! One recording of all boards of a robot.
//!
//! An MCAP file like that of one board, with the topics of each board below its name: `/taxel/BOARD/wire`,
//! `/taxel/BOARD/frames` and so on, and attachments and metadata such as `BOARD/garment.toml`, `BOARD/taxel`,
//! `BOARD/counts`. `robot.toml` is attached; metadata `robot` has the robot's name and those of its boards.
//! If boards are sewn together, `/taxel/robot_contacts` has the robot's contacts;
//! [others](RobotRecorder::topic) may add topics about the robot. Log time is the host's time, which all boards
//! share.

use super::contact::RobotContact;
use super::contacts::RobotContacts;
use super::contacts_line::{ROBOT_CONTACTS, ROBOT_CONTACTS_SCHEMA, RobotContactsLine};
use super::event::Teller;
use super::file::ReadRobot;
use super::scan::{BoardScan, ScanReader};
use crate::client::clock::SteadyTime;
use crate::client::{Client, Event, Worn, request_name};
use crate::error::{Context, RecordingError, Result};
use crate::files::output::{Force, Output};
use crate::record::{COUNTS, Encoded, NS, Origin, RecordTopic, Stamp, Tally, Topics, attach};
use crate::recording::{Format, HELLO, Writer, attachment_of};
use crate::source::Source;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time between two chunks: the loss by a kill, plus as much again for the disk to write it.
const CHUNK: Duration = Duration::from_millis(500);
/// Most time of a board between two chunks, us, so that readers can seek to any second.
const CHUNK_US: u64 = 1_000_000;

/// What a recording holds of an event of a board.
#[derive(Debug, Default)]
pub struct BoardRecord {
    messages: Vec<Encoded>,
    /// The board's description, if it is new, and the frame of its `Hello`.
    described: Option<Box<Described>>,
    tally: Tally,
    /// The scan that it is about.
    pub scan: Option<BoardScan>,
    /// Why the board refuses a request.
    pub refusal: Option<String>,
}

#[derive(Debug)]
struct Described {
    worn: Worn,
    hello: Vec<u8>,
    origin: Origin,
}

/// Encodes a board's events for a recording.
#[derive(Debug)]
pub struct RecordTeller {
    origin: Origin,
    worn: Option<Worn>,
    reader: ScanReader,
}

impl RecordTeller {
    /// Of a board of a robot.
    pub fn new(robot: &ReadRobot, board: usize) -> RecordTeller {
        let calibration = robot.boards.get(board).and_then(|board| board.calibration.clone());
        let origin = Origin { calibration, ..Origin::default() };
        RecordTeller { origin, worn: None, reader: ScanReader::new(robot, board) }
    }
}

impl Teller<BoardRecord> for RecordTeller {
    fn opened(&mut self, source: &Source) {
        self.origin.label.clone_from(&source.label);
        self.origin.counts_per_newton = source.counts_per_newton;
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<BoardRecord>> {
        let mut messages: Vec<Encoded> = Encoded::frames(client, stamp).collect();
        messages.extend(Encoded::event(client, event, stamp)?);
        let mut described = None;
        if *event == Event::Hello && client.worn() != self.worn.as_ref() {
            self.worn = client.worn().cloned();
            described = self.worn.clone().map(|worn| {
                let (hello, origin) = (client.line().to_vec(), self.origin.clone());
                Box::new(Described { worn, hello, origin })
            });
        }
        let scan = self.reader.scan(client, event);
        let refusal = match event {
            Event::Answer { request, refusal: Some(why) } => {
                Some(format!("the board refuses {}: {why}", request_name(*request)))
            }
            _ => None,
        };
        Ok(Some(BoardRecord { messages, described, tally: Tally::of(client.counts()), scan, refusal }))
    }

    fn note(&mut self, client: &Client, note: &Event, stamp: Stamp) -> Result<Option<BoardRecord>> {
        let messages = Encoded::event(client, note, stamp)?.into_iter().collect();
        Ok(Some(BoardRecord { messages, tally: Tally::of(client.counts()), ..BoardRecord::default() }))
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<Option<BoardRecord>> {
        let messages = Encoded::requests(client, bytes, stamp)?;
        Ok(Some(BoardRecord { messages, tally: Tally::of(client.counts()), ..BoardRecord::default() }))
    }
}

/// A recording of a robot in progress.
#[derive(Debug)]
pub struct RobotRecorder {
    path: PathBuf,
    writer: Option<Writer<File>>,
    boards: Vec<RecordedBoard>,
    robot: ReadRobot,
    contacts: RobotContacts,
    /// Topic of the robot's contacts; none if no boards are sewn together.
    joined: Option<RobotTopic>,
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

/// What is recorded of a board.
#[derive(Debug)]
struct RecordedBoard {
    name: String,
    topics: Topics,
    says_what: bool,
    tally: Tally,
    /// Host time of its first message in the chunk, us.
    chunk_us: Option<u64>,
    /// Host times of its first and last image, us.
    frames_us: Option<[u64; 2]>,
}

impl RobotRecorder {
    /// Creates the file. It gets its name once it is readable.
    pub fn create(robot: &ReadRobot, path: &Path, force: Force) -> Result<RobotRecorder> {
        let inputs = robot.inputs.iter().map(PathBuf::from);
        let (file, begun) = Output::file(path, force, inputs)?.begin()?;
        let what = || format!("{} cannot be written", path.display());
        let mut writer = Writer::create(file, "").with_context(what)?;
        let mut boards = Vec::new();
        for board in &robot.boards {
            boards.push(RecordedBoard {
                topics: Topics::open(&mut writer, Some(&board.name)).with_context(what)?,
                name: board.name.clone(),
                says_what: false,
                tally: Tally::default(),
                chunk_us: None,
                frames_us: None,
            });
        }
        let sewn = (!robot.seams.is_empty())
            .then(|| RobotTopic::open(&mut writer, ROBOT_CONTACTS, ROBOT_CONTACTS_SCHEMA));
        let joined = sewn.transpose().with_context(what)?;
        let names: Vec<&str> = robot.boards.iter().map(|board| board.name.as_str()).collect();
        let words = [("name", robot.name.clone()), ("boards", names.join(","))];
        let words: BTreeMap<_, _> = words.map(|(name, value)| (name.to_string(), value)).into();
        writer.metadata("robot", words).with_context(what)?;
        let now = SteadyTime::start().now_us().saturating_mul(NS);
        writer.attach("robot.toml", "application/toml", robot.text.as_bytes(), now).with_context(what)?;
        begun.name()?;
        Ok(RobotRecorder {
            path: path.into(),
            writer: Some(writer),
            boards,
            robot: robot.clone(),
            contacts: RobotContacts::new(robot),
            joined,
            kept: Instant::now(),
            bytes: 0,
        })
    }

    /// Writes what is recorded of an event of a board. Returns the robot's contacts, if boards are sewn together and
    /// it tells anything new of them. On error the recording ends: what was recorded before stays, and the file is
    /// completed.
    pub fn take(&mut self, board: usize, record: &BoardRecord) -> Result<Vec<RobotContact>> {
        let done = self.write(board, record);
        self.guard(done)
    }

    /// A board is lost: its part in the robot's contacts is over. Result as of [`RobotRecorder::take`].
    pub fn lost(&mut self, board: usize, host_us: u64) -> Result<Vec<RobotContact>> {
        let contacts = self.contacts.forget(board, host_us);
        let done = self.write_contacts(host_us, &contacts);
        self.guard(done).map(|()| contacts)
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
        self.boards.iter_mut().for_each(|board| board.chunk_us = None);
        let done = self.writer.as_mut().map_or(Ok(()), Writer::flush);
        self.guard(done)
    }

    /// Writes the end of the file, unless written already.
    pub fn finish(&mut self) -> Result<()> {
        let Some(mut writer) = self.writer.take() else { return Ok(()) };
        let path = self.path.display().to_string();
        let incomplete = || format!("{path} could not be completed: `taxel info --repair` completes it");
        let mut counted = Ok(());
        for board in &self.boards {
            let words = board.tally.words(Tally::default());
            counted = counted.and(writer.metadata(&attachment_of(Some(&board.name), COUNTS), words));
        }
        let ended = writer.finish().map(|bytes| self.bytes = bytes);
        ended.and(counted).with_context(incomplete)
    }

    /// A line for each board: images, their time, losses; and the size of the file.
    pub fn summary(&self) -> String {
        let wide = self.boards.iter().map(|board| board.name.len()).max().unwrap_or(0);
        let mut text = String::new();
        for RecordedBoard { name, tally, frames_us, .. } in &self.boards {
            let seconds = frames_us.map_or(0.0, |[first, last]| last.saturating_sub(first) as f64 / 1e6);
            text += &format!(
                "{name:wide$}  {seconds:.1} s, {} frames, {} lost, {} thinned\n",
                tally.frames, tally.lost, tally.thinned
            );
        }
        let bytes = self.writer.as_ref().map_or(self.bytes, Writer::bytes);
        text + &format!("{}: {:.2} MB\n", self.path.display(), bytes as f64 / 1e6)
    }

    /// Writes the robot's contacts, if there are any.
    fn write_contacts(&mut self, host_us: u64, contacts: &[RobotContact]) -> Result<()> {
        let Some(topic) = self.joined.filter(|_| !contacts.is_empty()) else { return Ok(()) };
        write_line(&mut self.writer, topic, host_us, &RobotContactsLine::of(&self.robot, host_us, contacts))
    }

    fn write(&mut self, board: usize, record: &BoardRecord) -> Result<Vec<RobotContact>> {
        let (Some(writer), Some(recorded)) = (&mut self.writer, self.boards.get_mut(board)) else {
            return Ok(Vec::new());
        };
        recorded.tally = record.tally;
        if let Some(described) = &record.described {
            let Described { worn, hello, origin } = &**described;
            let ns = record.messages.first().map_or(0, |message| message.stamp.host_ns());
            if !std::mem::replace(&mut recorded.says_what, true) {
                let name = attachment_of(Some(&recorded.name), HELLO);
                writer.attach(&name, "application/octet-stream", hello, ns)?;
            }
            attach(writer, worn, origin, ns, Some(&recorded.name))?;
        }
        for Encoded { topic, stamp, bytes } in &record.messages {
            if *topic == RecordTopic::Json("frames") {
                let first = recorded.frames_us.map_or(stamp.host_us, |[first, _]| first);
                recorded.frames_us = Some([first, stamp.host_us]);
            }
            let Some(channel) = recorded.topics.channel(*topic) else { continue };
            writer.message(channel, stamp.host_ns(), stamp.board_ns(), bytes)?;
            recorded.chunk_us.get_or_insert(stamp.host_us);
        }
        let last = record.messages.last().map(|message| message.stamp.host_us);
        // By each board's own course: simulations run ahead of each other.
        if let Some((began, last)) = recorded.chunk_us.zip(last)
            && last.abs_diff(began) >= CHUNK_US
        {
            writer.close()?;
            self.boards.iter_mut().for_each(|board| board.chunk_us = None);
        }
        let stamp = record.messages.first().map(|message| message.stamp.host_us);
        let Some((scan, host_us)) = record.scan.as_ref().zip(stamp).filter(|_| self.joined.is_some()) else {
            return Ok(Vec::new());
        };
        let contacts = self.contacts.scan(board, scan, host_us);
        self.write_contacts(host_us, &contacts).map(|()| contacts)
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
