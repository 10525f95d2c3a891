//! Rewrites a damaged or truncated recording: everything readable, and an end.
//!
//! Chunks are copied in compressed form, including those of other compressions, as are unknown records. Left
//! out is what no reader could read: chunks that fail their checksum, and bytes that are not a record.

use super::append::{append, sized};
use super::chunk::{Closed, Index};
use super::contents::Contents;
use super::ending::Ending;
use super::library::library;
use super::salvage::{Kind, Opened, Piece, Walk, WalkStep};
use super::scan::Scan;
use crate::error::Result;
use crate::text::progress::{Progress, Unit};
use binrw::BinWrite;
use mcap::MAGIC;
use mcap::records::{Channel, ChunkHeader, Header, SchemaHeader, op};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::Path;

/// Writes the readable parts of the scanned file. Returns the bytes written.
pub fn repair(path: &Path, scan: &Scan, out: &mut impl Write) -> Result<u64> {
    let mut walk = Walk::open(path)?;
    let (schemas, channels) = (scan.contents.schemas.clone(), scan.contents.channels.clone());
    let contents = Contents { schemas, channels, ..Contents::default() };
    let stated = Copied::default();
    let mut rebuilt = Rebuilt { out, length: 0, contents, stated, follows_foreign: false };
    rebuilt.begin(scan)?;
    let what = format!("repairing {}", path.display());
    let mut progress = Progress::of(what, Unit::Bytes, Some(walk.length()));
    while let Some(step) = walk.next_step()? {
        progress.at(walk.passed());
        match step {
            WalkStep::Piece(piece) => rebuilt.take(piece)?,
            WalkStep::Unreadable(_) => rebuilt.follows_foreign = false,
        }
    }
    rebuilt.end()?;
    Ok(rebuilt.length)
}

/// Numbers of schemas and channels already written to the new file.
#[derive(Debug, Default)]
struct Copied {
    schemas: BTreeSet<u16>,
    channels: BTreeSet<u16>,
}

/// The new file.
struct Rebuilt<'a, W> {
    out: &'a mut W,
    length: u64,
    /// Contents of the new file; all schemas and channels of the old one.
    contents: Contents,
    stated: Copied,
    /// The previous record is a chunk that cannot be read here (compression or size), or an index of its
    /// messages.
    follows_foreign: bool,
}

