//! A chunk whose checksum fits, and what is in it.

use super::super::append::write;
use super::super::chunk::{Index, LARGEST, LZ4};
use super::super::lz4;
use super::super::records::Inside;
use super::piece::{Kind, fields, parse};
use lz4_flex::frame::FrameDecoder;
use mcap::records::{Channel, ChunkHeader, MessageIndexEntry, SchemaHeader, op};
use std::io::Read;

/// How many times as large as its bytes LZ4 can make a chunk.
const MOST: u64 = 255;

/// What is in a chunk.
#[derive(Debug, Default)]
pub struct Opened {
    /// Where its messages lie in its plain bytes, by channel.
    pub index: Index,
    /// Schemas that are told in it.
    pub schemas: Vec<(SchemaHeader, Vec<u8>)>,
    /// Channels that are told in it.
    pub channels: Vec<Channel>,
}

/// The fields of a chunk at the beginning of its body, and their bytes.
pub fn header(body: &[u8]) -> Option<(ChunkHeader, usize)> {
    fields::<ChunkHeader>(op::CHUNK, body)
}

/// Reads a chunk's body; where its fields are wrong but its checksum fits, they and the body become right.
/// None: it does not fit. Its plain bytes are then in `plain`, memory that serves all chunks.
pub fn open(body: &mut Vec<u8>, plain: &mut Vec<u8>) -> Option<(ChunkHeader, Opened)> {
    let (told, used) = header(body)?;
    let data = body.get(used..)?;
    let named = [told.compression.as_str(), LZ4, ""];
    let (compression, inside) = named.into_iter().find_map(|compression| {
        unpack(data, compression, told.uncompressed_size, plain)?;
        Some((compression.to_string(), checked(&told, plain)?))
    })?;
    let times = || inside.index.values().flatten().map(|entry| entry.log_time);
    let right = ChunkHeader {
        message_start_time: times().min().unwrap_or(told.message_start_time),
        message_end_time: times().max().unwrap_or(told.message_end_time),
        uncompressed_size: plain.len() as u64,
        compressed_size: data.len() as u64,
        compression,
        ..told
    };
    if right != told {
        let mut corrected = Vec::with_capacity(body.len());
        write(&mut corrected, &right).ok()?;
        corrected.extend_from_slice(data);
        *body = corrected;
    }
    Some((right, inside))
}

/// The records of a chunk, if they fit its checksum; where it has none, if they fill it as it says.
fn checked(told: &ChunkHeader, plain: &[u8]) -> Option<Opened> {
    let sum = told.uncompressed_crc;
    if sum != 0 && sum != crc32fast::hash(plain) {
        return None;
    }
    let (inside, is_whole) = Opened::of(plain);
    let fits = sum != 0 || (is_whole && told.uncompressed_size == plain.len() as u64);
    fits.then_some(inside)
}

/// Puts the plain bytes of a chunk, which says that they are so many, into `plain`.
fn unpack(data: &[u8], compression: &str, told: u64, plain: &mut Vec<u8>) -> Option<()> {
    let most = LARGEST.min(data.len() as u64 * MOST);
    match compression {
        "" => {
            plain.clear();
            plain.extend_from_slice(data);
        }
        // Most chunks are what they say.
        LZ4 if told <= most && lz4::is_ours(data) => {
            plain.resize(told as usize, 0);
            if !lz4::decode(data, plain) {
                decode(data, most, plain)?;
            }
        }
        LZ4 => decode(data, most, plain)?,
        _ => return None,
    }
    Some(())
}

/// Decodes a frame of any kind and size, its own checksums checked.
fn decode(data: &[u8], most: u64, plain: &mut Vec<u8>) -> Option<()> {
    plain.clear();
    FrameDecoder::new(data).take(most + 1).read_to_end(plain).ok()?;
    (plain.len() as u64 <= most).then_some(())
}

impl Opened {
    /// Reads the plain bytes of a chunk; also whether they are whole records to their last byte.
    fn of(plain: &[u8]) -> (Opened, bool) {
        let (mut inside, mut records) = (Opened::default(), Inside::of(plain, 0));
        for record in records.by_ref() {
            match parse(record.op, record.body) {
                Some((Kind::Message(header), _)) => {
                    let entry = MessageIndexEntry { log_time: header.log_time, offset: record.offset };
                    inside.index.entry(header.channel_id).or_default().push(entry);
                }
                Some((Kind::Schema(header, data), _)) => inside.schemas.push((header, data)),
                Some((Kind::Channel(channel), _)) => inside.channels.push(channel),
                None if matches!(record.op, 0 | op::MESSAGE | op::SCHEMA | op::CHANNEL) => {
                    return (inside, false);
                }
                _ => {}
            }
        }
        (inside, records.offset() == plain.len())
    }
}
