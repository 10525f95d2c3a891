//! One record of a file that may be damaged.

use super::super::attached::attached;
use super::super::chunk::Index;
use super::super::texts::{LONGEST, fields};
use mcap::records::{
    AttachmentHeader, AttachmentIndex, Channel, ChunkHeader, ChunkIndex, DataEnd, Footer, Header,
    MessageHeader, MessageIndex, Metadata, MetadataIndex, SchemaHeader, Statistics, SummaryOffset, op,
};

/// A record.
#[derive(Debug)]
pub struct Piece {
    /// Offset of its beginning.
    pub offset: u64,
    /// Offset of the next record.
    pub end: u64,
    /// Opcode of the record.
    pub op: u8,
    /// Contents; known errors in a chunk's fields are corrected.
    pub body: Vec<u8>,
    /// Meaning of the record.
    pub kind: Kind,
    /// True if its number, length or fields are wrong in the file.
    pub is_corrected: bool,
}

/// Meaning of a record.
#[derive(Debug)]
pub enum Kind {
    /// Library and profile.
    Header(Header),
    /// Format of messages, with the bytes of the schema.
    Schema(SchemaHeader, Vec<u8>),
    /// Topic of messages.
    Channel(Channel),
    /// A message outside of a chunk.
    Message(MessageHeader),
    /// A chunk; none if its compression or size is not supported.
    Chunk(ChunkHeader, Option<Opened>),
    /// A chunk with a wrong checksum.
    BadChunk,
    /// Message index of the chunk before.
    Index(MessageIndex),
    /// An attachment, and its size.
    Attachment(AttachmentHeader, u64),
    /// Words by name.
    Metadata(Metadata),
    /// End of the data, or a record of the summary.
    Summary,
    /// The last record.
    Footer,
    /// An unknown record.
    Unknown,
}

/// Contents of a chunk.
#[derive(Debug, Default)]
pub struct Opened {
    /// Offsets of its messages in its uncompressed bytes, by channel.
    pub index: Index,
    /// Schemas declared in it.
    pub schemas: Vec<(SchemaHeader, Vec<u8>)>,
    /// Channels declared in it.
    pub channels: Vec<Channel>,
}

/// Parses a record. Also returns whether its fields end where it ends. None if it is not such a record.
/// Chunks are parsed by `opened::open`.
pub fn parse(number: u8, body: &[u8]) -> Option<(Kind, bool)> {
    let exact = |used: usize| used == body.len();
    let stated = |used: usize| Some((Kind::Summary, exact(used)));
    Some(match number {
        op::HEADER => fields(number, body).map(|(header, used)| (Kind::Header(header), exact(used)))?,
        op::SCHEMA => schema(body)?,
        op::CHANNEL => fields(number, body).map(|(channel, used)| (Kind::Channel(channel), exact(used)))?,
        op::MESSAGE => fields(number, body).map(|(message, _)| (Kind::Message(message), false))?,
        op::MESSAGE_INDEX => fields(number, body).map(|(index, used)| (Kind::Index(index), exact(used)))?,
        op::ATTACHMENT => attachment(body)?,
        op::METADATA => fields(number, body).map(|(words, used)| (Kind::Metadata(words), exact(used)))?,
        op::FOOTER => fields(number, body).map(|(_, used): (Footer, _)| (Kind::Footer, exact(used)))?,
        op::CHUNK_INDEX => fields::<ChunkIndex>(number, body).and_then(|(_, used)| stated(used))?,
        op::ATTACHMENT_INDEX => fields::<AttachmentIndex>(number, body).and_then(|(_, used)| stated(used))?,
        op::METADATA_INDEX => fields::<MetadataIndex>(number, body).and_then(|(_, used)| stated(used))?,
        op::STATISTICS => fields::<Statistics>(number, body).and_then(|(_, used)| stated(used))?,
        op::SUMMARY_OFFSET => fields::<SummaryOffset>(number, body).and_then(|(_, used)| stated(used))?,
        op::DATA_END => fields::<DataEnd>(number, body).and_then(|(_, used)| stated(used))?,
        // Zeros, which a power cut can leave, are not a record.
        0 | op::CHUNK => return None,
        _ => (Kind::Unknown, false),
    })
}

fn schema(body: &[u8]) -> Option<(Kind, bool)> {
    let (header, used) = fields::<SchemaHeader>(op::SCHEMA, body)?;
    let (length, rest) = body.get(used..)?.split_first_chunk()?;
    let data = rest.get(..u32::from_le_bytes(*length) as usize).filter(|data| data.len() <= LONGEST)?;
    // Number 0 is no schema.
    (header.id != 0).then(|| (Kind::Schema(header, data.to_vec()), data.len() == rest.len()))
}

fn attachment(body: &[u8]) -> Option<(Kind, bool)> {
    let (header, data, is_whole) = attached(body)?;
    Some((Kind::Attachment(header, data.len() as u64), is_whole))
}
