//! What a recording says of itself at its end: found by its footer, without going through the file.

use super::append::HEAD;
use super::source::{Head, Source};
use super::texts::{LONGEST, parse_record};
use anyhow::{Context, Result};
use mcap::MAGIC;
use mcap::records::{AttachmentIndex, Channel, ChunkIndex, Footer, MetadataIndex, Record, Statistics, op};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Bytes of the footer's fields.
const FIELDS: usize = 20;
/// Bytes of the footer's record, and of all from it on.
const FOOTER: usize = HEAD + FIELDS;
const LAST: u64 = (FOOTER + MAGIC.len()) as u64;
/// Bytes at the footer's end that the checksum leaves out: itself.
const CRC: usize = size_of::<u32>();
/// Bytes that are summed at a time.
const PIECE: u64 = 1 << 16;

/// The end of a file.
#[derive(Debug, Default)]
pub struct End {
    /// A footer or the last bytes are there; they may be damaged.
    pub is_there: bool,
    /// The footer; none: it is damaged or missing.
    pub footer: Option<Footer>,
    /// Where the summary begins, if the file has one and it fits its checksum or has none.
    pub summary: Option<u64>,
    /// The summary can be read to its last byte, or the file has none.
    pub is_sound: bool,
}

impl End {
    /// Reads a file's end, and shows each record of its summary to `take`, which says whether it can be right.
    pub fn read(source: &mut Source, mut take: impl FnMut(Record<'_>) -> bool) -> io::Result<End> {
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
        let Ok(Record::Footer(told)) = parse_record(op::FOOTER, fields) else { return Ok(end) };
        if told.summary_start == 0 {
            end.is_sound = true;
        } else if told.summary_start <= at {
            let sum = sum(source, told.summary_start, at + (FOOTER - CRC) as u64)?;
            if told.summary_crc == 0 || told.summary_crc == sum {
                end.summary = Some(told.summary_start);
                end.is_sound = each(source, told.summary_start, at, &mut take)?;
            }
        }
        end.footer = Some(told);
        Ok(end)
    }
}

/// The checksum of the bytes from one place up to another.
fn sum(source: &mut Source, mut from: u64, until: u64) -> io::Result<u32> {
    let mut sum = crc32fast::Hasher::new();
    while from < until {
        let bytes = source.read(from, PIECE.min(until - from))?;
        if bytes.is_empty() {
            // Somebody has cut the file meanwhile.
            break;
        }
        sum.update(&bytes);
        from += bytes.len() as u64;
    }
    Ok(sum.finalize())
}

/// Goes through the records from one place up to another; whether they can all be read and fill it.
fn each(
    source: &mut Source,
    mut at: u64,
    until: u64,
    take: &mut impl FnMut(Record<'_>) -> bool,
) -> io::Result<bool> {
    while at < until {
        let fits = |head: &Head| head.length <= (until - at).min(LONGEST as u64);
        let Some(head) = source.head(at)?.filter(fits) else { return Ok(false) };
        let next = at + HEAD as u64 + head.length;
        // Zeros are no record, and a chunk is none of a summary.
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

/// The summary, but for where each chunk lies, which grows with the recording: see [`chunk_indexes`].
#[derive(Debug, Default, Clone)]
pub struct Summary {
    /// Names of the schemas.
    pub schemas: BTreeMap<u16, String>,
    /// Channels.
    pub channels: BTreeMap<u16, Channel>,
    /// Counts and times, where they are told.
    pub statistics: Option<Statistics>,
    /// Where each attached file lies.
    pub attachments: Vec<AttachmentIndex>,
    /// Where each list of words lies.
    pub metadata: Vec<MetadataIndex>,
}

/// The footer; none: the file has no end.
pub fn footer(path: &Path) -> Result<Option<Footer>> {
    Ok(records(path, |_| ())?.footer)
}

/// The summary; none: the file has no end, or a summary is missing or damaged.
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

/// Where each chunk lies, in the order of the file; empty: nothing says so.
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

/// Shows each record of a file's summary; the file's end.
fn records(path: &Path, mut show: impl FnMut(Record<'_>)) -> Result<End> {
    let mut take = |record: Record<'_>| {
        show(record);
        true
    };
    End::read(&mut Source::open(path)?, &mut take)
        .with_context(|| format!("{} cannot be read", path.display()))
}
