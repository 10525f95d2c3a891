//! One file of a recording: its channels, and the messages written to them.

use super::bag::Ros2;
use super::board_messages::BoardMessages;
use super::provenance::{self, Origin};
use super::stamps::Stamp;
use super::topics::Topics;
use crate::client::{Client, Event, Worn};
use crate::error::Result;
use crate::recording::{HELLO, Store, Writer};

/// A file of a recording.
#[derive(Debug)]
pub struct RecordingFile<S: Store> {
    /// Writer of the file.
    pub writer: Writer<S>,
    messages: BoardMessages,
    ros2: Option<Ros2<S>>,
    /// The board's description is attached.
    says_what: bool,
}

impl<S: Store> RecordingFile<S> {
    /// Creates a file, beside another one of ROS 2 messages.
    pub fn create(store: S, ros2: Option<Ros2<S>>) -> Result<RecordingFile<S>> {
        let mut writer = Writer::create(store, "")?;
        let messages = BoardMessages::new(Topics::open(&mut writer, None)?);
        Ok(RecordingFile { writer, messages, ros2, says_what: false })
    }

    /// Attaches the board's `Hello`, its frame of the wire, and the origin of the stream.
    pub fn attach(&mut self, worn: &Worn, hello: &[u8], origin: &Origin, stamp: Stamp) -> Result<()> {
        let ns = stamp.host_ns();
        if !std::mem::replace(&mut self.says_what, true) {
            self.writer.attach(HELLO, "application/octet-stream", hello, ns)?;
        }
        provenance::attach(&mut self.writer, worn, origin, ns, None)
    }

    /// Writes messages.
    pub fn put(&mut self, add: impl FnOnce(&mut BoardMessages) -> Result<()>) -> Result<()> {
        let added = add(&mut self.messages);
        added.and(self.writer.write(self.messages.take()))
    }

    /// Writes an event as JSON and, if requested, as ROS 2 messages.
    pub fn event(&mut self, client: &Client, event: &Event, stamp: Stamp, scale: Option<f32>) -> Result<()> {
        if let Some(ros2) = &mut self.ros2 {
            ros2.event(client, event, stamp, scale)?;
        }
        self.put(|messages| messages.event(client, event, stamp))
    }

    /// Ends the chunk.
    pub fn close(&mut self) -> Result<()> {
        self.end_chunk()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.close())
    }

    fn end_chunk(&mut self) -> Result<()> {
        self.messages.close();
        self.writer.write(self.messages.take())
    }

    /// Flushes everything written so far to the disk.
    pub fn flush(&mut self) -> Result<()> {
        self.end_chunk()?;
        self.writer.flush()?;
        self.ros2.as_mut().map_or(Ok(()), |ros2| ros2.writer.flush())
    }

    /// Bytes written so far.
    pub fn bytes(&self) -> u64 {
        self.writer.bytes() + self.ros2.as_ref().map_or(0, |ros2| ros2.writer.bytes())
    }

    /// Writes the end of both files, even if one fails. Returns their bytes.
    pub fn finish(mut self) -> Result<u64> {
        let written = self.end_chunk();
        let beside = self.ros2.map_or(Ok(0), |ros2| ros2.writer.finish());
        let bytes = self.writer.finish()?;
        Ok(written.map(|()| bytes)? + beside?)
    }
}
