//! What a recording says of itself at its end: found by its footer, without going through the file.

use super::append::HEAD;
use super::records::Records;
use anyhow::Result;
use mcap::records::{AttachmentIndex, Channel, ChunkIndex, Footer, MetadataIndex, Record, Statistics, op};
use mcap::{MAGIC, parse_record};
use std::collections::BTreeMap;
use std::path::Path;

/// Bytes of the footer's record and of the last ones of the file.
const FOOTER: u64 = (HEAD + 20 + MAGIC.len()) as u64;
/// Bytes that are summed at a time.
const PIECE: u64 = 1 << 16;

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
    let mut records = Records::open(path)?;
    let Some(offset) = records.length().checked_sub(FOOTER).filter(|offset| *offset >= MAGIC.len() as u64)
    else {
        return Ok(None);
    };
    records.go_to(offset)?;
    let footer = records.next_record()?.filter(|record| record.op == op::FOOTER);
    let footer = footer.and_then(|record| match parse_record(record.op, record.body) {
        Ok(Record::Footer(footer)) => Some(footer),
        _ => None,
    });
    Ok(footer.filter(|_| records.rest(MAGIC.len() as u64).is_ok_and(|last| last == MAGIC)))
}

/// The summary; none: the file has no end, or a summary is missing or damaged.
pub fn summary(path: &Path) -> Result<Option<Summary>> {
    let mut summary = Summary::default();
    let intact = each(path, |record| match record {
        Record::Schema { header, .. } => _ = summary.schemas.insert(header.id, header.name),
        Record::Channel(channel) => _ = summary.channels.insert(channel.id, channel),
        Record::Statistics(statistics) => summary.statistics = Some(statistics),
        Record::AttachmentIndex(index) => summary.attachments.push(index),
        Record::MetadataIndex(index) => summary.metadata.push(index),
        _ => {}
    })?;
    Ok(intact.then_some(summary))
}

/// Where each chunk lies, in the order of the file; empty: nothing says so.
pub fn chunk_indexes(path: &Path) -> Result<Vec<ChunkIndex>> {
    let mut chunks = Vec::new();
    let intact = each(path, |record| {
        if let Record::ChunkIndex(index) = record {
            chunks.push(index);
        }
    })?;
    if !intact {
        chunks.clear();
    }
    chunks.sort_by_key(|index| index.chunk_start_offset);
    Ok(chunks)
}

/// Goes through the records of a summary; whether there is one, and it is intact.
fn each(path: &Path, mut take: impl FnMut(Record<'_>)) -> Result<bool> {
    let Some(footer) = footer(path)?.filter(|footer| footer.summary_start > 0) else { return Ok(false) };
    let mut records = Records::open(path)?;
    let end = records.length() - FOOTER;
    if footer.summary_start > end || !fits(&mut records, &footer)? {
        return Ok(false);
    }
    records.go_to(footer.summary_start)?;
    while records.offset() < end {
        let Some(record) = records.next_record()? else { return Ok(false) };
        match parse_record(record.op, record.body) {
            Ok(record) => take(record),
            Err(_) => return Ok(false),
        }
    }
    Ok(true)
}

/// Whether the checksum, where there is one, is that of the summary and of the footer up to there.
fn fits(records: &mut Records, footer: &Footer) -> Result<bool> {
    let end = records.length() - (MAGIC.len() + size_of::<u32>()) as u64;
    let mut sum = crc32fast::Hasher::new();
    records.go_to(footer.summary_start)?;
    while footer.summary_crc != 0 && records.offset() < end {
        sum.update(&records.rest(PIECE.min(end - records.offset()))?);
    }
    Ok(footer.summary_crc == 0 || sum.finalize() == footer.summary_crc)
}
