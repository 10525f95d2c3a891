//! The records of a recording, one after the other, as far as they go.

use super::append::HEAD;
use anyhow::{Context, Result, bail};
use mcap::MAGIC;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// A record as it lies in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RawRecord {
    /// Where it begins.
    pub offset: u64,
    /// Its number.
    pub op: u8,
    /// What it holds.
    pub body: Vec<u8>,
}

impl RawRecord {
    /// Where the next begins.
    pub fn end(&self) -> u64 {
        self.offset + (HEAD + self.body.len()) as u64
    }
}

/// Goes through the records of a file or of a chunk.
#[derive(Debug)]
pub struct Records<R> {
    input: R,
    offset: u64,
    length: u64,
}

impl Records<BufReader<File>> {
    /// Of a file.
    pub fn open(path: &Path) -> Result<Records<BufReader<File>>> {
        let place = || format!("{} cannot be read", path.display());
        let file = File::open(path).with_context(place)?;
        if path.is_dir() {
            bail!("{} is a folder", path.display());
        }
        let length = file.metadata().with_context(place)?.len();
        let mut input = BufReader::new(file);
        let mut magic = [0; MAGIC.len()];
        if input.read_exact(&mut magic).is_err() || magic != MAGIC {
            bail!("{} is no MCAP file", path.display());
        }
        Ok(Records { input, offset: MAGIC.len() as u64, length })
    }

    /// Of a file, from the record that begins there.
    pub fn open_at(path: &Path, offset: u64) -> Result<Records<BufReader<File>>> {
        let mut records = Records::open(path)?;
        records
            .input
            .seek(SeekFrom::Start(offset))
            .with_context(|| format!("{} cannot be read", path.display()))?;
        records.offset = offset;
        Ok(records)
    }
}

impl<'a> Records<&'a [u8]> {
    /// Of a chunk's plain bytes.
    pub fn of_chunk(bytes: &'a [u8]) -> Records<&'a [u8]> {
        Records { input: bytes, offset: 0, length: bytes.len() as u64 }
    }
}

impl<R: Read> Records<R> {
    /// The next record; none: the rest is no whole record.
    pub fn next_record(&mut self) -> Result<Option<RawRecord>> {
        let mut head = [0; HEAD];
        let left = self.length.saturating_sub(self.offset);
        if left < HEAD as u64 {
            return Ok(None);
        }
        self.input.read_exact(&mut head)?;
        let [op, length @ ..] = head;
        let length = u64::from_le_bytes(length);
        if length > left - HEAD as u64 {
            return Ok(None);
        }
        // No more than the file has.
        let mut body = vec![0; length as usize];
        self.input.read_exact(&mut body)?;
        let record = RawRecord { offset: self.offset, op, body };
        self.offset = record.end();
        Ok(Some(record))
    }

    /// The bytes that follow, at most `count`.
    pub fn rest(&mut self, count: u64) -> Result<Vec<u8>> {
        let mut rest = Vec::new();
        self.input.by_ref().take(count).read_to_end(&mut rest)?;
        Ok(rest)
    }

    /// Bytes of all.
    pub fn length(&self) -> u64 {
        self.length
    }
}
