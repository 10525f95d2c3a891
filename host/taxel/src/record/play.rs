//! Plays a recording through a client.

use crate::client::{Client, Event};
use crate::error::Result;
use crate::recording::{BoardRecording, LinkRecord, Skipped, WireReader, force_scale};
use mcap::records::MessageHeader;

/// A recording being played.
#[derive(Debug)]
pub struct Play {
    wire: WireReader,
    client: Client,
    /// Times of the last message.
    header: Option<MessageHeader>,
}

impl Play {
    /// Opens the recording of a board, whose forces are by the scale that it holds.
    pub fn open(recording: &BoardRecording) -> Result<Play> {
        let mut client = Client::new();
        client.weigh_by(force_scale(&recording.overview()?, recording)?);
        Ok(Play { wire: WireReader::open(recording)?, client, header: None })
    }

    /// The client after the last event.
    pub fn client(&self) -> &Client {
        &self.client
    }

    /// Damage passed over so far.
    pub fn skipped(&self) -> Skipped {
        self.wire.skipped()
    }

    /// Bytes of the file read so far, and its size.
    pub fn passed(&self) -> [u64; 2] {
        self.wire.passed()
    }

    /// Next event with its times (ns: `log_time` is the host's, `publish_time` the board's); none at the end. What was
    /// present when the board was lost ends then, as it did when that was recorded.
    pub fn next_event(&mut self) -> Result<Option<(MessageHeader, Event)>> {
        loop {
            let mut event = self.client.next_event(&[]).1;
            if event.is_none() {
                let Some((header, record)) = self.wire.next_record()? else { return Ok(None) };
                self.header = Some(header);
                match record {
                    // A message of this channel is one frame of the wire, which its last byte completes.
                    LinkRecord::Frame(bytes) => event = self.client.next_event(bytes).1,
                    LinkRecord::Gap(mark) => mark.apply(&mut self.client),
                }
            }
            if let Some(found) = self.header.zip(event) {
                return Ok(Some(found));
            }
        }
    }
}
