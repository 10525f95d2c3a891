//! Iterates over the records of a recording up to the last intact one. One buffer serves them all.

use super::append::HEAD;
use super::library::foreign_wire;
use super::texts::parse_record;
use crate::error::{Context, RecordingError, Result};
use crate::files::input;
use mcap::MAGIC;
use mcap::records::{Record, op};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// Longest header that is looked at.
const LONGEST_HEADER: u64 = 1 << 16;

/// Head of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Head {
    /// Offset of the record.
    pub offset: u64,
    /// Opcode of the record.
    pub op: u8,
    /// Size of its body.
    pub length: u64,
}

impl Head {
    /// Decodes the bytes at `offset`.
    pub(super) fn read(offset: u64, bytes: [u8; HEAD]) -> Head {
        let [op, length @ ..] = bytes;
        Head { offset, op, length: u64::from_le_bytes(length) }
    }

    /// Offset of its body.
    pub(super) fn body(&self) -> u64 {
        self.offset.saturating_add(HEAD as u64)
    }

    /// Offset of the next record; saturates, because a damaged length may be any number.
    pub fn end(&self) -> u64 {
        self.body().saturating_add(self.length)
    }
}

/// A record as stored in the file or in a chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RawRecord<'a> {
    /// Offset of the record.
    pub offset: u64,
    /// Opcode of the record.
    pub op: u8,
    /// Contents of the record.
    pub body: &'a [u8],
}

impl RawRecord<'_> {
    /// Offset of the next record.
    pub fn end(&self) -> u64 {
        self.offset + (HEAD + self.body.len()) as u64
    }
}

/// Iterates over the records of a file.
#[derive(Debug)]
pub struct Records {
    input: BufReader<File>,
    offset: u64,
    length: u64,
    body: Vec<u8>,
}

impl Records {
    /// Opens a file.
    pub fn open(path: &Path) -> Result<Records> {
        let place = || format!("{} cannot be read", path.display());
        let file = input::open(path).with_context(place)?;
        let length = file.metadata().with_context(place)?.len();
        let mut input = BufReader::new(file);
        let mut magic = [0; MAGIC.len()];
        if input.read_exact(&mut magic).is_err() || magic != MAGIC {
            return Err(RecordingError::NotMcap { path: path.into() }.into());
        }
        let mut records = Records { input, offset: MAGIC.len() as u64, length, body: Vec::new() };
        if let Some(why) = records.library()?.and_then(|library| foreign_wire(&library)) {
            return Err(RecordingError::Unsupported(format!("{}: {why}", path.display())).into());
        }
        Ok(records)
    }

    /// Name of the library in the header; none if it cannot be read. The position is unchanged.
    fn library(&mut self) -> Result<Option<String>> {
        let start = self.offset;
        let header = self.next_short(LONGEST_HEADER)?.filter(|record| record.op == op::HEADER);
        let record = header.and_then(|record| parse_record(record.op, record.body).ok());
        let library = match record {
            Some(Record::Header(header)) => Some(header.library),
            _ => None,
        };
        self.go_to(start)?;
        Ok(library)
    }

    /// Opens a file at the record with this offset.
    pub(crate) fn open_at(path: &Path, offset: u64) -> Result<Records> {
        let mut records = Records::open(path)?;
        records.go_to(offset).with_context(|| format!("{} cannot be read", path.display()))?;
        Ok(records)
    }

    /// Moves to the record at an offset.
    pub fn go_to(&mut self, offset: u64) -> Result<()> {
        // A move within the buffer costs nothing.
        match offset.checked_signed_diff(self.offset) {
            Some(step) => self.input.seek_relative(step)?,
            None => _ = self.input.seek(SeekFrom::Start(offset))?,
        }
        self.offset = offset;
        Ok(())
    }

    /// Head of the next record, to be followed by [`Records::body`] or [`Records::go_to`]. None if the rest
    /// is not a complete record; then the position is unchanged.
    pub(crate) fn next_head(&mut self) -> Result<Option<Head>> {
        let mut bytes = [0; HEAD];
        if self.length.saturating_sub(self.offset) < HEAD as u64 {
            return Ok(None);
        }
        self.input.read_exact(&mut bytes)?;
        let head = Head::read(self.offset, bytes);
        self.offset += HEAD as u64;
        if head.end() > self.length {
            self.go_to(head.offset)?;
            return Ok(None);
        }
        Ok(Some(head))
    }

    /// The record of the last head.
    pub fn body(&mut self, head: Head) -> Result<RawRecord<'_>> {
        // At most the bytes that the file has.
        let length = head.length as usize;
        if self.body.len() < length {
            self.body.resize(length, 0);
        }
        let body = &mut self.body[..length];
        self.input.read_exact(body)?;
        self.offset = head.end();
        Ok(RawRecord { offset: head.offset, op: head.op, body })
    }

    /// Next record; none if the rest is not a complete record.
    pub fn next_record(&mut self) -> Result<Option<RawRecord<'_>>> {
        match self.next_head()? {
            Some(head) => self.body(head).map(Some),
            None => Ok(None),
        }
    }

    /// Next record of at most `longest` bytes; none if it is longer, or the rest is not a complete record.
    pub(crate) fn next_short(&mut self, longest: u64) -> Result<Option<RawRecord<'_>>> {
        match self.next_head()? {
            Some(head) if head.length <= longest => self.body(head).map(Some),
            _ => Ok(None),
        }
    }

    /// The following bytes, at most `count`.
    pub fn rest(&mut self, count: u64) -> Result<Vec<u8>> {
        let mut rest = Vec::new();
        let read = self.input.by_ref().take(count).read_to_end(&mut rest)?;
        self.offset += read as u64;
        Ok(rest)
    }

    /// Offset of the next record.
    pub fn offset(&self) -> u64 {
        self.offset
    }

    /// Size of the file.
    pub fn length(&self) -> u64 {
        self.length
    }
}

/// Iterates over the records in a chunk's uncompressed bytes.
#[derive(Debug, Clone)]
pub struct Inside<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl<'a> Inside<'a> {
    /// Begins at an offset.
    pub fn of(bytes: &'a [u8], offset: usize) -> Inside<'a> {
        Inside { bytes, offset }
    }

    /// Offset of the next record.
    pub fn offset(&self) -> usize {
        self.offset
    }
}

impl<'a> Iterator for Inside<'a> {
    type Item = RawRecord<'a>;

    /// None if the rest is not a complete record.
    fn next(&mut self) -> Option<RawRecord<'a>> {
        let rest = self.bytes.get(self.offset..)?;
        let (head, rest) = rest.split_first_chunk()?;
        let head = Head::read(self.offset as u64, *head);
        let body = rest.get(..usize::try_from(head.length).ok()?)?;
        self.offset += HEAD + body.len();
        Some(RawRecord { offset: head.offset, op: head.op, body })
    }
}
