//! Places of records listed by the end of a file.

use super::super::source::RandomAccess;
use super::super::summary::End;
use mcap::records::{Channel, Record, SchemaHeader, Statistics};
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// Places, schemas and channels listed by a file's end.
#[derive(Debug, Default)]
pub struct Marks {
    /// A footer or the magic is there; it may be damaged.
    pub has_end: bool,
    /// The end is readable, and its checksum is right or absent.
    pub is_sound: bool,
    /// Offsets of chunks.
    pub chunks: BTreeSet<u64>,
    /// Offsets of chunks and other records.
    pub records: BTreeSet<u64>,
    /// Schemas by number.
    pub schemas: BTreeMap<u16, (SchemaHeader, Vec<u8>)>,
    /// Channels by number.
    pub channels: BTreeMap<u16, Channel>,
    /// Number of records of each kind.
    pub statistics: Option<Statistics>,
}

impl Marks {
    /// Reads the end of a file.
    pub fn read(source: &mut RandomAccess) -> io::Result<Marks> {
        let mut marks = Marks::default();
        let end = End::read(source, |record| marks.take(record))?;
        (marks.has_end, marks.is_sound) = (end.is_there, end.is_sound);
        marks.records.extend(end.summary);
        Ok(marks)
    }

    /// Adds a record of the summary. Returns whether it is plausible.
    fn take(&mut self, record: Record<'_>) -> bool {
        match record {
            // Number 0 is no schema.
            Record::Schema { header, .. } if header.id == 0 => return false,
            Record::Schema { header, data } => {
                _ = self.schemas.insert(header.id, (header, data.into_owned()));
            }
            Record::Channel(channel) => _ = self.channels.insert(channel.id, channel),
            Record::ChunkIndex(index) => {
                self.chunks.insert(index.chunk_start_offset);
                self.records.insert(index.chunk_start_offset);
            }
            Record::Statistics(statistics) => self.statistics = Some(statistics),
            Record::AttachmentIndex(index) => _ = self.records.insert(index.offset),
            Record::MetadataIndex(index) => _ = self.records.insert(index.offset),
            _ => {}
        }
        true
    }
}
