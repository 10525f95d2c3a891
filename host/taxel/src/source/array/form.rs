//! How a stream is cut into frames, as a description says it.

use super::checksum::FrameCheck;
use super::marked::RecordForm;
use super::number::NumberForm;
use super::stamp::TimeUnit;
use serde::Deserialize;
use std::ops::Range;

/// Kind of the frames, and its keys.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum FrameForm {
    /// Numbers in bytes, between markers or as an answer.
    Bytes(BytesForm),
    /// A frame a line.
    Lines {
        /// Text between numbers.
        separator: Option<String>,
        /// Start of lines that hold a frame.
        prefix: Option<String>,
        /// Field of the sensor's time.
        time: Option<TimeField>,
        /// Further leading fields.
        #[serde(default)]
        skip: usize,
    },
    /// A row a line, an empty line between frames.
    Rows {
        /// Text between numbers.
        separator: Option<String>,
        /// Start of lines that hold a row.
        prefix: Option<String>,
        /// Leading fields.
        #[serde(default)]
        skip: usize,
    },
    /// Counted zeros.
    Zeros {},
    /// Packets of WiReSens.
    Wiresens {
        /// Values of a packet.
        nodes: u16,
        /// Number of the sensor to follow; the first one by default.
        id: Option<i8>,
        /// Packets end with `"wr"`.
        #[serde(default)]
        trailer: bool,
    },
}

/// Place of a time in a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeField {
    /// Index behind the prefix.
    pub field: usize,
    /// Its unit.
    pub unit: TimeUnit,
}

/// Frames of bytes.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BytesForm {
    /// Marker in front, hexadecimal.
    pub head: Option<String>,
    /// Marker behind, hexadecimal.
    pub tail: Option<String>,
    /// Form of a value.
    pub value: NumberForm,
    /// The checksum.
    #[serde(default)]
    pub check: FrameCheck,
    /// Checked bytes; all of the frame by default.
    pub over: Option<Checked>,
    /// Bytes between head and values.
    #[serde(default)]
    pub before: usize,
    /// Bytes between values and checksum.
    #[serde(default)]
    pub after: usize,
    /// Place of the frame's number.
    pub sequence: Option<SequencePlace>,
    /// Place of the frame's time.
    pub time: Option<TimePlace>,
}

/// Checked bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Checked {
    /// All but the head.
    #[serde(rename = "before..after")]
    Body,
}

/// Place of a number in a frame, head included.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SequencePlace {
    /// First byte.
    pub at: usize,
    /// Its form.
    #[serde(rename = "type")]
    pub form: NumberForm,
}

/// Place of a time in a frame, head included.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimePlace {
    /// First byte.
    pub at: usize,
    /// Its form.
    #[serde(rename = "type")]
    pub form: NumberForm,
    /// Its unit.
    pub unit: TimeUnit,
}

impl BytesForm {
    /// Bytes of this number of values.
    pub(crate) fn value_bytes(&self, values: usize) -> usize {
        values * self.value.bits() / 8
    }

    /// Bytes of the values in a frame.
    pub fn values(&self, values: usize) -> Range<usize> {
        let head = marker(self.head.as_deref()).ok().flatten().map_or(0, |head| head.len());
        let start = head + self.before;
        start..start + self.value_bytes(values)
    }

    /// Form of the records of frames of this number of values; none without head and tail. Error: the key that is
    /// wrong, and why.
    pub fn record(&self, values: usize) -> Result<Option<RecordForm>, (&'static str, String)> {
        let head = marker(self.head.as_deref()).map_err(|why| ("frame.head", why))?;
        let tail = marker(self.tail.as_deref()).map_err(|why| ("frame.tail", why))?;
        let body = self.before + self.value_bytes(values) + self.after + self.check.length();
        let form = |open: Vec<u8>, close: Vec<u8>, shares, frame| {
            let checked = if self.over.is_some() || head.is_none() { open.len() } else { 0 };
            RecordForm { open, body, close, shares, frame, check: self.check, checked }
        };
        Ok(match (&head, &tail) {
            (None, None) => None,
            (None, Some(tail)) => {
                let frame = tail.len()..tail.len() + body;
                Some(form(tail.clone(), tail.clone(), true, frame))
            }
            (Some(head), None) if self.check == FrameCheck::None => {
                Some(form(head.clone(), head.clone(), true, 0..head.len() + body))
            }
            (Some(head), tail) => {
                let tail = tail.clone().unwrap_or_default();
                Some(form(head.clone(), tail, false, 0..head.len() + body))
            }
        })
    }
}

/// Reads a marker: pairs of hexadecimal digits.
fn marker(text: Option<&str>) -> Result<Option<Vec<u8>>, String> {
    let Some(text) = text else { return Ok(None) };
    let digits: Option<Vec<u8>> = text
        .chars()
        .filter(|sign| !sign.is_whitespace())
        .map(|sign| Some(sign.to_digit(16)? as u8))
        .collect();
    match digits.as_deref().map(|digits| digits.as_chunks().0) {
        Some(bytes)
            if (1..=8).contains(&bytes.len()) && digits.as_ref().is_some_and(|all| all.len() % 2 == 0) =>
        {
            Ok(Some(bytes.iter().map(|[high, low]: &[u8; 2]| high << 4 | low).collect()))
        }
        _ => Err(format!("\"{text}\" must be 1 to 8 bytes, each of two hexadecimal digits")),
    }
}
