//! Encodes the end of a file: summary, its offsets, footer. It is encoded in pieces, so that its memory does
//! not grow with the number of chunks.

use super::append::{HEAD, append, sized, write};
use super::chunk::{Closed, is_known};
use super::contents::{Contents, Stretch};
use crate::error::Result;
use crc32fast::Hasher;
use mcap::MAGIC;
use mcap::records::{DataEnd, Footer, Statistics, SummaryOffset, op};
use std::collections::BTreeMap;

/// The end of a file: call [`begin`](Ending::begin), then [`chunk`](Ending::chunk) for each, then
/// [`finish`](Ending::finish).
pub struct Ending {
    /// Bytes not taken yet, and their offset in the file.
    piece: Vec<u8>,
    offset: u64,
    /// The summary's offset, its checksum, and how many bytes of the piece the checksum already covers.
    start: u64,
    sum: Hasher,
    summed: usize,
    groups: Vec<SummaryOffset>,
    /// Offset of the current group of records.
    group: u64,
    chunks: u32,
    counts: BTreeMap<u16, u64>,
    stretch: Option<Stretch>,
    /// The number of messages is known for every chunk.
    is_counted: bool,
}

impl Ending {
    /// Begins the end of a file whose records end at `offset`. Its chunks must be added by
    /// [`chunk`](Ending::chunk).
    pub fn begin(contents: &Contents, offset: u64) -> Result<Ending> {
        let mut piece = Vec::new();
        append(&mut piece, op::DATA_END, &DataEnd::default(), &[])?;
        let start = offset + piece.len() as u64;
        let (counts, stretch) = contents.loose.clone();
        let mut ending = Ending {
            summed: piece.len(),
            piece,
            offset,
            start,
            sum: Hasher::new(),
            groups: Vec::new(),
            group: start,
            chunks: 0,
            counts,
            stretch,
            is_counted: true,
        };
        for (header, data) in contents.schemas.values() {
            append(&mut ending.piece, op::SCHEMA, header, &sized(data))?;
        }
        ending.group(op::SCHEMA);
        for channel in contents.channels.values() {
            append(&mut ending.piece, op::CHANNEL, channel, &[])?;
        }
        ending.group(op::CHANNEL);
        Ok(ending)
    }

    /// Adds the next chunk.
    pub fn chunk(&mut self, chunk: &Closed) -> Result<()> {
        self.chunks += 1;
        for (channel, count) in &chunk.counts {
            *self.counts.entry(*channel).or_default() += count;
        }
        let [first, last] = [chunk.index.message_start_time, chunk.index.message_end_time];
        let known = self.stretch.unwrap_or([first, last]);
        self.stretch = Some([known[0].min(first), known[1].max(last)]);
        // For a chunk that cannot be read, only its index gives the number of messages.
        self.is_counted &= !chunk.counts.is_empty() || is_known(&chunk.index.compression);
        append(&mut self.piece, op::CHUNK_INDEX, &chunk.index, &[])
    }

    /// Number of bytes not taken yet.
    pub fn waiting(&self) -> usize {
        self.piece.len()
    }

    /// Takes the bytes.
    pub fn take(&mut self) -> Vec<u8> {
        self.sum.update(&self.piece[self.summed..]);
        self.summed = 0;
        self.offset += self.piece.len() as u64;
        std::mem::take(&mut self.piece)
    }

    /// Returns the last piece.
    pub fn finish(mut self, contents: &Contents) -> Result<Vec<u8>> {
        self.group(op::CHUNK_INDEX);
        if self.is_counted {
            let stated = self.statistics(contents);
            append(&mut self.piece, op::STATISTICS, &stated, &[])?;
        }
        self.group(op::STATISTICS);
        for index in &contents.attachments {
            append(&mut self.piece, op::ATTACHMENT_INDEX, index, &[])?;
        }
        self.group(op::ATTACHMENT_INDEX);
        for index in &contents.metadata {
            append(&mut self.piece, op::METADATA_INDEX, index, &[])?;
        }
        self.group(op::METADATA_INDEX);
        let offsets = self.place();
        for group in &self.groups {
            append(&mut self.piece, op::SUMMARY_OFFSET, group, &[])?;
        }
        self.footer(offsets)?;
        Ok(self.piece)
    }

    /// Offset of the next record.
    fn place(&self) -> u64 {
        self.offset + self.piece.len() as u64
    }

    /// Ends a group of records of one kind.
    fn group(&mut self, group_opcode: u8) {
        let (group_start, group_length) = (self.group, self.place() - self.group);
        if group_length > 0 {
            self.groups.push(SummaryOffset { group_opcode, group_start, group_length });
        }
        self.group = self.place();
    }

    fn statistics(&self, contents: &Contents) -> Statistics {
        let [message_start_time, message_end_time] = self.stretch.unwrap_or([0; 2]);
        Statistics {
            message_count: self.counts.values().sum(),
            schema_count: contents.schemas.len() as u16,
            channel_count: contents.channels.len() as u32,
            attachment_count: contents.attachments.len() as u32,
            metadata_count: contents.metadata.len() as u32,
            chunk_count: self.chunks,
            message_start_time,
            message_end_time,
            channel_message_counts: self.counts.clone(),
        }
    }

    /// Writes the footer, whose checksum covers the summary and the footer up to it, and the magic.
    fn footer(&mut self, offsets: u64) -> Result<()> {
        let mut footer = Footer { summary_start: self.start, summary_offset_start: offsets, summary_crc: 0 };
        let at = self.piece.len();
        append(&mut self.piece, op::FOOTER, &footer, &[])?;
        self.piece.truncate(self.piece.len() - size_of::<u32>());
        self.sum.update(&self.piece[self.summed..]);
        footer.summary_crc = self.sum.clone().finalize();
        self.piece.truncate(at + HEAD);
        write(&mut self.piece, &footer)?;
        self.piece.extend_from_slice(MAGIC);
        Ok(())
    }
}
