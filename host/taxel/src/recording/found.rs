//! Collects the contents of a file while scanning it.

use super::chunk::{Closed, Index};
use super::contents::Contents;
use mcap::records::{
    AttachmentHeader, AttachmentIndex, ChunkHeader, ChunkIndex, MessageIndex, MetadataIndex,
};
use std::collections::BTreeMap;

/// Each method adds a record of `length` bytes at `offset`.
impl Contents {
    /// A chunk, whose message indexes may follow.
    pub(super) fn chunk(&mut self, header: &ChunkHeader, messages: &Index, offset: u64, length: u64) {
        let index = ChunkIndex {
            message_start_time: header.message_start_time,
            message_end_time: header.message_end_time,
            chunk_start_offset: offset,
            chunk_length: length,
            message_index_offsets: BTreeMap::new(),
            message_index_length: 0,
            compression: header.compression.clone(),
            compressed_size: header.compressed_size,
            uncompressed_size: header.uncompressed_size,
        };
        let counts = messages.iter().map(|(channel, entries)| (*channel, entries.len() as u64)).collect();
        self.chunks.push(Closed { index, counts });
    }

    /// Message index of the chunk before.
    pub(super) fn message_index(&mut self, index: &MessageIndex, offset: u64, length: u64) {
        let Some(chunk) = self.chunks.last_mut().filter(|chunk| chunk.end() == offset) else { return };
        chunk.counts.insert(index.channel_id, index.records.len() as u64);
        chunk.index.message_index_offsets.insert(index.channel_id, offset);
        chunk.index.message_index_length += length;
    }

    /// An attachment of `data_size` bytes.
    pub(super) fn attachment(&mut self, header: AttachmentHeader, data_size: u64, offset: u64, length: u64) {
        self.attachments.push(AttachmentIndex {
            offset,
            length,
            log_time: header.log_time,
            create_time: header.create_time,
            data_size,
            name: header.name,
            media_type: header.media_type,
        });
    }

    /// A metadata record.
    pub(super) fn words(&mut self, name: &str, offset: u64, length: u64) {
        self.metadata.push(MetadataIndex { offset, length, name: name.into() });
    }
}
