//! Requests on their way to a board that may read slowly or not at all, without blocking the reader.

use crate::error::{Result, SourceError};
use crate::source::Port;
use crate::time::Instant;
use std::time::Duration;

/// Time after which a board that reads nothing is an error.
const PATIENCE: Duration = Duration::from_secs(5);

/// Bytes that the link has not accepted yet.
#[derive(Debug, Default)]
pub struct Outgoing {
    bytes: Vec<u8>,
    /// Since when it has accepted none.
    stuck: Option<Instant>,
}

impl Outgoing {
    /// Appends requests.
    pub fn add(&mut self, requests: &[u8]) {
        self.bytes.extend_from_slice(requests);
    }

    /// Sends as much as the link accepts now. Error if the link is broken or the board does not read.
    pub fn send(&mut self, port: &mut dyn Port) -> Result<()> {
        while !self.bytes.is_empty() {
            let count = port.write(&self.bytes)?;
            if count == 0 {
                let stuck = self.stuck.get_or_insert_with(Instant::now);
                if stuck.elapsed() > PATIENCE {
                    let seconds = PATIENCE.as_secs();
                    fail!(
                        SourceError::Silent,
                        "the board has read nothing for {seconds} s; {} bytes are waiting",
                        self.bytes.len()
                    );
                }
                return Ok(());
            }
            self.stuck = None;
            self.bytes.drain(..count);
        }
        Ok(())
    }
}
