//! Reads the summary at a recording's end: found by the footer, without scanning the file.

use super::append::HEAD;
use super::source::{RandomAccess, RawHead};
use super::texts::{LONGEST, parse_record};
use crate::error::{Context, Result};
use mcap::MAGIC;
use mcap::records::{AttachmentIndex, Channel, ChunkIndex, Footer, MetadataIndex, Record, Statistics, op};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Size of the footer's fields.
const FIELDS: usize = 20;
/// Size of the footer's record, and of the file's rest from it on.
const FOOTER: usize = HEAD + FIELDS;
const LAST: u64 = (FOOTER + MAGIC.len()) as u64;
/// Bytes at the footer's end that the checksum excludes: itself.
const CRC: usize = size_of::<u32>();
/// Bytes summed at once.
const PIECE: u64 = 1 << 16;

/// The end of a file.
#[derive(Debug, Default)]
pub struct End {
    /// A footer or the magic is there; it may be damaged.
    pub is_there: bool,
    /// The footer; none if it is damaged or missing.
    pub footer: Option<Footer>,
    /// Offset of the summary, if the file has one and its checksum is right or absent.
    pub summary: Option<u64>,
    /// The summary is readable to its last byte, or the file has none.
    pub is_sound: bool,
}

impl End {
    /// Reads a file's end, and passes each record of its summary to `take`, which returns whether it is
    /// plausible.
    pub fn read(source: &mut RandomAccess, mut take: impl FnMut(Record<'_>) -> bool) -> io::Result<End> {
        let mut end = End::default();
        let Some(at) = source.length().checked_sub(LAST) else { return Ok(end) };
        let last = source.read(at, LAST)?;
        let (footer, magic) = last.split_at(FOOTER);
        let (head, fields) = footer.split_at(HEAD);
        let is_footer = head[0] == op::FOOTER && head[1..] == (FIELDS as u64).to_le_bytes();
        end.is_there = is_footer || magic == MAGIC;
        if !is_footer || magic != MAGIC {
            return Ok(end);
        }
        let Ok(Record::Footer(stated)) = parse_record(op::FOOTER, fields) else { return Ok(end) };
        if stated.summary_start == 0 {
            end.is_sound = true;
        } else if stated.summary_start <= at {
            let sum = sum(source, stated.summary_start, at + (FOOTER - CRC) as u64)?;
            if stated.summary_crc == 0 || stated.summary_crc == sum {
                end.summary = Some(stated.summary_start);
                end.is_sound = each(source, stated.summary_start, at, &mut take)?;
            }
        }
        end.footer = Some(stated);
        Ok(end)
    }
}

/// Checksum of the bytes between two offsets.
fn sum(source: &mut RandomAccess, mut from: u64, until: u64) -> io::Result<u32> {
    let mut sum = crc32fast::Hasher::new();
    while from < until {
        let bytes = source.read(from, PIECE.min(until - from))?;
        if bytes.is_empty() {
            // The file was truncated meanwhile.
            break;
        }
        sum.update(&bytes);
        from += bytes.len() as u64;
    }
    Ok(sum.finalize())
}

/// Visits the records between two offsets. Returns whether all can be read and fill the range.
fn each(
    source: &mut RandomAccess,
    mut at: u64,
    until: u64,
    take: &mut impl FnMut(Record<'_>) -> bool,
) -> io::Result<bool> {
    while at < until {
        let fits = |head: &RawHead| head.length <= (until - at).min(LONGEST as u64);
        let Some(head) = source.head(at)?.filter(fits) else { return Ok(false) };
        let next = at + HEAD as u64 + head.length;
        // Zeros are not a record, and a summary has no chunks.
        if next > until || matches!(head.op, 0 | op::CHUNK) {
            return Ok(false);
        }
        let body = source.read(at + HEAD as u64, head.length)?;
        if !parse_record(head.op, &body).is_ok_and(&mut *take) {
            return Ok(false);
        }
        at = next;
    }
    Ok(true)
}

/// The summary without the places of chunks, whose size grows with the recording: see [`chunk_indexes`].
#[derive(Debug, Default, Clone)]
pub struct Summary {
    /// Names of the schemas, by number.
    pub schemas: BTreeMap<u16, String>,
    /// Channels, by number.
    pub channels: BTreeMap<u16, Channel>,
    /// Counts and times, if present.
    pub statistics: Option<Statistics>,
    /// Places of the attachments.
    pub attachments: Vec<AttachmentIndex>,
    /// Places of the metadata.
    pub metadata: Vec<MetadataIndex>,
}

/// The footer; none if the file has no end.
pub fn footer(path: &Path) -> Result<Option<Footer>> {
    Ok(records(path, |_| ())?.footer)
}

/// The summary; none if the file has no end, or the summary is missing or damaged.
pub fn summary(path: &Path) -> Result<Option<Summary>> {
    let mut summary = Summary::default();
    let end = records(path, |record| match record {
        Record::Schema { header, .. } => _ = summary.schemas.insert(header.id, header.name),
        Record::Channel(channel) => _ = summary.channels.insert(channel.id, channel),
        Record::Statistics(statistics) => summary.statistics = Some(statistics),
        Record::AttachmentIndex(index) => summary.attachments.push(index),
        Record::MetadataIndex(index) => summary.metadata.push(index),
        _ => {}
    })?;
    Ok((end.is_sound && end.summary.is_some()).then_some(summary))
}

/// Places of the chunks in file order; empty if they are not listed.
pub fn chunk_indexes(path: &Path) -> Result<Vec<ChunkIndex>> {
    let mut chunks = Vec::new();
    let end = records(path, |record| {
        if let Record::ChunkIndex(index) = record {
            chunks.push(index);
        }
    })?;
    if !end.is_sound {
        chunks.clear();
    }
    chunks.sort_by_key(|index| index.chunk_start_offset);
    Ok(chunks)
}

/// Visits the records of a file's summary. Returns the file's end.
fn records(path: &Path, mut show: impl FnMut(Record<'_>)) -> Result<End> {
    let mut take = |record: Record<'_>| {
        show(record);
        true
    };
    End::read(&mut RandomAccess::open(path)?, &mut take)
        .with_context(|| format!("{} cannot be read", path.display()))
}
