//! Random access to a recording: the places of its chunks, and the messages of any of them.

use super::attached::attached;
use super::board_recording::BoardRecording;
use super::chunk;
use super::damage::{Damage, Skipped, is_chunk_at, is_end, is_known};
use super::records::{Head, Inside, Records};
use super::texts::parse_record;
use crate::error::{Context, Error, RecordingError, Result};
use mcap::records::{Channel, MessageHeader, Record, op};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Chunks kept uncompressed: the one being played, and those needed for a step back.
const HELD: usize = 4;
/// Most bytes of the kept chunks besides the last one.
const HELD_BYTES: usize = 64 << 20;
/// Longest record outside of chunks that is read, bytes.
const LONGEST: u64 = 1 << 24;

/// Place of a chunk, and the log times of its messages, ns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChunkPlace {
    offset: u64,
    /// Log time of its first message; not before that of the previous chunk.
    pub start: u64,
    /// Log time of its last message.
    pub end: u64,
    /// Channels with messages in it, and in those without the topic behind it, by their index.
    channels: Vec<u16>,
}

/// A message of the topic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClipMessage {
    /// Channel, order and times (ns).
    pub header: MessageHeader,
    /// Bytes of the message.
    pub data: Box<[u8]>,
}

/// A recording read chunk by chunk, in any order.
#[derive(Debug)]
pub struct Clips {
    records: Records,
    recording: BoardRecording,
    /// The topic whose messages are read, as that of a single board.
    topic: &'static str,
    places: Vec<ChunkPlace>,
    channels: BTreeMap<u16, Channel>,
    words: BTreeMap<String, BTreeMap<String, String>>,
    /// Attachments by name, the newest of each.
    attached: BTreeMap<String, Vec<u8>>,
    plain: Vec<u8>,
    held: Vec<(usize, Arc<[ClipMessage]>)>,
}

impl Clips {
    /// Opens the recording of a board; only its messages of this topic are read, and only the chunks that hold
    /// any. Bodies of chunks are skipped, so this takes little time.
    pub fn open(recording: &BoardRecording, topic: &'static str) -> Result<Clips> {
        let mut clips = Clips {
            records: Records::open(&recording.path)?,
            recording: recording.clone(),
            topic,
            places: Vec::new(),
            channels: BTreeMap::new(),
            words: BTreeMap::new(),
            attached: BTreeMap::new(),
            plain: Vec::new(),
            held: Vec::new(),
        };
        clips.walk().with_context(|| format!("{} cannot be read", recording.path.display()))?;
        clips.arrange();
        Ok(clips)
    }

    /// Another reader of the same file.
    pub fn again(&self) -> Result<Clips> {
        Clips::open(&self.recording, self.topic)
    }

    /// The chunks in order of time.
    pub fn places(&self) -> &[ChunkPlace] {
        &self.places
    }

    /// Metadata of the board.
    pub fn words(&self, name: &str) -> Option<&BTreeMap<String, String>> {
        self.words.get(&self.recording.attachment(name))
    }

    /// The newest attachment of the board of this name.
    pub fn attached(&self, name: &str) -> Option<&[u8]> {
        self.attached.get(&self.recording.attachment(name)).map(Vec::as_slice)
    }

    /// True if the file has the topic.
    pub fn has_topic(&self) -> bool {
        let topic = self.recording.topic(self.topic);
        self.channels.values().any(|channel| channel.topic == topic)
    }

    /// Chunks before `end` with messages of a topic, last first.
    pub fn with_topic(&self, topic: &str, end: usize) -> impl Iterator<Item = usize> {
        let topic = self.recording.topic(topic);
        let is_of = move |id: &u16| self.channels.get(id).is_some_and(|channel| channel.topic == topic);
        let before = self.places.iter().take(end).enumerate().rev();
        before.filter(move |(_, place)| place.channels.iter().any(&is_of)).map(|(chunk, _)| chunk)
    }

    /// Visits all records up to the end of the data, or of what is readable.
    fn walk(&mut self) -> Result<()> {
        let mut skipped = Skipped::default();
        loop {
            let offset = self.records.offset();
            let damaged = match self.records.next_head()? {
                None => true,
                Some(head) if head.op == op::DATA_END && is_end(&self.recording.path, &head)? => {
                    return Ok(());
                }
                Some(head) if is_known(head.op) || !is_chunk_at(&self.recording.path, &head)? => {
                    self.step(head)?;
                    false
                }
                Some(_) => true,
            };
            if damaged {
                match Damage::at(offset).pass(&mut self.records, &self.recording.path, &mut skipped)? {
                    Some(next) => self.records.go_to(next)?,
                    None => return Ok(()),
                }
            }
        }
    }

