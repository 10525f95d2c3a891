//! The messages of a recording in the order in which they were written, also of one that has no end.

use super::chunk;
use super::records::Records;
use anyhow::{Context, Result};
use mcap::parse_record;
use mcap::records::{Channel, MessageHeader, Record};
use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// One message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// Channel, order and times (ns).
    pub header: MessageHeader,
    /// Its bytes, as the channel's encoding says.
    pub data: Vec<u8>,
}

/// Goes through the messages.
#[derive(Debug)]
pub struct Messages {
    records: Records<BufReader<File>>,
    path: PathBuf,
    channels: BTreeMap<u16, Channel>,
    waiting: VecDeque<Message>,
    over: bool,
}

impl Messages {
    /// Of a file.
    pub fn open(path: &Path) -> Result<Messages> {
        Ok(Messages {
            records: Records::open(path)?,
            path: path.into(),
            channels: BTreeMap::new(),
            waiting: VecDeque::new(),
            over: false,
        })
    }

    /// What a channel is about; none: it has not been told yet.
    pub fn topic(&self, channel: u16) -> Option<&str> {
        self.channels.get(&channel).map(|channel| channel.topic.as_str())
    }

    fn fill(&mut self) -> Result<()> {
        while self.waiting.is_empty() && !self.over {
            let Some(record) = self.records.next_record()? else {
                self.over = true;
                return Ok(());
            };
            match parse_record(record.op, &record.body)? {
                Record::Chunk { header, data } => {
                    let plain = chunk::plain(&header, &data)?;
                    let mut inside = Records::of_chunk(&plain);
                    while let Some(record) = inside.next_record()? {
                        self.take(parse_record(record.op, &record.body)?);
                    }
                }
                Record::DataEnd(_) => self.over = true,
                other => self.take(other),
            }
        }
        Ok(())
    }

    fn take(&mut self, record: Record<'_>) {
        match record {
            Record::Channel(channel) => _ = self.channels.insert(channel.id, channel),
            Record::Message { header, data } => {
                self.waiting.push_back(Message { header, data: data.into_owned() });
            }
            _ => {}
        }
    }
}

impl Iterator for Messages {
    type Item = Result<Message>;

    fn next(&mut self) -> Option<Result<Message>> {
        match self.fill() {
            Ok(()) => self.waiting.pop_front().map(Ok),
            Err(error) => {
                self.over = true;
                Some(Err(error).with_context(|| format!("{} is damaged", self.path.display())))
            }
        }
    }
}
