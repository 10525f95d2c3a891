//! Plays a recording through a client.

use crate::client::{Client, Event};
use crate::error::Result;
use crate::recording::{BoardRecording, Skipped, WireReader};
use mcap::records::MessageHeader;

/// A recording being played.
#[derive(Debug)]
pub struct Play {
    wire: WireReader,
    client: Client,
}

impl Play {
    /// Opens the recording of a board.
    pub fn open(recording: &BoardRecording) -> Result<Play> {
        Ok(Play { wire: WireReader::open(recording)?, client: Client::new() })
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

    /// Next event with its times (ns: `log_time` is the host's, `publish_time` the board's); none at the end.
    pub fn next_event(&mut self) -> Result<Option<(MessageHeader, Event)>> {
        while let Some(message) = self.wire.next_frame()? {
            // A message of this channel is one frame of the wire, which its last byte completes.
            if let Some(event) = self.client.push_all(message.data).1 {
                return Ok(Some((message.header, event)));
            }
        }
        Ok(None)
    }
}
