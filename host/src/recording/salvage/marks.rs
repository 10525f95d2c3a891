//! What the end of a file says of where its records lie.

use super::super::source::Source;
use super::super::summary::End;
use mcap::records::{Channel, Record, SchemaHeader, Statistics};
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// Places and channels that a file's end tells.
#[derive(Debug, Default)]
pub struct Marks {
    /// A footer or the last bytes are there; they may be damaged.
    pub has_end: bool,
    /// The end fits its checksum, or has none, and can be read.
    pub is_sound: bool,
    /// Where chunks begin.
    pub chunks: BTreeSet<u64>,
    /// Where chunks and other records begin.
    pub records: BTreeSet<u64>,
    /// Schemas by number.
    pub schemas: BTreeMap<u16, (SchemaHeader, Vec<u8>)>,
    /// Channels by number.
    pub channels: BTreeMap<u16, Channel>,
    /// How many records of each kind there are.
    pub statistics: Option<Statistics>,
}

impl Marks {
    /// Reads them.
    pub fn read(source: &mut Source) -> io::Result<Marks> {
        let mut marks = Marks::default();
        let end = End::read(source, |record| marks.take(record))?;
        (marks.has_end, marks.is_sound) = (end.is_there, end.is_sound);
        marks.records.extend(end.summary);
        Ok(marks)
    }

    /// Takes a record of the summary; whether it can be right.
    fn take(&mut self, record: Record<'_>) -> bool {
        match record {
            // Number 0 stands for no schema.
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
