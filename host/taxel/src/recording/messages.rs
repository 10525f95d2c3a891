//! Reads the messages of a recording in written order, also if it is damaged or truncated.

use super::attached::attached;
use super::chunk;
use super::damage::{Damage, Skipped, is_chunk_at, is_end, is_known};
use super::records::{Head, Inside, Records};
use super::summary::summary;
use super::texts::parse_record;
use crate::error::{Context, Result};
use mcap::records::{Channel, MessageHeader, Record, op};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Size of a message before its data: channel, order, times.
const MESSAGE: usize = 22;
/// Longest record outside of chunks that is read, bytes.
const LONGEST: u64 = 1 << 24;

/// A message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Message<'a> {
    /// Channel, order and times (ns).
    pub header: MessageHeader,
    /// Bytes in the channel's encoding.
    pub data: &'a [u8],
}

/// Iterates over the messages. Damaged chunks are skipped and counted; memory does not grow with the file.
#[derive(Debug)]
pub struct Messages {
    records: Records,
    path: PathBuf,
    /// The only topics to read; empty for all.
    only: Vec<String>,
    /// Name of the wanted attachment, and the first one of that name once it was passed.
    wanted: Option<String>,
    attached: Option<Vec<u8>>,
    channels: BTreeMap<u16, Channel>,
    /// True if all channels are known from the file's summary.
    are_all_known: bool,
    /// Uncompressed records of the current chunk, and the offset of the next one.
    plain: Vec<u8>,
    next: usize,
    skipped: Skipped,
    over: bool,
}

impl Messages {
    /// Opens a file.
    pub fn open(path: &Path) -> Result<Messages> {
        Ok(Messages {
            records: Records::open(path)?,
            path: path.into(),
            only: Vec::new(),
            wanted: None,
            attached: None,
            channels: BTreeMap::new(),
            are_all_known: false,
            plain: Vec::new(),
            next: 0,
            skipped: Skipped::default(),
            over: false,
        })
    }

    /// Opens a file for one topic; see `of_topics`.
    pub fn of_topic(path: &Path, topic: &str) -> Result<Messages> {
        Messages::of_topics(path, &[topic.into()])
    }

    /// Opens a file for some topics. Chunks without them, by the file's index, are neither read nor looked at for
    /// damage.
    pub(crate) fn of_topics(path: &Path, topics: &[String]) -> Result<Messages> {
        let mut messages = Messages { only: topics.to_vec(), ..Messages::open(path)? };
        if let Some(summary) = summary(path)? {
            messages.channels = summary.channels;
            messages.are_all_known = true;
        }
        Ok(messages)
    }

    /// Keeps the first attachment of this name that is passed.
    pub(crate) fn wanting(self, name: &str) -> Messages {
        Messages { wanted: Some(name.into()), ..self }
    }

    /// The wanted attachment; none before it is passed.
    pub fn attached(&self) -> Option<&[u8]> {
        self.attached.as_deref()
    }

    /// Topic of a channel; none if it is not declared yet.
    pub fn topic(&self, channel: u16) -> Option<&str> {
        self.channels.get(&channel).map(|channel| channel.topic.as_str())
    }

    /// Returns what was skipped so far.
    pub fn skipped(&self) -> Skipped {
        self.skipped
    }

    /// Bytes of the file read so far, and its size.
    pub fn passed(&self) -> [u64; 2] {
        [self.records.offset(), self.records.length()]
    }

