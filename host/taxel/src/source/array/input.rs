//! Bytes of an array: from a link, or from a recording.

use super::super::Port;
use super::original::{OriginalBytes, RecordedBytes};
use super::pace::Pace;
use crate::error::Result;
use std::io;

/// Bytes that are read at once: a datagram.
const READ: usize = 64 << 10;

/// Where the bytes of an array come from.
pub enum ArrayInput {
    /// A link.
    Link {
        /// The link.
        port: Box<dyn Port>,
        /// Each read is one datagram.
        has_datagrams: bool,
    },
    /// A recording, which has the times of arrival, too.
    Recorded(Box<RecordedBytes>),
}

impl ArrayInput {
    /// Reads bytes, after a short wait if there are none (then none of them); none at the end. Sets the clock of a
    /// recording.
    pub fn read(&mut self, pace: &mut Pace) -> Result<Option<OriginalBytes>> {
        match self {
            ArrayInput::Link { port, has_datagrams } => {
                let mut bytes = vec![0; READ];
                let Some(count) = port.read(&mut bytes)? else { return Ok(None) };
                bytes.truncate(count);
                Ok(Some(OriginalBytes { arrival_us: pace.now_us(), is_datagram: *has_datagrams, bytes }))
            }
            ArrayInput::Recorded(recorded) => {
                let original = recorded.next()?;
                original.iter().for_each(|original| pace.hear(original.arrival_us));
                Ok(original)
            }
        }
    }

    /// Writes bytes to the link; a recording passes them over.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            ArrayInput::Link { port, .. } => port.write(bytes),
            ArrayInput::Recorded(_) => Ok(bytes.len()),
        }
    }
}
