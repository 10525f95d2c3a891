//! Iterates over the records of a file that may be damaged.

use super::super::append::HEAD;
use super::super::chunk::{Index, LARGEST, is_known};
use super::super::source::{RandomAccess, RawHead};
use super::super::texts::fields;
use super::likely::Judge;
use super::marks::Marks;
use super::opened;
use super::piece::{Kind, Piece, parse};
use crate::error::{Context, RecordingError, Result};
use mcap::MAGIC;
use mcap::records::{MessageIndex, op};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

/// Size of the largest record that is read without checking what follows it.
const LARGE: u64 = 1 << 26;

/// Iterates over the records.
#[derive(Debug)]
pub struct Walk {
    source: RandomAccess,
    path: PathBuf,
    /// Places listed by the file's end.
    pub marks: Marks,
    at: u64,
    /// Channels declared so far.
    channels: BTreeSet<u16>,
    /// Expected message indexes, if they follow a chunk that was read.
    index: Index,
    /// Uncompressed bytes of the last chunk, reused for the next.
    plain: Vec<u8>,
}

/// Next part of a file.
#[derive(Debug)]
pub enum WalkStep {
    /// A record.
    Piece(Piece),
    /// Bytes that are not a record.
    Unreadable(Unreadable),
}

/// Unreadable bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unreadable {
    /// Offset of the first.
    pub offset: u64,
    /// Their number.
    pub length: u64,
    /// Chunks among them.
    pub chunks: usize,
}

impl Walk {
    /// Opens a file at its first record.
    pub fn open(path: &Path) -> Result<Walk> {
        let mut source = RandomAccess::open(path)?;
        let place = || format!("{} cannot be read", path.display());
        let marks = Marks::read(&mut source).with_context(place)?;
        let (index, channels) = (Index::new(), BTreeSet::new());
        let mut walk = Walk { source, path: path.into(), marks, at: 0, channels, index, plain: Vec::new() };
        let begin = MAGIC.len() as u64;
        let has_magic = walk.source.read(0, begin).with_context(place)? == MAGIC;
        if has_magic {
            walk.at = begin;
        } else if !walk.marks.is_sound && !walk.begins_with_header(begin).with_context(place)? {
            return Err(RecordingError::NotMcap { path: path.into() }.into());
        }
        Ok(walk)
    }

    fn begins_with_header(&mut self, at: u64) -> io::Result<bool> {
        let Some(RawHead { op: op::HEADER, length }) = self.source.head(at)? else { return Ok(false) };
        let body = self.source.read(at + HEAD as u64, length)?;
        Ok(matches!(parse(op::HEADER, &body), Some((Kind::Header(_), true))))
    }

    /// Size of the file.
    pub fn length(&self) -> u64 {
        self.source.length()
    }

    /// Bytes before the next record.
    pub fn passed(&self) -> u64 {
        self.at
    }

    /// Next record, or bytes that are not a record; none at the end.
    pub(crate) fn next_step(&mut self) -> Result<Option<WalkStep>> {
        self.step().with_context(|| format!("{} cannot be read", self.path.display()))
    }

    fn step(&mut self) -> io::Result<Option<WalkStep>> {
        let at = self.at;
        if at >= self.length() || self.source.is_tail(at)? {
            return Ok(None);
        }
        let found = self.piece(at)?;
        self.at = match &found {
            Some(piece) => piece.end,
            None => {
                let length = self.length();
                self.judge().search(at + 1, length)?.unwrap_or(length)
            }
        };
        let piece = match found {
            Some(piece) if !matches!(piece.kind, Kind::BadChunk) => piece,
            _ => return self.damage(at).map(|damage| Some(WalkStep::Unreadable(damage))),
        };
        match &piece.kind {
            Kind::Chunk(_, Some(inside)) => {
                self.index = inside.index.clone();
                self.channels.extend(inside.channels.iter().map(|channel| channel.id));
            }
            Kind::Channel(channel) => _ = self.channels.insert(channel.id),
            Kind::Index(_) => {}
            _ => self.index.clear(),
        }
        Ok(Some(WalkStep::Piece(piece)))
    }