    /// Next message; none at the end. Error if the disk cannot be read.
    pub fn next_message(&mut self) -> Result<Option<Message<'_>>> {
        let found = self.find().with_context(|| format!("{} cannot be read", self.path.display()))?;
        Ok(found.map(|(header, data)| Message { header, data: &self.plain[data] }))
    }

    /// Next message as its header, its topic (empty if that is not declared) and its data; none at the end. Error if
    /// the disk cannot be read.
    pub(crate) fn next_with_topic(&mut self) -> Result<Option<(MessageHeader, &str, &[u8])>> {
        let found = self.find().with_context(|| format!("{} cannot be read", self.path.display()))?;
        Ok(found.map(|(header, data)| {
            (header, self.topic(header.channel_id).unwrap_or_default(), &self.plain[data])
        }))
    }

    fn find(&mut self) -> Result<Option<(MessageHeader, Range<usize>)>> {
        loop {
            if let Some(found) = self.inside() {
                return Ok(Some(found));
            }
            if self.over || !self.fill()? {
                self.over = true;
                return Ok(None);
            }
        }
    }

    /// Next message of the chunk.
    fn inside(&mut self) -> Option<(MessageHeader, Range<usize>)> {
        let mut inside = Inside::of(&self.plain, self.next);
        while let Some(record) = inside.next() {
            self.next = inside.offset();
            match record.op {
                op::MESSAGE => {
                    let Some(header) = message(record.body) else { continue };
                    let topic = self.channels.get(&header.channel_id).map(|channel| channel.topic.as_str());
                    let is_wanted = |topic| self.only.iter().any(|only| only == topic);
                    if self.only.is_empty() || topic.is_some_and(is_wanted) {
                        return Some((header, self.next - record.body.len() + MESSAGE..self.next));
                    }
                }
                op::CHANNEL => channel(record.body, &mut self.channels),
                _ => {}
            }
        }
        None
    }

    /// Moves to the next chunk, or message outside of chunks. Returns false at the end.
    fn fill(&mut self) -> Result<bool> {
        loop {
            match self.step()? {
                ReadStep::Filled => return Ok(true),
                ReadStep::Over => return Ok(false),
                ReadStep::Passed => {}
                ReadStep::Damaged(damage) => {
                    match damage.pass(&mut self.records, &self.path, &mut self.skipped)? {
                        Some(next) => self.records.go_to(next)?,
                        None => return Ok(false),
                    }
                }
            }
        }
    }

    /// Reads the next record of the file.
    fn step(&mut self) -> Result<ReadStep> {
        let offset = self.records.offset();
        let Some(head) = self.records.next_head()? else { return Ok(ReadStep::Damaged(Damage::at(offset))) };
        match head.op {
            op::CHUNK => return self.chunk(head),
            op::MESSAGE | op::CHANNEL if head.length > LONGEST => self.records.go_to(head.end())?,
            op::MESSAGE => {
                self.plain.clear();
                self.plain.push(head.op);
                self.plain.extend(head.length.to_le_bytes());
                self.plain.extend_from_slice(self.records.body(head)?.body);
                self.next = 0;
                return Ok(ReadStep::Filled);
            }
            op::CHANNEL => channel(self.records.body(head)?.body, &mut self.channels),
            op::ATTACHMENT if self.wanted.is_some() && self.attached.is_none() && head.length <= LONGEST => {
                self.attach(head)?;
            }
            op::DATA_END if is_end(&self.path, &head)? => return Ok(ReadStep::Over),
            op if is_known(op) || !is_chunk_at(&self.path, &head)? => self.records.go_to(head.end())?,
            _ => return Ok(ReadStep::Damaged(Damage::at(offset))),
        }
        Ok(ReadStep::Passed)
    }

    /// Keeps an attachment if it is the wanted one.
    fn attach(&mut self, head: Head) -> Result<()> {
        let record = self.records.body(head)?;
        let found = attached(record.body).filter(|(header, ..)| Some(&header.name) == self.wanted.as_ref());
        self.attached = found.map(|(_, data, _)| data.to_vec());
        Ok(())
    }

    /// True if a chunk is left out: it holds nothing of the only topics, by the index that follows it. Moves to
    /// the chunk's end if so.
    fn leaves_out(&mut self, head: Head) -> Result<bool> {
        if self.only.is_empty() || !self.are_all_known {
            return Ok(false);
        }
        let mut is_of_others = false;
        self.records.go_to(head.end())?;
        while let Some(index) = self.records.next_head()? {
            if index.op != op::MESSAGE_INDEX || index.length < 2 {
                break;
            }
            let channel = <[u8; 2]>::try_from(self.records.rest(2)?).ok().map(u16::from_le_bytes);
            let topic = channel.and_then(|id| self.channels.get(&id)).map(|channel| &channel.topic);
            is_of_others = topic.is_some_and(|topic| !self.only.contains(topic));
            if !is_of_others {
                break;
            }
            self.records.go_to(index.end())?;
        }
        self.records.go_to(if is_of_others { head.end() } else { head.body() })?;
        Ok(is_of_others)
    }

    fn chunk(&mut self, head: Head) -> Result<ReadStep> {
        if self.leaves_out(head)? {
            return Ok(ReadStep::Passed);
        }
        let record = self.records.body(head)?;
        let mut damage = Damage { end: Some(head.end()), ..Damage::at(head.offset) };
        self.next = 0;
        if let Ok(Record::Chunk { header, data }) = parse_record(record.op, record.body) {
            if chunk::plain(&header, &data, &mut self.plain).is_ok() {
                return Ok(ReadStep::Filled);
            }
            damage.ns = header.message_end_time.saturating_sub(header.message_start_time);
        }
        self.plain.clear();
        Ok(ReadStep::Damaged(damage))
    }
}

/// Result of reading a record.
enum ReadStep {
    /// Record with messages.
    Filled,
    /// Record without messages.
    Passed,
    Damaged(Damage),
    Over,
}

/// Header of a message; none if it is too short.
fn message(body: &[u8]) -> Option<MessageHeader> {
    let (channel_id, rest) = body.split_first_chunk()?;
    let (sequence, rest) = rest.split_first_chunk()?;
    let (log_time, rest) = rest.split_first_chunk()?;
    Some(MessageHeader {
        channel_id: u16::from_le_bytes(*channel_id),
        sequence: u32::from_le_bytes(*sequence),
        log_time: u64::from_le_bytes(*log_time),
        publish_time: u64::from_le_bytes(*rest.first_chunk()?),
    })
}

/// Adds a readable channel.
fn channel(body: &[u8], channels: &mut BTreeMap<u16, Channel>) {
    if let Ok(Record::Channel(channel)) = parse_record(op::CHANNEL, body) {
        channels.insert(channel.id, channel);
    }
}
