//! Writes a recording.
//!
//! The file consists of whole records at any time: records outside chunks, and chunks with their index, are
//! appended in one piece, and a partial write is truncated before anything else is written. A kill between
//! two pieces leaves a file without its end, which [`repair`](super::repair()) adds.

use super::append::{append, sized, write};
use super::chunk::FullChunk;
use super::contents::Contents;
use super::ending::Ending;
use super::filler::Filler;
use super::library::library;
use super::store::Store;
use super::written::Written;
use crate::error::{Error, Result};
use mcap::MAGIC;
use mcap::records::{
    AttachmentHeader, AttachmentIndex, Channel, Header, Metadata, MetadataIndex, SchemaHeader, op,
};
use std::collections::BTreeMap;

/// Bytes of the end written at once.
const PIECE: usize = 1 << 16;

/// Format of a channel's messages.
#[derive(Debug, Clone, Copy)]
pub struct Format<'a> {
    /// Encoding of messages: `json`, `cdr`, ...
    pub encoding: &'a str,
    /// Name of the schema; empty if there is none.
    pub schema: &'a str,
    /// Encoding of the schema: `jsonschema`, `ros2msg`, `protobuf`.
    pub schema_encoding: &'a str,
    /// The schema.
    pub text: &'a [u8],
}

/// A recording being written.
#[derive(Debug)]
pub struct Writer<S: Store> {
    store: S,
    is_readable: bool,
    /// Bytes of whole records.
    length: u64,
    /// Bytes of a partial record may be behind them.
    torn: bool,
    /// Without the chunks, which are read back for the end if the store can be read.
    contents: Contents,
    /// Messages of the writer itself.
    messages: Filler,
}

impl<S: Store> Writer<S> {
    /// Begins a file. `profile` is MCAP's: `ros2`, or empty.
    pub fn create(mut store: S, profile: &str) -> Result<Writer<S>> {
        let mut writer = Writer {
            is_readable: store.look(0, &mut [0]).is_ok(),
            store,
            length: 0,
            torn: false,
            contents: Contents::default(),
            messages: Filler::default(),
        };
        let mut out = MAGIC.to_vec();
        append(&mut out, op::HEADER, &Header { profile: profile.into(), library: library() }, &[])?;
        writer.put(&out)?;
        Ok(writer)
    }

    /// Appends all of it, or nothing.
    fn put(&mut self, bytes: &[u8]) -> Result<()> {
        if self.torn {
            self.cut(self.length)?;
        }
        let written = self.store.write_all(bytes).and_then(|()| self.store.flush());
        if let Err(error) = written {
            let error = Error::from(error);
            return Err(match self.cut(self.length) {
                Ok(()) => error,
                Err(_) => error.context("its last record is incomplete"),
            });
        }
        self.length += bytes.len() as u64;
        Ok(())
    }

    /// Truncates to `length` bytes.
    fn cut(&mut self, length: u64) -> Result<()> {
        self.torn = true;
        self.store.cut(length)?;
        (self.torn, self.length) = (false, length);
        Ok(())
    }

    /// Adds a channel and its schema. Returns its number.
    pub fn channel(&mut self, topic: &str, format: &Format<'_>) -> Result<u16> {
        let mut out = Vec::new();
        let schema_id = if format.schema.is_empty() { 0 } else { self.schema(format, &mut out)? };
        let id = self.contents.channels.len() as u16 + 1;
        let channel = Channel {
            id,
            schema_id,
            topic: topic.into(),
            message_encoding: format.encoding.into(),
            metadata: BTreeMap::new(),
        };
        append(&mut out, op::CHANNEL, &channel, &[])?;
        self.put(&out)?;
        self.contents.channels.insert(id, channel);
        Ok(id)
    }

    fn schema(&mut self, format: &Format<'_>, out: &mut Vec<u8>) -> Result<u16> {
        let known = self.contents.schemas.values().find(|(header, _)| header.name == format.schema);
        if let Some((header, _)) = known {
            return Ok(header.id);
        }
        let id = self.contents.schemas.len() as u16 + 1;
        let header = SchemaHeader { id, name: format.schema.into(), encoding: format.schema_encoding.into() };
        append(out, op::SCHEMA, &header, &sized(format.text))?;
        self.contents.schemas.insert(id, (header, format.text.to_vec()));
        Ok(id)
    }

