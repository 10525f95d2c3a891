//! Damage in the middle of a recording: what is passed over, and where the file goes on.

use super::append::HEAD;
use super::records::{Head, Records};
use super::summary::{chunk_indexes, footer};
use anyhow::Result;
use mcap::records::op;
use std::fmt;
use std::path::Path;
use std::time::Duration;

/// Bytes in which the next chunk is looked for at a time.
const WINDOW: u64 = 1 << 16;
/// Bytes of a chunk's fields but for the name of its compression, and of the longest such name.
const FIELDS: u64 = 40;
const LONGEST_NAME: u32 = 16;

/// What was passed over because it is damaged.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Skipped {
    /// Chunks.
    pub chunks: u64,
    /// Bytes of the file.
    pub bytes: u64,
    /// Time of the messages in them, as far as it is known.
    pub time: Duration,
}

impl Skipped {
    /// Nothing was damaged.
    pub fn is_none(&self) -> bool {
        self.chunks == 0
    }
}

impl fmt::Display for Skipped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let s = if self.chunks == 1 { "" } else { "s" };
        let (bytes, seconds) = (self.bytes, self.time.as_secs_f64());
        write!(f, "skipped {} damaged chunk{s}, {bytes} bytes, {seconds:.2} s", self.chunks)
    }
}

/// Something that is no record, or a chunk that cannot be read.
#[derive(Debug, Clone, Copy)]
pub struct Damage {
    /// Where it begins.
    pub offset: u64,
    /// Where it ends, if its length is right.
    pub end: Option<u64>,
    /// Time of its messages, ns.
    pub ns: u64,
}

impl Damage {
    /// Of which only the place is known.
    pub fn at(offset: u64) -> Damage {
        Damage { offset, end: None, ns: 0 }
    }

    /// Counts it; where the file goes on behind it. None: nothing more can be read, and without an index what
    /// is left is taken for the last record, which a kill has cut off.
    pub fn pass(&self, records: &mut Records, path: &Path, skipped: &mut Skipped) -> Result<Option<u64>> {
        let places = chunk_indexes(path)?;
        let next = match self.end {
            Some(end) if is_plausible(records, end)? => Some(end),
            _ if places.is_empty() => next_chunk(records, self.offset + 1)?,
            _ => places.iter().map(|place| place.chunk_start_offset).find(|start| *start > self.offset),
        };
        let end = next.unwrap_or(records.length());
        let lost = || places.iter().filter(|place| (self.offset..end).contains(&place.chunk_start_offset));
        if next.is_some() || self.end.is_some() || lost().next().is_some() {
            let ns = lost().map(|place| place.message_end_time.saturating_sub(place.message_start_time));
            skipped.chunks += (lost().count() as u64).max(1);
            skipped.bytes += end - self.offset;
            skipped.time += Duration::from_nanos(if places.is_empty() { self.ns } else { ns.sum() });
        }
        Ok(next)
    }
}

/// Whether the data end there: the summary follows, or the file has none.
pub fn is_end(path: &Path, data_end: &Head) -> Result<bool> {
    let summary = footer(path)?.map_or(0, |footer| footer.summary_start);
    Ok(summary == 0 || summary == data_end.end())
}

/// Whether a record of that number is one of the format's first version.
pub fn is_known(number: u8) -> bool {
    (op::HEADER..=op::DATA_END).contains(&number)
}

/// Whether a record that nobody knows is a chunk whose number is damaged. No record has the number 0.
pub fn is_chunk_at(path: &Path, head: &Head) -> Result<bool> {
    Ok(head.op == 0 || chunk_indexes(path)?.iter().any(|place| place.chunk_start_offset == head.offset))
}

/// Whether a record, or the end of the file, can lie there.
fn is_plausible(records: &mut Records, offset: u64) -> Result<bool> {
    if offset >= records.length() {
        return Ok(offset == records.length());
    }
    records.go_to(offset)?;
    Ok(records.next_head()?.is_some_and(|head| is_known(head.op)))
}

/// Where the first chunk lies whose head makes sense, from an offset on; none: there is no further.
fn next_chunk(records: &mut Records, mut from: u64) -> Result<Option<u64>> {
    // A head may lie across two windows.
    let longest = HEAD as u64 + FIELDS + u64::from(LONGEST_NAME);
    while from < records.length() {
        records.go_to(from)?;
        let window = records.rest(WINDOW + longest)?;
        let left = records.length() - from;
        let found = (0..window.len()).find(|at| is_chunk(&window[*at..], left - *at as u64));
        if let Some(at) = found {
            return Ok(Some(from + at as u64));
        }
        from += WINDOW;
    }
    Ok(None)
}

/// Whether a chunk begins with these bytes, of which the file has `left`: its lengths fit together.
fn is_chunk(bytes: &[u8], left: u64) -> bool {
    let lengths = || {
        let (head, rest) = bytes.split_first_chunk().filter(|(head, _)| head[0] == op::CHUNK)?;
        let head = Head::read(0, *head);
        let name = u32::from_le_bytes(*rest.get(28..)?.first_chunk()?);
        let size = rest.get(32 + name.min(LONGEST_NAME) as usize..)?.first_chunk()?;
        let fields = FIELDS + u64::from(name);
        let whole = u64::from_le_bytes(*size).checked_add(fields)? == head.length && head.end() <= left;
        Some(name <= LONGEST_NAME && whole)
    };
    lengths().unwrap_or(false)
}
