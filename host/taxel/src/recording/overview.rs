//! Contents of a recording, by the summary at its end, or else by a scan.

use super::attached::attached;
use super::contents::{ChannelInfo, Stretch};
use super::records::Records;
use super::summary::{Summary, summary};
use super::texts::{LONGEST, parse_record};
use super::{Scan, scan};
use crate::error::{RecordingError, Result};
use mcap::records::{AttachmentIndex, Metadata, Record};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Contents of a recording.
#[derive(Debug, Clone)]
pub struct Overview {
    path: PathBuf,
    /// Channels and the names of their schemas.
    pub channels: Vec<ChannelInfo>,
    /// Number of messages by channel.
    pub counts: BTreeMap<u16, u64>,
    /// First and last log time, ns; none without messages.
    pub stretch: Option<Stretch>,
    /// Places of the attachments.
    pub attachments: Vec<AttachmentIndex>,
    /// Metadata of the file.
    pub metadata: Vec<Metadata>,
    /// Bytes behind the intact part of a file without its end; none if it has its end.
    pub torn: Option<u64>,
}

impl Overview {
    /// Inspects a file. A file with a summary is not scanned, whatever its length.
    pub fn of(path: &Path) -> Result<Overview> {
        match summary(path)? {
            Some(summary) if summary.statistics.is_some() => Overview::stated(path, summary),
            _ => Ok(Overview::found(path, &scan(path)?)),
        }
    }

    fn stated(path: &Path, summary: Summary) -> Result<Overview> {
        let Summary { schemas, channels, statistics, attachments, metadata } = summary;
        let schema = |id: &u16| schemas.get(id).cloned().unwrap_or_default();
        let channels = channels.into_values();
        let channels = channels.map(|channel| ChannelInfo { schema: schema(&channel.schema_id), channel });
        let statistics = statistics.unwrap_or_default();
        let times = [statistics.message_start_time, statistics.message_end_time];
        let words = metadata.iter().map(|index| words(path, index.offset));
        Ok(Overview {
            path: path.into(),
            channels: channels.collect(),
            counts: statistics.channel_message_counts,
            stretch: (statistics.message_count > 0).then_some(times),
            attachments,
            // Damaged metadata is left out; the messages are not affected.
            metadata: words.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect(),
            torn: None,
        })
    }

    /// Overview of a scanned file.
    pub fn found(path: &Path, scan: &Scan) -> Overview {
        Overview {
            path: path.into(),
            channels: scan.contents.channels().collect(),
            counts: scan.contents.counts(),
            stretch: scan.contents.stretch(),
            attachments: scan.contents.attachments.clone(),
            torn: (!scan.ended).then_some(scan.torn),
            metadata: scan.metadata.clone(),
        }
    }

    /// Returns its topics.
    pub fn topics(&self) -> impl Iterator<Item = &str> {
        self.channels.iter().map(|info| info.channel.topic.as_str())
    }

    /// Number of messages of a topic.
    pub fn messages(&self, topic: &str) -> u64 {
        let of = self.channels.iter().filter(|info| info.channel.topic == topic);
        of.filter_map(|info| self.counts.get(&info.channel.id)).sum()
    }

    /// Newest metadata of this name.
    pub fn words(&self, name: &str) -> Option<&BTreeMap<String, String>> {
        self.metadata.iter().rfind(|words| words.name == name).map(|words| &words.metadata)
    }

    /// Newest attachment of this name; none if there is none.
    pub fn attached(&self, name: &str) -> Result<Option<Vec<u8>>> {
        let cut_off = || {
            let path = self.path.display();
            error!(RecordingError::Record, "{path}: attachment {name} cannot be read")
        };
        let Some(index) = self.attachments.iter().rfind(|index| index.name == name) else {
            return Ok(None);
        };
        let mut records = Records::open_at(&self.path, index.offset)?;
        let record = records.next_short(LONGEST as u64)?.ok_or_else(cut_off)?;
        let (_, data, _) = attached(record.body).ok_or_else(cut_off)?;
        Ok(Some(data.to_vec()))
    }
}

/// Metadata at an offset; none if it is damaged.
fn words(path: &Path, offset: u64) -> Result<Option<Metadata>> {
    let mut records = Records::open_at(path, offset)?;
    let record = records.next_short(LONGEST as u64)?;
    Ok(record.and_then(|record| match parse_record(record.op, record.body) {
        Ok(Record::Metadata(words)) => Some(words),
        _ => None,
    }))
}
