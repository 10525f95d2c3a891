//! Messages of a short time, compressed together, with their index.

use super::append::{append, append_with};
use super::lz4;
use crate::error::{Context, RecordingError, Result};
use lz4_flex::frame::FrameDecoder;
use mcap::records::{ChunkHeader, ChunkIndex, MessageHeader, MessageIndex, MessageIndexEntry, op};
use std::collections::BTreeMap;
use std::io::Read;

/// Compression of our chunks, in MCAP's words.
pub const LZ4: &str = "lz4";
/// True if chunks with this compression can be read.
pub fn is_known(compression: &str) -> bool {
    matches!(compression, "" | LZ4)
}

/// Largest uncompressed chunk that is read, bytes. Ours hold a second, those of other programs some
/// megabytes. LZ4 can expand one byte to 255, so a small file must not make us allocate much.
pub const LARGEST: u64 = 1 << 25;

/// Offsets of messages in a chunk's uncompressed bytes, by channel.
pub type Index = BTreeMap<u16, Vec<MessageIndexEntry>>;

/// A chunk being filled.
#[derive(Debug, Default)]
pub struct Chunk {
    body: lz4::FrameWriter,
    index: Index,
    span: Option<[u64; 2]>,
}

impl Chunk {
    /// Adds a message whose data this appends; nothing on error.
    pub fn message(
        &mut self,
        header: &MessageHeader,
        data: impl FnOnce(&mut Vec<u8>) -> Result<()>,
    ) -> Result<()> {
        let entry = MessageIndexEntry { log_time: header.log_time, offset: self.body.length() as u64 };
        self.body.add(|body| append_with(body, op::MESSAGE, header, data))?;
        self.index.entry(header.channel_id).or_default().push(entry);
        let [first, last] = self.span.unwrap_or([header.log_time; 2]);
        self.span = Some([first.min(header.log_time), last.max(header.log_time)]);
        Ok(())
    }

    /// Uncompressed bytes so far.
    pub fn bytes(&self) -> usize {
        self.body.length()
    }

    /// Ends the chunk, and begins another. None if there is no message.
    pub fn end(&mut self) -> Option<FullChunk> {
        let [first, last] = self.span.take()?;
        let (packed, length, sum) = self.body.end();
        let header = ChunkHeader {
            message_start_time: first,
            message_end_time: last,
            uncompressed_size: length,
            uncompressed_crc: sum,
            compression: LZ4.into(),
            compressed_size: packed.len() as u64,
        };
        Some(FullChunk { header, packed, index: std::mem::take(&mut self.index) })
    }
}

/// A chunk that is to be written.
#[derive(Debug)]
pub struct FullChunk {
    header: ChunkHeader,
    packed: Vec<u8>,
    index: Index,
}

impl FullChunk {
    /// Appends it and its index to `out`, which begins at `offset` in the file.
    pub fn append(&self, offset: u64, out: &mut Vec<u8>) -> Result<Closed> {
        let start = out.len();
        append(out, op::CHUNK, &self.header, &self.packed)?;
        let length = (out.len() - start) as u64;
        Closed::indexed(&self.header, &self.index, offset, length, out)
    }
}

/// A written chunk: its place, and its messages by channel.
#[derive(Debug, Clone)]
pub struct Closed {
    /// Record in the summary.
    pub index: ChunkIndex,
    /// Number of messages by channel.
    pub counts: BTreeMap<u16, u64>,
}

impl Closed {
    /// Describes a chunk record of `length` bytes at `offset`, whose message indexes are appended to `out`.
    pub fn indexed(
        header: &ChunkHeader,
        messages: &Index,
        offset: u64,
        length: u64,
        out: &mut Vec<u8>,
    ) -> Result<Closed> {
        let (start, behind) = (out.len(), offset + length);
        let mut offsets = BTreeMap::new();
        for (channel, entries) in messages {
            offsets.insert(*channel, behind + (out.len() - start) as u64);
            let index = MessageIndex { channel_id: *channel, records: entries.clone() };
            append(out, op::MESSAGE_INDEX, &index, &[])?;
        }
        let index = ChunkIndex {
            message_start_time: header.message_start_time,
            message_end_time: header.message_end_time,
            chunk_start_offset: offset,
            chunk_length: length,
            message_index_offsets: offsets,
            message_index_length: (out.len() - start) as u64,
            compression: header.compression.clone(),
            compressed_size: header.compressed_size,
            uncompressed_size: header.uncompressed_size,
        };
        let counts = messages.iter().map(|(channel, entries)| (*channel, entries.len() as u64)).collect();
        Ok(Closed { index, counts })
    }

    /// Offset behind the chunk and its index.
    pub fn end(&self) -> u64 {
        self.index.chunk_start_offset + self.index.chunk_length + self.index.message_index_length
    }
}

/// Decompresses the records of a chunk into `body`, and checks their checksum.
pub fn plain(header: &ChunkHeader, data: &[u8], body: &mut Vec<u8>) -> Result<()> {
    let size = header.uncompressed_size;
    // LZ4 expands a byte to 255 at most.
    let possible = size <= LARGEST && size / 256 <= data.len() as u64;
    require!(possible, RecordingError::Record, "a chunk of {} bytes claims to hold {size}", data.len());
    body.resize(size as usize, 0);
    match header.compression.as_str() {
        "" => {
            require!(
                data.len() == body.len(),
                RecordingError::Record,
                "a chunk holds less or more than it says"
            );
            body.copy_from_slice(data);
        }
        // A chunk without a checksum relies on those of LZ4.
        LZ4 if header.uncompressed_crc != 0 && lz4::decode(data, body) => {}
        LZ4 => {
            let mut decoder = FrameDecoder::new(data);
            decoder.read_exact(body).context("a chunk cannot be decompressed")?;
            require!(decoder.read(&mut [0])? == 0, RecordingError::Record, "a chunk holds more than it says");
        }
        other => {
            fail!(RecordingError::Unsupported, "a chunk is compressed with {other}: known are lz4 and none")
        }
    }
    let sum = header.uncompressed_crc;
    require!(
        sum == 0 || sum == crc32fast::hash(body),
        RecordingError::Record,
        "a chunk does not fit its checksum"
    );
    Ok(())
}
