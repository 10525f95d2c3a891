//! What is in a recording: told at its end, so that a reader need not go through it.

use super::append::{HEAD, append, sized, write};
use super::chunk::{Closed, is_known};
use anyhow::Result;
use mcap::MAGIC;
use mcap::records::{
    AttachmentIndex, Channel, DataEnd, Footer, MetadataIndex, SchemaHeader, Statistics, SummaryOffset, op,
};
use std::collections::BTreeMap;

/// A channel, with the name of its schema.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChannelInfo {
    /// The record.
    pub channel: Channel,
    /// Name of its schema; empty: none.
    pub schema: String,
}

/// First and last log time, ns.
pub type Stretch = [u64; 2];

/// What is in a recording.
#[derive(Debug, Default, Clone)]
pub struct Contents {
    pub(super) schemas: BTreeMap<u16, (SchemaHeader, Vec<u8>)>,
    pub(super) channels: BTreeMap<u16, Channel>,
    pub(super) chunks: Vec<Closed>,
    pub(super) attachments: Vec<AttachmentIndex>,
    pub(super) metadata: Vec<MetadataIndex>,
    /// Messages outside of chunks, which other programs write: by channel, and their first and last log time.
    pub(super) loose: (BTreeMap<u16, u64>, Option<Stretch>),
}

impl Contents {
    /// The channels by number.
    pub fn channels(&self) -> impl Iterator<Item = ChannelInfo> + '_ {
        self.channels.values().map(|channel| ChannelInfo {
            channel: channel.clone(),
            schema: self.schemas.get(&channel.schema_id).map_or(String::new(), |(head, _)| head.name.clone()),
        })
    }

    /// Messages by channel.
    pub fn counts(&self) -> BTreeMap<u16, u64> {
        let mut counts = self.loose.0.clone();
        for (channel, count) in self.chunks.iter().flat_map(|chunk| &chunk.counts) {
            *counts.entry(*channel).or_default() += count;
        }
        counts
    }

    /// Messages of a topic.
    pub fn messages(&self, topic: &str) -> u64 {
        let counts = self.counts();
        let of = self.channels.values().filter(|channel| channel.topic == topic);
        of.filter_map(|channel| counts.get(&channel.id)).sum()
    }

    /// Chunks.
    pub fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// First and last log time; none without a message.
    pub fn stretch(&self) -> Option<Stretch> {
        let chunks = self.chunks.iter().map(|c| [c.index.message_start_time, c.index.message_end_time]);
        chunks.chain(self.loose.1).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    /// A message outside of a chunk.
    pub(super) fn count_loose(&mut self, channel: u16, time: u64) {
        *self.loose.0.entry(channel).or_default() += 1;
        let [first, last] = self.loose.1.unwrap_or([time; 2]);
        self.loose.1 = Some([first.min(time), last.max(time)]);
    }

    /// Names of what is attached.
    pub fn attachments(&self) -> impl Iterator<Item = &str> {
        self.attachments.iter().map(|attachment| attachment.name.as_str())
    }

    /// Forgets what lies at `length` or behind it.
    pub(super) fn cut(&mut self, length: u64) {
        self.chunks.retain(|chunk| chunk.end() <= length);
        self.attachments.retain(|attachment| attachment.offset + attachment.length <= length);
        self.metadata.retain(|metadata| metadata.offset + metadata.length <= length);
    }

    /// The end of a file whose records end at `offset`: summary, its offsets, footer.
    pub(super) fn end(&self, offset: u64) -> Result<Vec<u8>> {
        let mut out = Vec::new();
        append(&mut out, op::DATA_END, &DataEnd::default(), &[])?;
        let start = out.len();
        let mut groups = Vec::new();
        let mut group = |out: &mut Vec<u8>, group_opcode, from: usize| {
            let (group_start, group_length) = (offset + from as u64, (out.len() - from) as u64);
            if group_length > 0 {
                groups.push(SummaryOffset { group_opcode, group_start, group_length });
            }
            out.len()
        };
        let mut from = start;
        for (header, data) in self.schemas.values() {
            append(&mut out, op::SCHEMA, header, &sized(data))?;
        }
        from = group(&mut out, op::SCHEMA, from);
        for channel in self.channels.values() {
            append(&mut out, op::CHANNEL, channel, &[])?;
        }
        from = group(&mut out, op::CHANNEL, from);
        // Of a chunk that cannot be read, only its index tells how many messages it holds.
        let is_counted = |chunk: &Closed| !chunk.counts.is_empty() || is_known(&chunk.index.compression);
        if self.chunks.iter().all(is_counted) {
            append(&mut out, op::STATISTICS, &self.statistics(), &[])?;
        }
        from = group(&mut out, op::STATISTICS, from);
        for chunk in &self.chunks {
            append(&mut out, op::CHUNK_INDEX, &chunk.index, &[])?;
        }
        from = group(&mut out, op::CHUNK_INDEX, from);
        for index in &self.attachments {
            append(&mut out, op::ATTACHMENT_INDEX, index, &[])?;
        }
        from = group(&mut out, op::ATTACHMENT_INDEX, from);
        for index in &self.metadata {
            append(&mut out, op::METADATA_INDEX, index, &[])?;
        }
        group(&mut out, op::METADATA_INDEX, from);
        let offsets = out.len();
        for group in &groups {
            append(&mut out, op::SUMMARY_OFFSET, group, &[])?;
        }
        footer(&mut out, offset, start, offsets)?;
        Ok(out)
    }

    fn statistics(&self) -> Statistics {
        let counts = self.counts();
        let [message_start_time, message_end_time] = self.stretch().unwrap_or([0; 2]);
        Statistics {
            message_count: counts.values().sum(),
            schema_count: self.schemas.len() as u16,
            channel_count: self.channels.len() as u32,
            attachment_count: self.attachments.len() as u32,
            metadata_count: self.metadata.len() as u32,
            chunk_count: self.chunks.len() as u32,
            message_start_time,
            message_end_time,
            channel_message_counts: counts,
        }
    }
}

/// The footer, whose checksum is that of the summary and of itself up to there, and the last bytes.
fn footer(out: &mut Vec<u8>, offset: u64, start: usize, offsets: usize) -> Result<()> {
    let mut footer = Footer {
        summary_start: offset + start as u64,
        summary_offset_start: offset + offsets as u64,
        summary_crc: 0,
    };
    let at = out.len();
    append(out, op::FOOTER, &footer, &[])?;
    out.truncate(out.len() - size_of::<u32>());
    footer.summary_crc = crc32fast::hash(&out[start..]);
    out.truncate(at + HEAD);
    write(out, &footer)?;
    out.extend_from_slice(MAGIC);
    Ok(())
}
