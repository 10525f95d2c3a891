//! What a board told a recording: the frames of the wire, one after the other.

use super::provenance::HELLO;
use super::standing::lost;
use super::topics::WIRE;
use crate::recording::{Message, Messages, Skipped};
use anyhow::Result;
use mcap::records::MessageHeader;
use std::path::Path;

/// Goes through the frames. Where the `Hello` with which the recording began is lost, the one that is
/// attached comes first.
#[derive(Debug)]
pub struct WireReader {
    messages: Messages,
    begun: bool,
    /// The first frame, behind the `Hello` that was lost.
    first: Option<(MessageHeader, Vec<u8>)>,
    /// Memory of the frame that was given last, if it is not that of the messages.
    given: Vec<u8>,
}

impl WireReader {
    /// Of a file.
    pub fn open(path: &Path) -> Result<WireReader> {
        let messages = Messages::of_topic(path, WIRE)?.wanting(HELLO);
        Ok(WireReader { messages, begun: false, first: None, given: Vec::new() })
    }

    /// What of the file is damaged, so far.
    pub fn skipped(&self) -> Skipped {
        self.messages.skipped()
    }

    /// Bytes of the file so far, and of all.
    pub fn passed(&self) -> [u64; 2] {
        self.messages.passed()
    }

    /// The next frame with its times (ns: `log_time` is the host's, `publish_time` the board's); none: there
    /// are no more.
    pub fn next_frame(&mut self) -> Result<Option<Message<'_>>> {
        if !std::mem::replace(&mut self.begun, true) {
            return self.begin();
        }
        let Some((header, frame)) = self.first.take() else { return self.messages.next_message() };
        self.given = frame;
        Ok(Some(Message { header, data: &self.given }))
    }

    fn begin(&mut self) -> Result<Option<Message<'_>>> {
        let Some(Message { header, data }) = self.messages.next_message()? else { return Ok(None) };
        self.given = data.to_vec();
        if let Some(hello) = self.messages.attached().and_then(|hello| lost(hello, &self.given)) {
            self.first = Some((header, std::mem::replace(&mut self.given, hello)));
        }
        Ok(Some(Message { header, data: &self.given }))
    }
}
