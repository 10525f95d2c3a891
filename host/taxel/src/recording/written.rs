//! Finds the chunks of the file being written by the heads of its records. Remembering them would take memory
//! for every second of a recording.

use super::append::HEAD;
use super::chunk::{Closed, LZ4};
use super::records::Head;
use super::store::Store;
use crate::error::{Context, RecordingError, Result};
use binrw::BinRead;
use mcap::MAGIC;
use mcap::records::{ChunkHeader, ChunkIndex, MessageIndexEntry, op};
use std::collections::BTreeMap;
use std::io::Cursor;

/// Bytes read at once: heads lie between data that is not needed.
const BLOCK: usize = 4096;
/// Size of the fields of our chunks: three times and sizes, a checksum, the compression, a size.
const CHUNK: usize = 3 * 8 + 4 + (4 + LZ4.len()) + 8;
/// Size of a message index's fields before its entries: the channel, and the number of bytes that follow.
const INDEX: usize = 2 + 4;

/// Iterates over the chunks.
pub struct Written {
    /// Offset of the next record, and of the end of the last.
    offset: u64,
    end: u64,
    block: Vec<u8>,
    /// Offset of the block in the file.
    at: u64,
}

impl Written {
    /// Chunks of a file whose records end at `end`.
    pub fn until(end: u64) -> Written {
        Written { offset: MAGIC.len() as u64, end, block: Vec::new(), at: 0 }
    }

    /// Next chunk; none at the end.
    pub(crate) fn next_chunk(&mut self, store: &mut impl Store) -> Result<Option<Closed>> {
        while let Some(head) = self.head(store)? {
            self.offset = head.end();
            if head.op != op::CHUNK {
                continue;
            }
            let fields: [u8; CHUNK] = self.bytes(store, head.offset + HEAD as u64)?;
            let header = ChunkHeader::read_le(&mut Cursor::new(fields)).context("a chunk cannot be read")?;
            let mut closed = Closed {
                index: ChunkIndex {
                    message_start_time: header.message_start_time,
                    message_end_time: header.message_end_time,
                    chunk_start_offset: head.offset,
                    chunk_length: head.end() - head.offset,
                    message_index_offsets: BTreeMap::new(),
                    message_index_length: 0,
                    compression: header.compression,
                    compressed_size: header.compressed_size,
                    uncompressed_size: header.uncompressed_size,
                },
                counts: BTreeMap::new(),
            };
            self.indexes(store, &mut closed)?;
            return Ok(Some(closed));
        }
        Ok(None)
    }

    /// Adds the message indexes behind a chunk.
    fn indexes(&mut self, store: &mut impl Store, closed: &mut Closed) -> Result<()> {
        while let Some(head) = self.head(store)?.filter(|head| head.op == op::MESSAGE_INDEX) {
            let fields: [u8; INDEX] = self.bytes(store, head.offset + HEAD as u64)?;
            let [low, high, length @ ..] = fields;
            let channel = u16::from_le_bytes([low, high]);
            let count = u32::from_le_bytes(length) as usize / size_of::<MessageIndexEntry>();
            closed.index.message_index_offsets.insert(channel, head.offset);
            closed.index.message_index_length += head.end() - head.offset;
            closed.counts.insert(channel, count as u64);
            self.offset = head.end();
        }
        Ok(())
    }

    /// Head of the next record.
    fn head(&mut self, store: &mut impl Store) -> Result<Option<Head>> {
        if self.offset >= self.end {
            return Ok(None);
        }
        Ok(Some(Head::read(self.offset, self.bytes(store, self.offset)?)))
    }

    /// Bytes at an offset.
    fn bytes<const N: usize>(&mut self, store: &mut impl Store, offset: u64) -> Result<[u8; N]> {
        let inside = |block: &[u8], at: u64| {
            let start = usize::try_from(offset.checked_sub(at)?).ok()?;
            block.get(start..)?.first_chunk().copied()
        };
        if let Some(bytes) = inside(&self.block, self.at) {
            return Ok(bytes);
        }
        self.block.resize(BLOCK, 0);
        let count = store.look(offset, &mut self.block)?;
        self.block.truncate(count);
        self.at = offset;
        inside(&self.block, offset)
            .ok_or_else(|| error!(RecordingError::Record, "what was written cannot be read again"))
    }
}
