//! One file of a recording, and the one of ROS 2 messages beside it.

use super::board_messages::BoardMessages;
use super::provenance::{self, Origin};
use super::ros2_messages::{Ros2File, Ros2Messages};
use super::topics::Topics;
use crate::body::ReadBody;
use crate::client::{BoardDescription, Client, Event, Stamp};
use crate::error::Result;
use crate::recording::{HELLO, Store, Writer, attachment_of};

/// A file of a recording.
#[derive(Debug)]
pub struct RecordingFile<S: Store> {
    /// Writer of the file.
    pub writer: Writer<S>,
    /// The file beside it; none without ROS 2 messages.
    ros2: Option<Ros2File<S>>,
}

impl<S: Store> RecordingFile<S> {
    /// Creates a file, and another one beside it.
    pub fn create(store: S, ros2: Option<S>) -> Result<RecordingFile<S>> {
        let writer = Writer::create(store, "")?;
        Ok(RecordingFile { writer, ros2: ros2.map(Ros2File::create).transpose()? })
    }

    /// Declares the topics of a board: of the only one, or of this one of a robot, whose garment lies on this body.
    pub fn board(&mut self, name: Option<&str>, body: Option<&ReadBody>) -> Result<BoardPart> {
        let messages = BoardMessages::new(Topics::open(&mut self.writer, name)?);
        let ros2 = self.ros2.is_some().then(|| Ros2Messages::new(name, body.cloned()));
        Ok(BoardPart { name: name.map(String::from), messages, ros2, says_what: false })
    }

    /// Attaches a board's `Hello`, its frame of the wire, and the origin of its stream.
    pub fn attach(
        &mut self,
        part: &mut BoardPart,
        description: &BoardDescription,
        hello: &[u8],
        origin: &Origin,
        stamp: Stamp,
    ) -> Result<()> {
        let (ns, name) = (stamp.host_ns(), part.name.as_deref());
        if !std::mem::replace(&mut part.says_what, true) {
            self.writer.attach(&attachment_of(name, HELLO), "application/octet-stream", hello, ns)?;
        }
        provenance::attach(&mut self.writer, description, origin, ns, name)
    }

    /// Writes the chunks of a board that are filled.
    pub fn write(&mut self, part: &mut BoardPart) -> Result<()> {
        let ros2 = match (&mut self.ros2, &mut part.ros2) {
            (Some(file), Some(ros2)) => file.write(ros2),
            _ => Ok(()),
        };
        self.writer.write(part.messages.take()).and(ros2)
    }

    /// Ends the chunk of the ROS 2 messages: readers can seek to the next one.
    pub fn close(&mut self) -> Result<()> {
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.close())
    }

    /// Flushes everything written so far to the disk.
    pub fn flush(&mut self) -> Result<()> {
        self.writer.flush()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.flush())
    }

    /// Bytes written so far.
    pub fn bytes(&self) -> u64 {
        self.writer.bytes() + self.ros2.as_ref().map_or(0, |ros2| ros2.writer.bytes())
    }

    /// Writes the end of both files, even if one fails. Returns their bytes.
    pub fn finish(self) -> Result<u64> {
        let beside = self.ros2.map_or(Ok(0), |ros2| ros2.writer.finish());
        let bytes = self.writer.finish()?;
        Ok(bytes + beside?)
    }
}

/// A board's part of a file: its topics, and the chunks that it fills. It needs the file only to write these.
#[derive(Debug)]
pub struct BoardPart {
    name: Option<String>,
    messages: BoardMessages,
    ros2: Option<Ros2Messages>,
    /// The board's description is attached.
    says_what: bool,
}

impl BoardPart {
    /// Adds messages.
    pub fn put(&mut self, add: impl FnOnce(&mut BoardMessages) -> Result<()>) -> Result<()> {
        add(&mut self.messages)
    }

    /// Adds an event as JSON and, if requested, as ROS 2 messages.
    pub fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.event(client, event, stamp))?;
        self.messages.event(client, event, stamp)
    }

    /// Ends the chunk: readers can seek to the next one.
    pub fn close(&mut self) {
        self.messages.close();
    }

    /// True if anything is ready to be written: the board need not wait for the file before.
    pub fn is_ready(&self) -> bool {
        self.messages.is_ready() || self.ros2.as_ref().is_some_and(Ros2Messages::is_ready)
    }
}
