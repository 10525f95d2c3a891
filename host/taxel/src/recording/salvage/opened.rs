//! Opens a chunk with a valid checksum.

use super::super::append::write;
use super::super::chunk::{LARGEST, LZ4};
use super::super::lz4;
use super::super::records::Inside;
use super::super::texts::fields;
use super::piece::{Kind, Opened, parse};
use lz4_flex::frame::FrameDecoder;
use mcap::records::{ChunkHeader, MessageIndexEntry, op};
use std::io::Read;

/// Largest expansion of LZ4.
const MOST: u64 = 255;

/// Fields of a chunk at the beginning of its body, and their size.
pub fn header(body: &[u8]) -> Option<(ChunkHeader, usize)> {
    fields::<ChunkHeader>(op::CHUNK, body)
}

/// Reads a chunk's body. If fields are wrong but the checksum fits, corrects them and the body. None if it
/// does not fit. The uncompressed bytes are left in `plain`, which is reused for all chunks.
pub fn open(body: &mut Vec<u8>, plain: &mut Vec<u8>) -> Option<(ChunkHeader, Opened)> {
    let (stated, used) = header(body)?;
    let data = body.get(used..)?;
    let named = [stated.compression.as_str(), LZ4, ""];
    let (compression, inside) = named.into_iter().find_map(|compression| {
        unpack(data, compression, stated.uncompressed_size, plain)?;
        Some((compression.to_string(), checked(&stated, plain)?))
    })?;
    let times = || inside.index.values().flatten().map(|entry| entry.log_time);
    let right = ChunkHeader {
        message_start_time: times().min().unwrap_or(stated.message_start_time),
        message_end_time: times().max().unwrap_or(stated.message_end_time),
        uncompressed_size: plain.len() as u64,
        compressed_size: data.len() as u64,
        compression,
        ..stated
    };
    if right != stated {
        let mut corrected = Vec::with_capacity(body.len());
        write(&mut corrected, &right).ok()?;
        corrected.extend_from_slice(data);
        *body = corrected;
    }
    Some((right, inside))
}

/// Records of a chunk, if they fit its checksum; without a checksum, if they fill its stated size.
fn checked(stated: &ChunkHeader, plain: &[u8]) -> Option<Opened> {
    let sum = stated.uncompressed_crc;
    if sum != 0 && sum != crc32fast::hash(plain) {
        return None;
    }
    let (inside, is_whole) = records(plain);
    let fits = sum != 0 || (is_whole && stated.uncompressed_size == plain.len() as u64);
    fits.then_some(inside)
}

/// Decompresses a chunk with this stated size into `plain`.
fn unpack(data: &[u8], compression: &str, stated: u64, plain: &mut Vec<u8>) -> Option<()> {
    let most = LARGEST.min(data.len() as u64 * MOST);
    match compression {
        "" => {
            plain.clear();
            plain.extend_from_slice(data);
        }
        // The usual case: the chunk is as stated.
        LZ4 if stated <= most && lz4::is_ours(data) => {
            plain.resize(stated as usize, 0);
            if !lz4::decode(data, plain) {
                decode(data, most, plain)?;
            }
        }
        LZ4 => decode(data, most, plain)?,
        _ => return None,
    }
    Some(())
}

/// Decodes a frame of any kind and size, and checks its own checksums.
fn decode(data: &[u8], most: u64, plain: &mut Vec<u8>) -> Option<()> {
    plain.clear();
    FrameDecoder::new(data).take(most + 1).read_to_end(plain).ok()?;
    (plain.len() as u64 <= most).then_some(())
}

/// Reads the uncompressed bytes of a chunk. Also returns whether they are complete records to the last
/// byte.
fn records(plain: &[u8]) -> (Opened, bool) {
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