    /// Leaves out chunks without the topic, whose channels count as those of the chunk before: they were written
    /// together. Brings the rest into order of time.
    fn arrange(&mut self) {
        let topic = self.recording.topic(self.topic);
        // A channel that is not declared yet may be of this topic, and a chunk without an index may hold any.
        let may_be = |id: &u16| self.channels.get(id).is_none_or(|channel| channel.topic == topic);
        let mut places: Vec<ChunkPlace> = Vec::new();
        for place in std::mem::take(&mut self.places) {
            match places.last_mut() {
                _ if place.channels.is_empty() || place.channels.iter().any(may_be) => places.push(place),
                Some(before) => before.channels.extend(place.channels),
                None => {}
            }
        }
        self.places = places;
        let mut before = 0;
        for place in &mut self.places {
            // If a clock was set back, a chunk still begins no earlier than the one before it.
            place.start = place.start.max(before);
            place.end = place.end.max(place.start);
            before = place.start;
        }
    }

    /// Reads or skips a record.
    fn step(&mut self, head: Head) -> Result<()> {
        match head.op {
            op::CHUNK if head.length >= 16 => {
                let times = self.records.rest(16)?;
                let time = |at: usize| times.get(at..)?.first_chunk().map(|bytes| u64::from_le_bytes(*bytes));
                let (start, end) = (time(0).unwrap_or(0), time(8).unwrap_or(0));
                self.places.push(ChunkPlace { offset: head.offset, start, end, channels: Vec::new() });
            }
            op::MESSAGE_INDEX if head.length >= 2 => {
                let id = self.records.rest(2)?;
                if let (Some(place), [low, high]) = (self.places.last_mut(), id.as_slice()) {
                    place.channels.push(u16::from_le_bytes([*low, *high]));
                }
            }
            op::ATTACHMENT if head.length <= LONGEST => {
                if let Some((header, data, _)) = attached(self.records.body(head)?.body) {
                    self.attached.insert(header.name, data.to_vec());
                }
            }
            op::CHANNEL | op::METADATA if head.length <= LONGEST => {
                let record = self.records.body(head)?;
                match parse_record(record.op, record.body) {
                    Ok(Record::Channel(channel)) => _ = self.channels.insert(channel.id, channel),
                    Ok(Record::Metadata(stated)) => _ = self.words.insert(stated.name, stated.metadata),
                    _ => {}
                }
            }
            op::MESSAGE => fail!(
                RecordingError::Unsupported,
                "it has messages outside of chunks, which are not supported here"
            ),
            _ => {}
        }
        self.records.go_to(head.end())
    }

    /// Messages of a chunk. Error if it is damaged.
    pub fn clip(&mut self, chunk: usize) -> Result<Arc<[ClipMessage]>> {
        if let Some(at) = self.held.iter().position(|(number, _)| *number == chunk) {
            let known = self.held.remove(at);
            self.held.push(known);
        } else {
            let read = self.read(chunk);
            let clip = read.map_err(|why| {
                Error::caused(RecordingError::Damaged { path: self.recording.path.clone() }, why)
            })?;
            self.held.push((chunk, clip));
            while self.held.len() > HELD || self.held_bytes() > HELD_BYTES {
                self.held.remove(0);
            }
        }
        Ok(self.held.last().map_or_else(|| [].into(), |(_, clip)| clip.clone()))
    }

    /// Memory of the kept chunks besides the last one.
    fn held_bytes(&self) -> usize {
        let before = self.held.split_last().map_or(&[][..], |(_, before)| before);
        let pieces = before.iter().flat_map(|(_, clip)| clip.iter());
        pieces.map(|piece| size_of::<ClipMessage>() + piece.data.len()).sum()
    }

    fn read(&mut self, chunk: usize) -> Result<Arc<[ClipMessage]>> {
        let place = self.places.get(chunk);
        let place = place.ok_or_else(|| error!(RecordingError::Record, "there is no such chunk"))?;
        self.records.go_to(place.offset)?;
        let record = self.records.next_record()?;
        let record = record.ok_or_else(|| error!(RecordingError::Record, "a chunk is cut off"))?;
        let Record::Chunk { header, data } = parse_record(record.op, record.body)? else {
            fail!(RecordingError::Record, "a chunk was overwritten");
        };
        chunk::plain(&header, &data, &mut self.plain)?;
        let topic = self.recording.topic(self.topic);
        let mut pieces = Vec::new();
        for record in Inside::of(&self.plain, 0) {
            match (record.op, record.body) {
                (op::MESSAGE, [low, high, ..]) => {
                    let channel = self.channels.get(&u16::from_le_bytes([*low, *high]));
                    if channel.is_none_or(|channel| channel.topic != topic) {
                        continue;
                    }
                    if let Record::Message { header, data } = parse_record(record.op, record.body)? {
                        pieces.push(ClipMessage { header, data: data.into() });
                    }
                }
                (op::CHANNEL, body) => {
                    if let Record::Channel(channel) = parse_record(op::CHANNEL, body)? {
                        self.channels.insert(channel.id, channel);
                    }
                }
                _ => {}
            }
        }
        Ok(pieces.into())
    }
}
