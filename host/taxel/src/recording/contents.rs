//! Contents of a recording.

use super::chunk::Closed;
use mcap::records::{AttachmentIndex, Channel, MetadataIndex, SchemaHeader};
use std::collections::BTreeMap;

/// A channel and the name of its schema.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChannelInfo {
    /// The record.
    pub channel: Channel,
    /// Name of its schema; empty if it has none.
    pub schema: String,
}

/// First and last log time, ns.
pub type Stretch = [u64; 2];

/// Contents of a recording.
#[derive(Debug, Default, Clone)]
pub struct Contents {
    pub(super) schemas: BTreeMap<u16, (SchemaHeader, Vec<u8>)>,
    pub(super) channels: BTreeMap<u16, Channel>,
    pub(super) chunks: Vec<Closed>,
    pub(super) attachments: Vec<AttachmentIndex>,
    pub(super) metadata: Vec<MetadataIndex>,
    /// Messages outside of chunks, as written by other programs: number by channel, first and last log time.
    pub(super) loose: (BTreeMap<u16, u64>, Option<Stretch>),
}

impl Contents {
    /// Channels by number.
    pub fn channels(&self) -> impl Iterator<Item = ChannelInfo> + '_ {
        self.channels.values().map(|channel| ChannelInfo {
            channel: channel.clone(),
            schema: self.schemas.get(&channel.schema_id).map_or(String::new(), |(head, _)| head.name.clone()),
        })
    }

    /// Number of messages by channel.
    pub fn counts(&self) -> BTreeMap<u16, u64> {
        let mut counts = self.loose.0.clone();
        for (channel, count) in self.chunks.iter().flat_map(|chunk| &chunk.counts) {
            *counts.entry(*channel).or_default() += count;
        }
        counts
    }

    /// Number of messages of a topic.
    pub fn messages(&self, topic: &str) -> u64 {
        let counts = self.counts();
        let of = self.channels.values().filter(|channel| channel.topic == topic);
        of.filter_map(|channel| counts.get(&channel.id)).sum()
    }

    /// Number of chunks.
    pub fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// First and last log time; none without messages.
    pub fn stretch(&self) -> Option<Stretch> {
        let chunks = self.chunks.iter().map(|c| [c.index.message_start_time, c.index.message_end_time]);
        chunks.chain(self.loose.1).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    /// Counts a message outside of a chunk.
    pub(super) fn count_loose(&mut self, channel: u16, time: u64) {
        *self.loose.0.entry(channel).or_default() += 1;
        let [first, last] = self.loose.1.unwrap_or([time; 2]);
        self.loose.1 = Some([first.min(time), last.max(time)]);
    }

    /// Names of the attachments.
    pub fn attachments(&self) -> impl Iterator<Item = &str> {
        self.attachments.iter().map(|attachment| attachment.name.as_str())
    }
}