    fn judge(&mut self) -> Judge<'_> {
        Judge { source: &mut self.source, marks: &self.marks, channels: &self.channels }
    }

    fn damage(&mut self, offset: u64) -> io::Result<Unreadable> {
        self.index.clear();
        let stated = self.marks.chunks.range(offset..self.at).count();
        let is_chunk = self.source.head(offset)?.is_some_and(|head| head.op == op::CHUNK);
        let chunks = if self.marks.chunks.is_empty() { usize::from(is_chunk) } else { stated };
        Ok(Unreadable { offset, length: self.at - offset, chunks })
    }

    /// Record at an offset, if there is one.
    fn piece(&mut self, at: u64) -> io::Result<Option<Piece>> {
        let Some(head) = self.source.head(at)? else { return Ok(None) };
        if let Some(chunk) = self.chunk(at, head)? {
            return Ok(Some(chunk));
        }
        if head.op == 0 || head.length > self.source.behind(at) {
            return Ok(None);
        }
        let end = at + HEAD as u64 + head.length;
        if head.length > LARGE && !self.ends(at, end)? {
            return Ok(None);
        }
        let body = self.source.read(at + HEAD as u64, head.length)?;
        let piece = |number, kind, body| {
            Some(Piece { offset: at, end, op: number, body, kind, is_corrected: number != head.op })
        };
        if let Some(index) = self.follows_chunk(&body) {
            return Ok(piece(op::MESSAGE_INDEX, Kind::Index(index), body));
        }
        if let Some((number, kind)) = disguised(head.op, &body) {
            return Ok(piece(number, kind, body));
        }
        Ok(match parse(head.op, &body) {
            Some((Kind::Footer, _)) if self.source.read(end, MAGIC.len() as u64)? != MAGIC => None,
            Some((kind, true)) if !self.swallows(at, end) => piece(head.op, kind, body),
            Some((kind, _)) if self.ends(at, end)? => piece(head.op, kind, body),
            _ => None,
        })
    }

    /// Reads a chunk. If the record's length is wrong, that of its fields may be right; if the record's
    /// number is wrong, it is a chunk if the summary lists one at its offset.
    fn chunk(&mut self, at: u64, head: RawHead) -> io::Result<Option<Piece>> {
        if head.op != op::CHUNK && !self.marks.chunks.contains(&at) {
            return Ok(None);
        }
        let (from, behind) = (at + HEAD as u64, self.source.behind(at));
        let Some((stated, used)) = opened::header(&self.source.read(from, behind.min(256))?) else {
            return Ok(None);
        };
        let by_fields = (used as u64).saturating_add(stated.compressed_size);
        let piece = |length, body, kind| {
            let is_corrected = match &kind {
                Kind::Chunk(header, _) => *header != stated || head != RawHead { op: op::CHUNK, length },
                _ => false,
            };
            Some(Piece { offset: at, end: from + length, op: op::CHUNK, body, kind, is_corrected })
        };
        // The shorter first: the checksum does not cover bytes behind a compressed chunk.
        let mut lengths = vec![by_fields, head.length];
        lengths.sort();
        lengths.dedup();
        for length in lengths.into_iter().filter(|length| *length <= behind) {
            let mut body = self.source.read(from, length)?;
            if let Some((header, inside)) = opened::open(&mut body, &mut self.plain) {
                return Ok(piece(length, body, Kind::Chunk(header, Some(inside))));
            }
        }
        let end = from.saturating_add(head.length);
        if by_fields != head.length || end > self.length() || !self.ends(at, end)? {
            return Ok(None);
        }
        // Unsupported here, but possibly intact.
        Ok(if !is_known(&stated.compression) || stated.uncompressed_size > LARGEST {
            piece(head.length, self.source.read(from, head.length)?, Kind::Chunk(stated.clone(), None))
        } else {
            piece(head.length, Vec::new(), Kind::BadChunk)
        })
    }

    /// True if a record with this stated end does end there: another begins there, or at least none inside
    /// it.
    fn ends(&mut self, at: u64, end: u64) -> io::Result<bool> {
        if self.swallows(at, end) {
            return Ok(false);
        }
        Ok(self.judge().may_begin(end)? || self.judge().search(at + 1, end)?.is_none())
    }

    /// True if the summary lists another record inside this one.
    fn swallows(&self, at: u64, end: u64) -> bool {
        self.marks.records.range(at + 1..end).next().is_some()
    }

    /// Parses a message index, if it matches the chunk before it.
    fn follows_chunk(&self, body: &[u8]) -> Option<MessageIndex> {
        if self.index.is_empty() {
            return None;
        }
        let (index, used) = fields::<MessageIndex>(op::MESSAGE_INDEX, body)?;
        let is_it = used == body.len() && self.index.get(&index.channel_id) == Some(&index.records);
        is_it.then_some(index)
    }
}

/// Identifies a record whose number was changed to that of a message or to an unknown one: its fields fill it
/// to the last byte, which those of a message do not by chance.
fn disguised(number: u8, body: &[u8]) -> Option<(u8, Kind)> {
    if number != op::MESSAGE && number <= op::DATA_END {
        return None;
    }
    [op::CHANNEL, op::METADATA_INDEX, op::HEADER].into_iter().find_map(|other| match parse(other, body) {
        Some((kind, true)) => Some((other, kind)),
        _ => None,
    })
}
