//! The records of a recording, one after the other, as far as they go. One buffer serves all of them.

use super::append::HEAD;
use anyhow::{Context, Result, bail};
use mcap::MAGIC;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// What stands before a record's body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Head {
    /// Where the record begins.
    pub offset: u64,
    /// Its number.
    pub op: u8,
    /// Bytes of its body.
    pub length: u64,
}

impl Head {
    /// From the bytes at `offset`.
    pub(super) fn read(offset: u64, bytes: [u8; HEAD]) -> Head {
        let [op, length @ ..] = bytes;
        Head { offset, op, length: u64::from_le_bytes(length) }
    }

    /// Where the next record begins; a damaged length may lie beyond all numbers.
    pub fn end(&self) -> u64 {
        self.offset.saturating_add(HEAD as u64).saturating_add(self.length)
    }
}

/// A record as it lies in the file or in a chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RawRecord<'a> {
    /// Where it begins.
    pub offset: u64,
    /// Its number.
    pub op: u8,
    /// What it holds.
    pub body: &'a [u8],
}

impl RawRecord<'_> {
    /// Where the next begins.
    pub fn end(&self) -> u64 {
        self.offset + (HEAD + self.body.len()) as u64
    }
}

/// Goes through the records of a file.
#[derive(Debug)]
pub struct Records {
    input: BufReader<File>,
    offset: u64,
    length: u64,
    body: Vec<u8>,
}

impl Records {
    /// Of a file.
    pub fn open(path: &Path) -> Result<Records> {
        let place = || format!("{} cannot be read", path.display());
        crate::verbose::reads(path);
        let file = File::open(path).with_context(place)?;
        if path.is_dir() {
            bail!("{} is a folder", path.display());
        }
        let length = file.metadata().with_context(place)?.len();
        let mut input = BufReader::new(file);
        let mut magic = [0; MAGIC.len()];
        if input.read_exact(&mut magic).is_err() || magic != MAGIC {
            bail!("{} is not an MCAP file", path.display());
        }
        Ok(Records { input, offset: MAGIC.len() as u64, length, body: Vec::new() })
    }

    /// Of a file, from the record that begins there.
    pub fn open_at(path: &Path, offset: u64) -> Result<Records> {
        let mut records = Records::open(path)?;
        records.go_to(offset).with_context(|| format!("{} cannot be read", path.display()))?;
        Ok(records)
    }

    /// Goes on with the record that begins there.
    pub fn go_to(&mut self, offset: u64) -> Result<()> {
        // A step within the buffer costs nothing.
        match offset.checked_signed_diff(self.offset) {
            Some(step) => self.input.seek_relative(step)?,
            None => _ = self.input.seek(SeekFrom::Start(offset))?,
        }
        self.offset = offset;
        Ok(())
    }

    /// The head of the next record, which [`Records::body`] or [`Records::go_to`] must follow; none: the rest
    /// is no whole record, and the place is as before.
    pub fn next_head(&mut self) -> Result<Option<Head>> {
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

    /// The record of the head that was read last.
    pub fn body(&mut self, head: Head) -> Result<RawRecord<'_>> {
        // No more than the file has.
        let length = head.length as usize;
        if self.body.len() < length {
            self.body.resize(length, 0);
        }
        let body = &mut self.body[..length];
        self.input.read_exact(body)?;
        self.offset = head.end();
        Ok(RawRecord { offset: head.offset, op: head.op, body })
    }

    /// The next record; none: the rest is no whole record.
    pub fn next_record(&mut self) -> Result<Option<RawRecord<'_>>> {
        match self.next_head()? {
            Some(head) => self.body(head).map(Some),
            None => Ok(None),
        }
    }

    /// The next record, if it has at most so many bytes; none: it is longer, or the rest is no whole record.
    pub fn next_short(&mut self, longest: u64) -> Result<Option<RawRecord<'_>>> {
        match self.next_head()? {
            Some(head) if head.length <= longest => self.body(head).map(Some),
            _ => Ok(None),
        }
    }

    /// The bytes that follow, at most `count`.
    pub fn rest(&mut self, count: u64) -> Result<Vec<u8>> {
        let mut rest = Vec::new();
        let read = self.input.by_ref().take(count).read_to_end(&mut rest)?;
        self.offset += read as u64;
        Ok(rest)
    }

    /// Where the next record begins.
    pub fn offset(&self) -> u64 {
        self.offset
    }

    /// Bytes of all.
    pub fn length(&self) -> u64 {
        self.length
    }
}

/// Goes through the records of a chunk's plain bytes.
#[derive(Debug, Clone)]
pub struct Inside<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl<'a> Inside<'a> {
    /// From an offset on.
    pub fn of(bytes: &'a [u8], offset: usize) -> Inside<'a> {
        Inside { bytes, offset }
    }

    /// Where the next record begins.
    pub fn offset(&self) -> usize {
        self.offset
    }
}

impl<'a> Iterator for Inside<'a> {
    type Item = RawRecord<'a>;

    /// None: the rest is no whole record.
    fn next(&mut self) -> Option<RawRecord<'a>> {
        let rest = self.bytes.get(self.offset..)?;
        let (head, rest) = rest.split_first_chunk()?;
        let head = Head::read(self.offset as u64, *head);
        let body = rest.get(..usize::try_from(head.length).ok()?)?;
        self.offset += HEAD + body.len();
        Some(RawRecord { offset: head.offset, op: head.op, body })
    }
}
