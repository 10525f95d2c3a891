//! Reads the board's frames of the wire from a recording.

use super::board_names::WIRE;
use super::board_recording::BoardRecording;
use super::lost;
use crate::error::Result;
use crate::recording::{Message, Messages, Skipped};
use mcap::records::MessageHeader;

/// Attachment with the first `Hello`, a frame of the wire. Without it nothing else of the board can be read,
/// and the chunk that holds it may be damaged.
pub const HELLO: &str = "hello.taxel-wire";

/// Iterates over the frames. If the initial `Hello` is lost, the attached one comes first.
#[derive(Debug)]
pub struct WireReader {
    messages: Messages,
    begun: bool,
    /// The first frame, which follows the restored `Hello`.
    first: Option<(MessageHeader, Vec<u8>)>,
    /// Buffer of the last returned frame, if it is not in the messages' buffer.
    given: Vec<u8>,
}

impl WireReader {
    /// Opens the recording of a board.
    pub fn open(recording: &BoardRecording) -> Result<WireReader> {
        let messages = Messages::of_topic(&recording.path, &recording.topic(WIRE))?
            .wanting(&recording.attachment(HELLO));
        Ok(WireReader { messages, begun: false, first: None, given: Vec::new() })
    }

    /// Damage passed over so far.
    pub fn skipped(&self) -> Skipped {
        self.messages.skipped()
    }

    /// Bytes of the file read so far, and its size.
    pub fn passed(&self) -> [u64; 2] {
        self.messages.passed()
    }

    /// Next frame with its times (ns: `log_time` is the host's, `publish_time` the board's); none at the end.
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
