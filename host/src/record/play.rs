//! A recording, message by message, as a client reads it.

use super::wire_reader::WireReader;
use crate::client::{Client, Event};
use crate::recording::Skipped;
use anyhow::Result;
use mcap::records::MessageHeader;
use std::path::Path;

/// Goes through what the board told.
#[derive(Debug)]
pub struct Play {
    wire: WireReader,
    client: Client,
}

impl Play {
    /// Of a file.
    pub fn open(path: &Path) -> Result<Play> {
        Ok(Play { wire: WireReader::open(path)?, client: Client::new() })
    }

    /// What is known after the last event.
    pub fn client(&self) -> &Client {
        &self.client
    }

    /// What of the file is damaged, so far.
    pub fn skipped(&self) -> Skipped {
        self.wire.skipped()
    }

    /// Bytes of the file so far, and of all.
    pub fn passed(&self) -> [u64; 2] {
        self.wire.passed()
    }

    /// The next event, with its times (ns: `log_time` is the host's, `publish_time` the board's); none: there
    /// are no more.
    pub fn next_event(&mut self) -> Result<Option<(MessageHeader, Event)>> {
        while let Some(message) = self.wire.next_frame()? {
            // A message of this channel is one frame of the wire: its last byte tells of it.
            let mut bytes = message.data.iter();
            if let Some(event) = bytes.find_map(|byte| self.client.push(*byte)) {
                return Ok(Some((message.header, event)));
            }
        }
        Ok(None)
    }
}
