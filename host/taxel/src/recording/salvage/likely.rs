//! Judges by its fields whether a record begins at an offset.

use super::super::append::HEAD;
use super::super::source::RandomAccess;
use super::marks::Marks;
use super::opened;
use super::piece::{Kind, parse};
use mcap::records::op;
use std::collections::BTreeSet;
use std::io;

/// Size of the largest record whose body is examined; larger ones are judged by their head.
const LOOK: u64 = 1 << 16;
/// Bytes of a chunk that hold its fields.
const FIELDS: u64 = 256;
/// Size of a message's fields.
const MESSAGE: u64 = 22;
/// Bytes searched at once.
const BLOCK: u64 = 1 << 16;

/// Confidence that a record begins at an offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Trust {
    No,
    /// Head that fits into the file, as random bytes might.
    Head,
    /// Fields that fill it to the last byte.
    Fields,
}

/// Distinguishes records from other bytes.
#[derive(Debug)]
pub struct Judge<'a> {
    /// The file.
    pub source: &'a mut RandomAccess,
    /// Places listed by the file's end.
    pub marks: &'a Marks,
    /// Channels declared so far.
    pub channels: &'a BTreeSet<u16>,
}

impl Judge<'_> {
    /// True if a record may begin there, or the file ends.
    pub fn may_begin(&mut self, at: u64) -> io::Result<bool> {
        Ok(self.trust(at)?.0 > Trust::No)
    }

    /// First offset of `from..until` at which a record certainly begins.
    pub fn search(&mut self, from: u64, until: u64) -> io::Result<Option<u64>> {
        let stated = self.marks.records.range(from..until.max(from)).next().copied();
        let until = stated.unwrap_or(until);
        let mut block = from;
        while block < until {
            let bytes = self.source.read(block, BLOCK.min(until - block))?;
            for at in
                (block..).zip(&bytes).filter(|(_, op)| (1..=op::DATA_END).contains(*op)).map(|(at, _)| at)
            {
                if self.begins(at)? {
                    return Ok(Some(at));
                }
            }
            block += BLOCK;
        }
        Ok(stated)
    }

    /// True if a record certainly begins there: by itself, or by what follows it.
    fn begins(&mut self, at: u64) -> io::Result<bool> {
        Ok(match self.trust(at)? {
            (Trust::No, _) => false,
            (Trust::Fields, _) => true,
            (Trust::Head, end) => self.trust(end)?.0 > Trust::No,
        })
    }

    /// Confidence that a record begins there, and the offset of its end.
    fn trust(&mut self, at: u64) -> io::Result<(Trust, u64)> {
        let is_known = self.marks.records.contains(&at);
        if is_known || at == self.source.length() || self.source.is_tail(at)? {
            return Ok((Trust::Fields, at));
        }
        let Some(head) = self.source.head(at)? else { return Ok((Trust::No, at)) };
        if head.length > self.source.behind(at) {
            return Ok((Trust::No, at));
        }
        let (from, end) = (at + HEAD as u64, at + HEAD as u64 + head.length);
        let trust = match head.op {
            0 => Trust::No,
            op::MESSAGE => self.message(from, head.length)?,
            op::CHUNK => match opened::header(&self.source.read(from, head.length.min(FIELDS))?) {
                Some((chunk, used))
                    if chunk.compressed_size.checked_add(used as u64) == Some(head.length) =>
                {
                    Trust::Fields
                }
                _ => Trust::No,
            },
            number if number > op::DATA_END || head.length > LOOK => Trust::Head,
            number => match parse(number, &self.source.read(from, head.length)?) {
                // So few bytes may fit by chance.
                Some((Kind::Summary, true)) => Trust::Head,
                Some((_, true)) => Trust::Fields,
                _ => Trust::No,
            },
        };
        Ok((trust, end))
    }

    /// Judges a message by whether its channel is known.
    fn message(&mut self, from: u64, length: u64) -> io::Result<Trust> {
        if length < MESSAGE {
            return Ok(Trust::No);
        }
        let bytes = self.source.read(from, 2)?;
        let channel = bytes.first_chunk().map(|bytes| u16::from_le_bytes(*bytes));
        let is_known = channel.is_some_and(|channel| {
            self.channels.contains(&channel) || self.marks.channels.contains_key(&channel)
        });
        Ok(if is_known { Trust::Head } else { Trust::No })
    }
}
