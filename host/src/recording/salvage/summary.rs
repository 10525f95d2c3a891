//! What the end of a file says of its records.

use super::super::append::HEAD;
use super::piece::{Kind, fields, parse};
use super::source::Source;
use mcap::MAGIC;
use mcap::records::{AttachmentIndex, Channel, ChunkIndex, Footer, MetadataIndex, SchemaHeader, op};
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// Bytes of a footer's record.
const FOOTER: u64 = HEAD as u64 + 20;
/// Bytes at its end that its checksum leaves out: itself.
const CRC: usize = 4;

/// The end of a file.
#[derive(Debug, Default)]
pub struct Summary {
    /// A footer and the last bytes are there, though they may be damaged.
    pub is_there: bool,
    /// It fits its checksum, or has none.
    pub is_sound: bool,
    /// Where chunks begin.
    pub chunks: BTreeSet<u64>,
    /// Where chunks and other records begin.
    pub records: BTreeSet<u64>,
    /// Schemas by number.
    pub schemas: BTreeMap<u16, (SchemaHeader, Vec<u8>)>,
    /// Channels by number.
    pub channels: BTreeMap<u16, Channel>,
}

impl Summary {
    /// Reads it.
    pub fn read(source: &mut Source) -> io::Result<Summary> {
        let mut summary = Summary::default();
        let tail = MAGIC.len() as u64;
        let Some(at) = source.length().checked_sub(FOOTER + tail) else { return Ok(summary) };
        let end = source.read(at, FOOTER + tail)?;
        let (record, magic) = end.split_at(FOOTER as usize);
        let (head, body) = record.split_at(HEAD);
        let is_footer = head[0] == op::FOOTER && head[1..] == (FOOTER - HEAD as u64).to_le_bytes();
        summary.is_there = is_footer || magic == MAGIC;
        let Some((footer, _)) = fields::<Footer>(body).filter(|_| is_footer && magic == MAGIC) else {
            return Ok(summary);
        };
        if footer.summary_start == 0 {
            summary.is_sound = true;
            return Ok(summary);
        }
        let Some(length) = at.checked_sub(footer.summary_start) else { return Ok(summary) };
        let mut bytes = source.read(footer.summary_start, length)?;
        bytes.extend_from_slice(&record[..record.len() - CRC]);
        if footer.summary_crc == 0 || footer.summary_crc == crc32fast::hash(&bytes) {
            bytes.truncate(length as usize);
            summary.is_sound = summary.take(&bytes);
            summary.records.insert(footer.summary_start);
        }
        Ok(summary)
    }

    /// Takes the summary's records; whether they can all be read.
    fn take(&mut self, bytes: &[u8]) -> bool {
        let mut rest = bytes;
        while let Some((head, behind)) = rest.split_at_checked(HEAD) {
            let length = head[1..].iter().rev().fold(0u64, |sum, byte| sum << 8 | u64::from(*byte));
            let Some((body, next)) = usize::try_from(length).ok().and_then(|at| behind.split_at_checked(at))
            else {
                return false;
            };
            if !self.record(head[0], body) {
                return false;
            }
            rest = next;
        }
        rest.is_empty()
    }

    fn record(&mut self, number: u8, body: &[u8]) -> bool {
        match parse(number, body) {
            Some((Kind::Schema(header, data), _)) => _ = self.schemas.insert(header.id, (header, data)),
            Some((Kind::Channel(channel), _)) => _ = self.channels.insert(channel.id, channel),
            Some(_) => {}
            None => return false,
        }
        let place = match number {
            op::CHUNK_INDEX => fields::<ChunkIndex>(body).map(|(index, _)| index.chunk_start_offset),
            op::ATTACHMENT_INDEX => fields::<AttachmentIndex>(body).map(|(index, _)| index.offset),
            op::METADATA_INDEX => fields::<MetadataIndex>(body).map(|(index, _)| index.offset),
            _ => None,
        };
        self.records.extend(place);
        self.chunks.extend(place.filter(|_| number == op::CHUNK_INDEX));
        true
    }
}
