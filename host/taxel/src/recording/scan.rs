//! Scans a file for its contents.

use super::chunk::Index;
use super::contents::Contents;
use super::salvage::{Kind, Piece, Unreadable, Walk, WalkStep};
use crate::error::Result;
use crate::text::progress::{Progress, Unit};
use mcap::records::{Header, Metadata, Statistics};
use std::path::Path;

/// Contents of a file.
#[derive(Debug)]
pub struct Scan {
    /// Readable contents, with their offsets.
    pub contents: Contents,
    /// The file has its end, and no known damage.
    pub whole: bool,
    /// The file has its end: a footer, which may be damaged.
    pub ended: bool,
    /// Bytes behind the readable part of a file without its end.
    pub torn: u64,
    /// Unreadable bytes, including those behind the readable part.
    pub damage: Vec<Unreadable>,
    /// Number of records that are readable although their number, length or fields are wrong in the file.
    pub corrected: usize,
    /// Number of chunks that cannot be read here because of their compression or size.
    pub foreign: usize,
    /// Metadata of the file.
    pub metadata: Vec<Metadata>,
    /// Library and profile.
    pub header: Option<Header>,
}

/// Scans a file.
pub fn scan(path: &Path) -> Result<Scan> {
    let mut walk = Walk::open(path)?;
    let ended = walk.marks.has_end;
    let mut scan = Scan {
        contents: Contents::default(),
        whole: false,
        ended,
        torn: 0,
        damage: Vec::new(),
        corrected: 0,
        foreign: 0,
        metadata: Vec::new(),
        header: None,
    };
    let what = format!("scanning {}", path.display());
    let mut progress = Progress::of(what, Unit::Bytes, Some(walk.length()));
    while let Some(step) = walk.next_step()? {
        progress.at(walk.passed());
        match step {
            WalkStep::Piece(piece) => scan.take(piece),
            WalkStep::Unreadable(damage) => scan.damage.push(damage),
        }
    }
    let last = scan.damage.last().filter(|last| !ended && last.offset + last.length == walk.length());
    scan.torn = last.map_or(0, |last| last.length);
    let is_counted = walk.marks.statistics.as_ref().is_none_or(|stated| scan.is_counted_by(stated));
    // The summary is covered by its own checksum.
    scan.contents.schemas.append(&mut walk.marks.schemas);
    scan.contents.channels.append(&mut walk.marks.channels);
    let is_sound = walk.marks.is_sound && scan.damage.is_empty() && scan.corrected == 0;
    scan.whole = is_sound && is_counted && scan.header.is_some();
    Ok(scan)
}

impl Scan {
    /// Number of unreadable chunks and bytes, without those behind the readable part of a file without its
    /// end.
    pub fn damaged(&self) -> (usize, u64) {
        let inside = self.damage.iter().take(self.damage.len() - usize::from(self.torn > 0));
        inside.fold((0, 0), |(chunks, bytes), damage| (chunks + damage.chunks, bytes + damage.length))
    }

    /// True if the numbers of records of each kind match the file's statistics; a record with a wrong number
    /// may pass for one of another kind. Records in unreadable chunks are not known.
    fn is_counted_by(&self, stated: &Statistics) -> bool {
        let found = &self.contents;
        let messages: u64 = found.counts().values().sum();
        let inside = [found.schemas.len() as u64, found.channels.len() as u64, messages];
        let beside =
            [found.attachments.len(), found.metadata.len(), found.chunks()].map(|count| count as u64);
        let is_read = self.foreign == 0;
        let stated_inside = [stated.schema_count.into(), stated.channel_count.into(), stated.message_count];
        (!is_read || inside == stated_inside)
            && beside == [stated.attachment_count, stated.metadata_count, stated.chunk_count].map(u64::from)
    }

    fn take(&mut self, piece: Piece) {
        let (offset, length) = (piece.offset, piece.end - piece.offset);
        self.corrected += usize::from(piece.is_corrected);
        let contents = &mut self.contents;
        match piece.kind {
            Kind::Header(header) => _ = self.header.get_or_insert(header),
            // Records in chunks are covered by a checksum, those outside are not.
            Kind::Schema(header, data) => _ = contents.schemas.entry(header.id).or_insert((header, data)),
            Kind::Channel(channel) => _ = contents.channels.entry(channel.id).or_insert(channel),
            Kind::Message(header) => contents.count_loose(header.channel_id, header.log_time),
            Kind::Chunk(header, Some(inside)) => {
                let stated = inside.schemas.into_iter().map(|(header, data)| (header.id, (header, data)));
                contents.schemas.extend(stated);
                contents.channels.extend(inside.channels.into_iter().map(|channel| (channel.id, channel)));
                contents.chunk(&header, &inside.index, offset, length);
            }
            Kind::Chunk(header, None) => {
                self.foreign += 1;
                contents.chunk(&header, &Index::new(), offset, length);
            }
            Kind::Index(index) => contents.message_index(&index, offset, length),
            Kind::Attachment(header, size) => contents.attachment(header, size, offset, length),
            Kind::Metadata(metadata) => {
                contents.words(&metadata.name, offset, length);
                self.metadata.push(metadata);
            }
            Kind::BadChunk | Kind::Summary | Kind::Footer | Kind::Unknown => {}
        }
    }
}
