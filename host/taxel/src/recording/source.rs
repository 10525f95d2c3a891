//! Reads bytes of a file at any offset.

use super::append::HEAD;
use crate::error::{Context, Result};
use crate::files::input;
use mcap::MAGIC;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

/// Size of the magic at the end of a file.
const TAIL: u64 = MAGIC.len() as u64;

/// A file with random access.
#[derive(Debug)]
pub struct RandomAccess {
    input: BufReader<File>,
    at: u64,
    length: u64,
}

/// Head of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RawHead {
    /// The record's number.
    pub op: u8,
    /// Size of its body.
    pub length: u64,
}

impl RandomAccess {
    /// Opens a file.
    pub fn open(path: &Path) -> Result<RandomAccess> {
        let place = || format!("{} cannot be read", path.display());
        let file = input::open(path).with_context(place)?;
        let length = file.metadata().with_context(place)?.len();
        Ok(RandomAccess { input: BufReader::with_capacity(1 << 16, file), at: 0, length })
    }

    /// Size of the file.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Reads at most `count` bytes from an offset.
    pub fn read(&mut self, at: u64, count: u64) -> io::Result<Vec<u8>> {
        // Within the buffer this moves without reading.
        self.input.seek_relative(at as i64 - self.at as i64)?;
        self.at = at;
        let mut bytes = Vec::with_capacity(count.min(self.length.saturating_sub(at)) as usize);
        let read = self.input.by_ref().take(count).read_to_end(&mut bytes);
        self.at += bytes.len() as u64;
        read.map(|_| bytes)
    }

    /// Head of the record at an offset; none if the file ends before.
    pub fn head(&mut self, at: u64) -> io::Result<Option<RawHead>> {
        let bytes = self.read(at, HEAD as u64)?;
        Ok(bytes.split_first_chunk().and_then(|([op], length)| {
            Some(RawHead { op: *op, length: u64::from_le_bytes(length.try_into().ok()?) })
        }))
    }

    /// Bytes of the file behind a record's head.
    pub fn behind(&self, at: u64) -> u64 {
        self.length.saturating_sub(at + HEAD as u64)
    }

    /// True if only the magic is left at this offset.
    pub(crate) fn is_tail(&mut self, at: u64) -> io::Result<bool> {
        Ok(at + TAIL == self.length && self.read(at, TAIL)? == MAGIC)
    }
}
