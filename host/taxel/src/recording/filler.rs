//! Fills chunks with messages, also beside a [`Writer`](super::Writer): in a thread of its own.

use super::chunk::{Chunk, FullChunk};
use crate::error::Result;
use mcap::records::MessageHeader;
use std::collections::BTreeMap;

/// Uncompressed size at which a chunk ends whatever its time, bytes.
const LARGE: usize = 4 << 20;

/// Messages of some channels of a recording, compressed as they come, until [`Writer::write`] writes them. A file
/// may have several fillers, each for channels of its own.
///
/// [`Writer::write`]: super::Writer::write
#[derive(Debug, Default)]
pub struct Filler {
    chunk: Chunk,
    full: Vec<FullChunk>,
    /// Number of the next message by channel.
    sequences: BTreeMap<u16, u32>,
}

impl Filler {
    /// Adds a message whose bytes this appends; times in ns. On error nothing is added.
    pub fn message(
        &mut self,
        channel_id: u16,
        log_time: u64,
        publish_time: u64,
        data: impl FnOnce(&mut Vec<u8>) -> Result<()>,
    ) -> Result<()> {
        let sequence = self.sequences.entry(channel_id).or_insert(0);
        let header = MessageHeader { channel_id, sequence: *sequence, log_time, publish_time };
        self.chunk.message(&header, data)?;
        *sequence = sequence.wrapping_add(1);
        if self.chunk.bytes() > LARGE {
            self.close();
        }
        Ok(())
    }

    /// Ends the chunk: readers can seek to the next one.
    pub fn close(&mut self) {
        self.full.extend(self.chunk.end());
    }

    /// True if a chunk is filled.
    pub fn is_ready(&self) -> bool {
        !self.full.is_empty()
    }

    /// Takes the filled chunks, in order.
    pub fn take(&mut self) -> Vec<FullChunk> {
        std::mem::take(&mut self.full)
    }
}
