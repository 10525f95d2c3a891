//! Requests on their way to a board, which may read slowly or not at all: nothing waits for it but they.

use crate::source::Port;
use anyhow::{Result, bail};
use std::time::{Duration, Instant};

/// How long a board may leave all of it unread.
const PATIENCE: Duration = Duration::from_secs(5);

/// Bytes that the link has not taken yet.
#[derive(Debug, Default)]
pub struct Outgoing {
    bytes: Vec<u8>,
    /// Since when it has taken none.
    stuck: Option<Instant>,
}

impl Outgoing {
    /// Adds requests behind those that wait.
    pub fn add(&mut self, requests: &[u8]) {
        self.bytes.extend_from_slice(requests);
    }

    /// Sends as much as the link takes now. An error: the link is broken, or the board does not read.
    pub fn send(&mut self, port: &mut dyn Port) -> Result<()> {
        while !self.bytes.is_empty() {
            let count = port.write(&self.bytes)?;
            if count == 0 {
                let stuck = self.stuck.get_or_insert_with(Instant::now);
                if stuck.elapsed() > PATIENCE {
                    let seconds = PATIENCE.as_secs();
                    bail!(
                        "the board has read nothing for {seconds} s, and {} bytes wait for it",
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