    /// Adds a message; times in ns. It is on the disk after the next [`Writer::flush`].
    pub fn message(&mut self, channel_id: u16, log_time: u64, publish_time: u64, data: &[u8]) -> Result<()> {
        self.messages.message(channel_id, log_time, publish_time, |out| {
            out.extend_from_slice(data);
            Ok(())
        })?;
        let full = self.messages.take();
        self.write(full)
    }

    /// Writes chunks of a [`Filler`]. On error the file is as it was before the chunk that could not be written;
    /// that one and those after it are lost.
    pub fn write(&mut self, full: Vec<FullChunk>) -> Result<()> {
        for chunk in full {
            let mut out = Vec::new();
            let closed = chunk.append(self.length, &mut out)?;
            self.put(&out)?;
            if !self.is_readable {
                self.contents.chunks.push(closed);
            }
        }
        Ok(())
    }

    /// Adds an attachment with the time `ns`.
    pub fn attach(&mut self, name: &str, media_type: &str, data: &[u8], ns: u64) -> Result<()> {
        let header = AttachmentHeader {
            log_time: ns,
            create_time: ns,
            name: name.into(),
            media_type: media_type.into(),
        };
        let mut body = Vec::new();
        write(&mut body, &header)?;
        let mut rest = (data.len() as u64).to_le_bytes().to_vec();
        rest.extend_from_slice(data);
        body.extend_from_slice(&rest);
        rest.extend(crc32fast::hash(&body).to_le_bytes());
        let mut out = Vec::new();
        append(&mut out, op::ATTACHMENT, &header, &rest)?;
        let index = AttachmentIndex {
            offset: self.length,
            length: out.len() as u64,
            log_time: ns,
            create_time: ns,
            data_size: data.len() as u64,
            name: header.name,
            media_type: header.media_type,
        };
        self.put(&out)?;
        self.contents.attachments.push(index);
        Ok(())
    }

    /// Adds metadata.
    pub fn metadata(&mut self, name: &str, words: BTreeMap<String, String>) -> Result<()> {
        let mut out = Vec::new();
        append(&mut out, op::METADATA, &Metadata { name: name.into(), metadata: words }, &[])?;
        let index = MetadataIndex { offset: self.length, length: out.len() as u64, name: name.into() };
        self.put(&out)?;
        self.contents.metadata.push(index);
        Ok(())
    }

    /// Ends the chunk: readers can seek to the next one.
    pub fn close(&mut self) -> Result<()> {
        self.messages.close();
        let full = self.messages.take();
        self.write(full)
    }

    /// Flushes the messages so far to the disk. On error they are lost, and the file is as before.
    pub fn flush(&mut self) -> Result<()> {
        self.close()?;
        Ok(self.store.keep()?)
    }

    /// Writes the end. Returns the size of the file. On error the file stays without its end but with all its
    /// contents; [`repair`](super::repair()) adds the end.
    pub fn finish(mut self) -> Result<u64> {
        let closed = self.close();
        let records = self.length;
        if let Err(error) = self.end() {
            // A part of the end that stays is handled as torn bytes.
            _ = self.cut(records);
            return Err(error);
        }
        self.store.keep()?;
        closed.map(|()| self.length)
    }

    /// Writes the end, or a part of it.
    fn end(&mut self) -> Result<()> {
        let mut ending = Ending::begin(&self.contents, self.length)?;
        self.contents.chunks.iter().try_for_each(|chunk| ending.chunk(chunk))?;
        let mut written = Written::until(if self.is_readable { self.length } else { 0 });
        while let Some(chunk) = written.next_chunk(&mut self.store)? {
            ending.chunk(&chunk)?;
            if ending.waiting() >= PIECE {
                let piece = ending.take();
                self.put(&piece)?;
            }
        }
        let last = ending.finish(&self.contents)?;
        self.put(&last)
    }

    /// Bytes written so far, without those of the open chunk.
    pub fn bytes(&self) -> u64 {
        self.length
    }
}
