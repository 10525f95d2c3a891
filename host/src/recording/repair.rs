//! A recording without its end, after a kill or a power cut: what is whole is kept, and the end is added.

use super::chunk::{self, Closed, Index};
use super::contents::Contents;
use super::records::{Inside, RawRecord, Records};
use super::store::Store;
use anyhow::{Context, Result};
use mcap::records::{AttachmentIndex, MessageIndexEntry, MetadataIndex, Record, op};
use mcap::{MAGIC, parse_record};
use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;

/// What is in a file, found by going through it.
#[derive(Debug)]
pub struct Scan {
    /// What is whole.
    pub contents: Contents,
    /// The file has its end.
    pub whole: bool,
    /// Bytes behind what is whole; 0 where the file has its end.
    pub torn: u64,
    /// Where the end is to be added.
    length: u64,
    /// Message indexes of the last chunk, which were not written with it.
    missing: Vec<u8>,
    /// Words of the file by name.
    pub metadata: Vec<mcap::records::Metadata>,
    /// Library and profile.
    pub header: Option<mcap::records::Header>,
}

/// Goes through a file.
pub fn scan(path: &Path) -> Result<Scan> {
    let mut records = Records::open(path)?;
    let mut scan = Scan {
        contents: Contents::default(),
        whole: false,
        torn: 0,
        length: MAGIC.len() as u64,
        missing: Vec::new(),
        metadata: Vec::new(),
        header: None,
    };
    // One buffer serves all chunks.
    let mut plain = Vec::new();
    while let Some(record) = records.next_record()? {
        if record.op == op::DATA_END {
            scan.whole = has_end(&mut records)?;
            break;
        }
        // Zeros of a power cut (no record has that number), or what else is no record: the end is here.
        if record.op == 0 || scan.take(&record, &mut plain).is_err() {
            break;
        }
    }
    let length = records.length();
    scan.torn = if scan.whole { 0 } else { length.saturating_sub(scan.length) };
    Ok(scan)
}

/// Whether a footer and the last bytes follow.
fn has_end(records: &mut Records) -> Result<bool> {
    while let Some(record) = records.next_record()? {
        if record.op == op::FOOTER {
            return Ok(records.rest(MAGIC.len() as u64)? == MAGIC);
        }
    }
    Ok(false)
}

impl Scan {
    fn take(&mut self, record: &RawRecord<'_>, plain: &mut Vec<u8>) -> Result<()> {
        if record.op != op::MESSAGE_INDEX && !self.missing.is_empty() {
            self.forget_missing();
        }
        let Scan { contents, missing, .. } = self;
        let (offset, length) = (record.offset, record.end() - record.offset);
        match parse_record(record.op, record.body)? {
            Record::Header(header) => self.header = Some(header),
            Record::Schema { header, data } => {
                _ = contents.schemas.insert(header.id, (header, data.into_owned()))
            }
            Record::Channel(channel) => _ = contents.channels.insert(channel.id, channel),
            Record::Chunk { header, data } => {
                chunk::plain(&header, &data, plain)?;
                let messages = self.look_into(plain)?;
                self.missing.clear();
                let closed = Closed::indexed(&header, &messages, offset, length, &mut self.missing)?;
                self.contents.chunks.push(closed);
            }
            // What is rebuilt is what was written: it is there as far as the file goes.
            Record::MessageIndex(_) => {
                let written = (length as usize).min(missing.len());
                missing.drain(..written);
            }
            Record::Message { header, .. } => contents.count_loose(header.channel_id, header.log_time),
            Record::Attachment { header, data, .. } => contents.attachments.push(AttachmentIndex {
                offset,
                length,
                log_time: header.log_time,
                create_time: header.create_time,
                data_size: data.len() as u64,
                name: header.name,
                media_type: header.media_type,
            }),
            Record::Metadata(metadata) => {
                contents.metadata.push(MetadataIndex { offset, length, name: metadata.name.clone() });
                self.metadata.push(metadata);
            }
            _ => {}
        }
        self.length = record.end();
        Ok(())
    }

    /// Other programs may leave message indexes out: where something else follows a chunk, it has none.
    fn forget_missing(&mut self) {
        self.missing.clear();
        if let Some(last) = self.contents.chunks.last_mut() {
            last.index.message_index_offsets.clear();
            last.index.message_index_length = 0;
        }
    }

    /// Where the messages of a chunk lie; schemas and channels in it are taken along.
    fn look_into(&mut self, plain: &[u8]) -> Result<Index> {
        let mut messages = Index::new();
        for record in Inside::of(plain, 0) {
            match parse_record(record.op, record.body)? {
                Record::Message { header, .. } => {
                    let entry = MessageIndexEntry { log_time: header.log_time, offset: record.offset };
                    messages.entry(header.channel_id).or_default().push(entry);
                }
                Record::Schema { header, data } => {
                    self.contents.schemas.insert(header.id, (header, data.into_owned()));
                }
                Record::Channel(channel) => _ = self.contents.channels.insert(channel.id, channel),
                _ => {}
            }
        }
        Ok(messages)
    }
}

/// Completes a file where it lies; false: it was whole.
pub fn repair(path: &Path) -> Result<bool> {
    let scan = scan(path)?;
    if scan.whole {
        return Ok(false);
    }
    let place = || format!("{} cannot be repaired", path.display());
    let mut file = OpenOptions::new().write(true).open(path).with_context(place)?;
    let mut end = scan.missing;
    let length = scan.length + end.len() as u64;
    end.extend(scan.contents.end(length)?);
    file.cut(scan.length)
        .and_then(|()| file.write_all(&end))
        .and_then(|()| file.keep())
        .with_context(place)?;
    Ok(true)
}
