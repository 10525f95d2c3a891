//! Damage within a recording: what to skip, and where to continue.

use super::append::HEAD;
use super::records::{Head, Records};
use super::summary::{chunk_indexes, footer};
use crate::error::Result;
use mcap::records::op;
use std::fmt;
use std::path::Path;
use std::time::Duration;

/// Bytes searched at once for the next chunk.
const WINDOW: u64 = 1 << 16;
/// Size of a chunk's fields except for the name of its compression, and the longest such name.
const FIELDS: u64 = 40;
const LONGEST_NAME: u32 = 16;

/// Amount that was skipped because it is damaged.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Skipped {
    /// Number of chunks.
    pub chunks: u64,
    /// Bytes of the file.
    pub bytes: u64,
    /// Time of their messages, as far as it is known.
    pub time: Duration,
}

impl Skipped {
    /// True if nothing was skipped.
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

/// Something that is not a record, or a chunk that cannot be read.
#[derive(Debug, Clone, Copy)]
pub struct Damage {
    /// Offset of its beginning.
    pub offset: u64,
    /// Offset of its end, if its length is right.
    pub end: Option<u64>,
    /// Time of its messages, ns.
    pub ns: u64,
}

impl Damage {
    /// Damage of which only the offset is known.
    pub fn at(offset: u64) -> Damage {
        Damage { offset, end: None, ns: 0 }
    }

    /// Counts the damage, and returns the offset at which reading continues; none if nothing more is
    /// readable. In that case, without an index, the rest is taken for a last record that a kill has cut off,
    /// and is not counted.
    pub fn pass(&self, records: &mut Records, path: &Path, skipped: &mut Skipped) -> Result<Option<u64>> {
        let places = chunk_indexes(path)?;
        let next = match self.end {
            Some(end) if is_plausible(records, end)? => Some(end),
            _ if places.is_empty() => next_chunk(records, self.offset + 1)?,
            _ => {
                // A damaged index may name a place outside of the file.
                let rest = self.offset + 1..records.length();
                places.iter().map(|place| place.chunk_start_offset).find(|start| rest.contains(start))
            }
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

/// True if the data ends there: the summary follows, or the file has none.
pub fn is_end(path: &Path, data_end: &Head) -> Result<bool> {
    let summary = footer(path)?.map_or(0, |footer| footer.summary_start);
    Ok(summary == 0 || summary == data_end.end())
}

/// True if the first version of the format has a record with this number.
pub fn is_known(number: u8) -> bool {
    (op::HEADER..=op::DATA_END).contains(&number)
}

/// True if an unknown record is a chunk with a damaged number. No record has the number 0.
pub(crate) fn is_chunk_at(path: &Path, head: &Head) -> Result<bool> {
    Ok(head.op == 0 || chunk_indexes(path)?.iter().any(|place| place.chunk_start_offset == head.offset))
}

/// True if a record or the end of the file may be there.
fn is_plausible(records: &mut Records, offset: u64) -> Result<bool> {
    if offset >= records.length() {
        return Ok(offset == records.length());
    }
    records.go_to(offset)?;
    Ok(records.next_head()?.is_some_and(|head| is_known(head.op)))
}

/// Offset of the first chunk with a plausible head, from an offset on; none if there is none.
fn next_chunk(records: &mut Records, mut from: u64) -> Result<Option<u64>> {
    // A head may cross a window's boundary.
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

/// True if these bytes, of which the file has `left`, may begin a chunk: the lengths are consistent.
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
