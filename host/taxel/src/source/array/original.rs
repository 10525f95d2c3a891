//! The bytes of an array as they came, so that a recording of what was perceived in them can be decoded again.

use crate::error::{Result, UsageError};
use crate::recording::{BoardRecording, Messages};

/// Topic of a recording with them.
pub const ORIGINAL: &str = "/taxel/original";
/// Most bytes that wait to be taken.
const MOST: usize = 4 << 20;

/// Bytes of one read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OriginalBytes {
    /// Time of their arrival since the array was opened, us.
    pub arrival_us: u64,
    /// True of a datagram.
    pub is_datagram: bool,
    /// The bytes.
    pub bytes: Vec<u8>,
}

impl OriginalBytes {
    /// The message of a recording: the time in eight bytes, little-endian, 1 for a datagram and 0 for a part of a
    /// stream, the bytes.
    pub fn message(&self) -> Vec<u8> {
        let head = self.arrival_us.to_le_bytes().into_iter().chain([self.is_datagram.into()]);
        head.chain(self.bytes.iter().copied()).collect()
    }

    /// Reads a message; none if it is none.
    pub fn read(message: &[u8]) -> Option<OriginalBytes> {
        let (time, rest) = message.split_first_chunk()?;
        let (kind, bytes) = rest.split_first()?;
        let is_datagram = match kind {
            0 => false,
            1 => true,
            _ => return None,
        };
        Some(OriginalBytes { arrival_us: u64::from_le_bytes(*time), is_datagram, bytes: bytes.to_vec() })
    }
}

/// Bytes that wait to be taken.
#[derive(Debug, Default)]
pub struct OriginalQueue {
    waiting: Vec<OriginalBytes>,
    length: usize,
    /// Bytes for which there was no room.
    pub dropped: u64,
}

impl OriginalQueue {
    /// Appends bytes, as long as there is room.
    pub fn push(&mut self, original: OriginalBytes) {
        if self.length + original.bytes.len() > MOST {
            self.dropped += original.bytes.len() as u64;
            return;
        }
        self.length += original.bytes.len();
        self.waiting.push(original);
    }

    /// Takes all.
    pub fn take(&mut self) -> Vec<OriginalBytes> {
        self.length = 0;
        std::mem::take(&mut self.waiting)
    }
}

/// The bytes of an array in a recording.
#[derive(Debug)]
pub struct RecordedBytes {
    messages: Messages,
    topic: String,
    first: Option<OriginalBytes>,
}

impl RecordedBytes {
    /// Opens the recording of a board. Error if it holds no bytes of an array.
    pub fn open(recording: &BoardRecording) -> Result<RecordedBytes> {
        recording.overview()?;
        let topic = recording.topic(ORIGINAL);
        let messages = Messages::of_topic(&recording.path, &topic)?;
        let mut bytes = RecordedBytes { messages, topic, first: None };
        bytes.first = bytes.next()?;
        require!(bytes.first.is_some(), UsageError::Argument, "{recording} holds no bytes of an array");
        Ok(bytes)
    }

    /// Next bytes; none at the end. Error if the disk cannot be read.
    pub fn next(&mut self) -> Result<Option<OriginalBytes>> {
        if let Some(first) = self.first.take() {
            return Ok(Some(first));
        }
        while let Some((_, topic, data)) = self.messages.next_with_topic()? {
            if topic == self.topic
                && let Some(original) = OriginalBytes::read(data)
            {
                return Ok(Some(original));
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_read_as_they_were_written_and_nothing_else_is_one() {
        for is_datagram in [false, true] {
            let original = OriginalBytes { arrival_us: u64::MAX - 7, is_datagram, bytes: vec![0, 255, 10] };
            assert_eq!(OriginalBytes::read(&original.message()), Some(original));
        }
        assert_eq!([&[0; 8][..], &[], &[2; 12]].map(OriginalBytes::read), [None, None, None]);
    }

    #[test]
    fn a_queue_that_nobody_takes_from_has_an_end() {
        let mut queue = OriginalQueue::default();
        for arrival_us in 0..100 {
            queue.push(OriginalBytes { arrival_us, is_datagram: false, bytes: vec![0; 64 << 10] });
        }
        assert_eq!((queue.take().len(), queue.dropped), (64, 36 * (64 << 10)));
        assert!(queue.take().is_empty());
    }
}
