//! Reads a board's link from a recording: its frames of the wire, and the gaps between them.

use super::board_names::WIRE;
use super::board_recording::BoardRecording;
use super::gap_mark::{BACK, GapMark, LOST};
use super::lost;
use crate::error::Result;
use crate::recording::{Message, Messages, Skipped};
use mcap::records::MessageHeader;

/// Attachment with the first `Hello`, a frame of the wire. Without it nothing else of the board can be read,
/// and the chunk that holds it may be damaged.
pub const HELLO: &str = "hello.taxel-wire";

/// A message about a board's link.
#[derive(Debug, Clone, PartialEq)]
pub enum LinkRecord<'a> {
    /// A frame of the wire; empty in place of a message that cannot be read.
    Frame(&'a [u8]),
    /// Begin or end of a gap.
    Gap(GapMark),
}

/// Iterates over the messages. If the initial `Hello` is lost, the attached one comes first.
#[derive(Debug)]
pub struct WireReader {
    messages: Messages,
    /// Topic of the frames.
    wire: String,
    begun: bool,
    /// The first frame, which follows the restored `Hello`.
    first: Option<(MessageHeader, Vec<u8>)>,
    /// Buffer of the last returned frame, if it is not in the messages' buffer.
    given: Vec<u8>,
}

impl WireReader {
    /// Opens the recording of a board.
    pub fn open(recording: &BoardRecording) -> Result<WireReader> {
        let topics = [WIRE, LOST, BACK].map(|topic| recording.topic(topic));
        let messages = Messages::of_topics(&recording.path, &topics)?.wanting(&recording.attachment(HELLO));
        let [wire, ..] = topics;
        Ok(WireReader { messages, wire, begun: false, first: None, given: Vec::new() })
    }

    /// Damage passed over so far.
    pub fn skipped(&self) -> Skipped {
        self.messages.skipped()
    }

    /// Bytes of the file read so far, and its size.
    pub fn passed(&self) -> [u64; 2] {
        self.messages.passed()
    }

    /// Next message with its times (ns: `log_time` is the host's, `publish_time` the board's); none at the end.
    pub fn next_record(&mut self) -> Result<Option<(MessageHeader, LinkRecord<'_>)>> {
        if !std::mem::replace(&mut self.begun, true) {
            return self.begin();
        }
        if let Some((header, frame)) = self.first.take() {
            self.given = frame;
            return Ok(Some((header, LinkRecord::Frame(&self.given))));
        }
        let Some((header, topic, data)) = self.messages.next_with_topic()? else { return Ok(None) };
        let record = if topic == self.wire {
            LinkRecord::Frame(data)
        } else {
            serde_json::from_slice(data).map_or(LinkRecord::Frame(&[]), LinkRecord::Gap)
        };
        Ok(Some((header, record)))
    }

    /// The first frame, after the attached `Hello` if the file's own is lost. Nothing was present before it: gaps do
    /// not count.
    fn begin(&mut self) -> Result<Option<(MessageHeader, LinkRecord<'_>)>> {
        let header = loop {
            let Some(Message { header, data }) = self.messages.next_message()? else { return Ok(None) };
            self.given = data.to_vec();
            if self.messages.topic(header.channel_id).is_some_and(|topic| topic == self.wire) {
                break header;
            }
        };
        if let Some(hello) = self.messages.attached().and_then(|hello| lost(hello, &self.given)) {
            self.first = Some((header, std::mem::replace(&mut self.given, hello)));
        }
        Ok(Some((header, LinkRecord::Frame(&self.given))))
    }
}