impl<W: Write> Rebuilt<'_, W> {
    fn begin(&mut self, scan: &Scan) -> Result<()> {
        self.put(MAGIC)?;
        let lost = || Header { profile: String::new(), library: library() };
        self.record(op::HEADER, &scan.header.clone().unwrap_or_else(lost), &[])?;
        if scan.foreign > 0 && !scan.damage.is_empty() {
            // A channel from a lost chunk may be needed by a chunk that cannot be read here.
            let channels: Vec<_> = self.contents.channels.keys().copied().collect();
            channels.into_iter().try_for_each(|channel| self.channel(channel))?;
        }
        Ok(())
    }

    fn take(&mut self, piece: Piece) -> Result<()> {
        let follows_foreign = std::mem::take(&mut self.follows_foreign);
        match piece.kind {
            Kind::Schema(header, _) => self.schema(header.id)?,
            Kind::Channel(channel) => self.channel(channel.id)?,
            Kind::Message(header) => {
                self.channel(header.channel_id)?;
                self.raw(piece.op, &piece.body)?;
                self.contents.count_loose(header.channel_id, header.log_time);
            }
            Kind::Chunk(header, Some(inside)) => self.chunk(&header, &inside, &piece.body)?,
            Kind::Chunk(header, None) => {
                let (offset, length) = self.raw(piece.op, &piece.body)?;
                self.contents.chunk(&header, &Index::new(), offset, length);
                self.follows_foreign = true;
            }
            Kind::Index(index) if follows_foreign => {
                let (offset, length) = self.raw(piece.op, &piece.body)?;
                self.contents.message_index(&index, offset, length);
                self.follows_foreign = true;
            }
            Kind::Attachment(header, size) => {
                let (offset, length) = self.raw(piece.op, &piece.body)?;
                self.contents.attachment(header, size, offset, length);
            }
            Kind::Metadata(metadata) => {
                let (offset, length) = self.raw(piece.op, &piece.body)?;
                self.contents.words(&metadata.name, offset, length);
            }
            Kind::Unknown => _ = self.raw(piece.op, &piece.body)?,
            // Written anew below.
            Kind::Header(_) | Kind::BadChunk | Kind::Index(_) | Kind::Summary | Kind::Footer => {}
        }
        Ok(())
    }

    /// Copies a chunk, with the schemas and channels of its messages, and its indexes.
    fn chunk(&mut self, header: &ChunkHeader, inside: &Opened, body: &[u8]) -> Result<()> {
        self.stated.schemas.extend(inside.schemas.iter().map(|(header, _)| header.id));
        for channel in &inside.channels {
            self.schema(channel.schema_id)?;
            self.stated.channels.insert(channel.id);
        }
        inside.index.keys().try_for_each(|channel| self.channel(*channel))?;
        let (offset, length) = self.raw(op::CHUNK, body)?;
        let mut indexes = Vec::new();
        let closed = Closed::indexed(header, &inside.index, offset, length, &mut indexes)?;
        self.contents.chunks.push(closed);
        self.put(&indexes)
    }

    /// Writes a channel unless written already. A lost one gets a name that says so.
    fn channel(&mut self, id: u16) -> Result<()> {
        if !self.stated.channels.insert(id) {
            return Ok(());
        }
        let lost = || Channel {
            id,
            schema_id: 0,
            topic: format!("/lost/{id}"),
            message_encoding: String::new(),
            metadata: BTreeMap::new(),
        };
        let channel = self.contents.channels.entry(id).or_insert_with(lost).clone();
        self.schema(channel.schema_id)?;
        self.record(op::CHANNEL, &channel, &[])
    }

    /// Writes a schema unless written already. A lost one is empty.
    fn schema(&mut self, id: u16) -> Result<()> {
        // Number 0 is no schema.
        if id == 0 || !self.stated.schemas.insert(id) {
            return Ok(());
        }
        let lost = || (SchemaHeader { id, name: format!("lost/{id}"), encoding: String::new() }, Vec::new());
        let (header, data) = self.contents.schemas.entry(id).or_insert_with(lost).clone();
        self.record(op::SCHEMA, &header, &sized(&data))
    }

    fn record<F>(&mut self, number: u8, fields: &F, data: &[u8]) -> Result<()>
    where
        F: for<'a> BinWrite<Args<'a> = ()>,
    {
        let mut bytes = Vec::new();
        append(&mut bytes, number, fields, data)?;
        self.put(&bytes)
    }

    /// Copies a record. Returns its offset and size.
    fn raw(&mut self, number: u8, body: &[u8]) -> Result<(u64, u64)> {
        let offset = self.length;
        self.put(&[number])?;
        self.put(&(body.len() as u64).to_le_bytes())?;
        self.put(body)?;
        Ok((offset, self.length - offset))
    }

    fn end(&mut self) -> Result<()> {
        // Only in the old summary, and not needed so far.
        let (channels, schemas) =
            (self.contents.channels.keys().copied(), self.contents.schemas.keys().copied());
        let (channels, schemas): (Vec<_>, Vec<_>) = (channels.collect(), schemas.collect());
        channels.into_iter().try_for_each(|channel| self.channel(channel))?;
        schemas.into_iter().try_for_each(|schema| self.schema(schema))?;
        let mut ending = Ending::begin(&self.contents, self.length)?;
        self.contents.chunks.iter().try_for_each(|chunk| ending.chunk(chunk))?;
        let end = ending.finish(&self.contents)?;
        self.put(&end)
    }

    fn put(&mut self, bytes: &[u8]) -> Result<()> {
        self.out.write_all(bytes)?;
        self.length += bytes.len() as u64;
        Ok(())
    }
}
