//! The frame: `COBS( postcard(message) ++ CRC-32/ISO-HDLC of those bytes, little-endian ) ++ 0x00`.
//!
//! | layer | what it is for | cost |
//! |---|---|---|
//! | postcard | the message: varints, no field names | - |
//! | CRC-32/ISO-HDLC (zlib, Ethernet) | finds any change of the message | 4 bytes; a table of 1 KiB in flash |
//! | COBS | no zero inside a frame, so that 0x00 ends it and nothing else does | 1 byte, and 1 for each 254 |
//!
//! The CRC is checked over the bytes as received, before anything reads them as a message; a message that
//! leaves bytes over is an error. The length of a frame is known before it is written: [`frame_bound`].

use super::{cobs, crc32, writer};
use core::fmt;
use core::ops::Range;
use serde::{Deserialize, Serialize};

/// Why some bytes are no message, or a message is no bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WireError {
    /// More bytes without a 0x00 than the receiver can hold.
    TooLong,
    /// Fewer bytes than one byte of message and its CRC.
    TooShort,
    /// A code byte points past the end of the frame, or there is a 0x00 inside.
    Cobs,
    /// The CRC does not fit the bytes.
    Crc,
    /// The CRC fits, but the bytes are no message of this type.
    Message,
    /// There are bytes after the message.
    LeftOver,
    /// The buffer of the caller is too small for the frame.
    NoRoom,
}

impl fmt::Display for WireError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            WireError::TooLong => "the frame is longer than the receiver can hold",
            WireError::TooShort => "the frame is shorter than one byte of message and its CRC",
            WireError::Cobs => "the frame is not valid COBS",
            WireError::Crc => "the CRC-32 of the frame does not fit its bytes",
            WireError::Message => "the frame is intact but holds no known message",
            WireError::LeftOver => "the frame holds bytes after its message",
            WireError::NoRoom => "the buffer is too small for the frame",
        })
    }
}

impl core::error::Error for WireError {}

/// The longest frame, with its 0x00, of a message of `bytes` bytes.
pub const fn frame_bound(bytes: usize) -> usize {
    let body = bytes.saturating_add(crc32::BYTES);
    body.saturating_add(cobs::between(body)).saturating_add(2)
}

/// Writes `message` into `out` as one frame with its 0x00, and returns that; [`frame_bound`] tells what `out`
/// needs.
pub fn encode<'a, T: Serialize + ?Sized>(message: &T, out: &'a mut [u8]) -> Result<&'a [u8], WireError> {
    let frame = frame(message, out)?;
    out.get(frame).ok_or(WireError::NoRoom)
}

/// As [`encode`]; where the frame stands.
pub(crate) fn frame<T: Serialize + ?Sized>(message: &T, out: &mut [u8]) -> Result<Range<usize>, WireError> {
    // What a frame of this length needs between its bytes, and a byte before them.
    let start = 1 + out.len().saturating_sub(2) / 255;
    let bytes = writer::write(message, out.get_mut(start..).unwrap_or(&mut []))?;
    if bytes == 0 {
        return Err(WireError::TooShort);
    }
    close(out, start..start + bytes).ok_or(WireError::NoRoom)
}

/// Makes a frame of the message in `message`, there: where it stands, with its 0x00. It needs [`lead`] bytes
/// before it, and `None` means that there is no room.
pub(crate) fn close(place: &mut [u8], message: Range<usize>) -> Option<Range<usize>> {
    let crc = crc32::of(place.get(message.clone())?);
    *place.get_mut(message.end..)?.first_chunk_mut()? = crc.to_le_bytes();
    cobs::stuff(place, message.start..message.end + crc32::BYTES)
}

/// Bytes before a message of `bytes` bytes that becomes a frame where it stands.
pub(crate) const fn lead(bytes: usize) -> usize {
    1 + cobs::between(bytes + crc32::BYTES)
}

/// Opens one received `frame` (without its 0x00) in place: checks length, COBS and CRC, and returns the
/// message's bytes.
pub fn open(frame: &mut [u8]) -> Result<&[u8], WireError> {
    if frame.len() <= crc32::BYTES + 1 {
        return Err(WireError::TooShort);
    }
    let bytes = cobs::unstuff(frame).ok_or(WireError::Cobs)?;
    let whole = frame.get(..bytes).ok_or(WireError::Cobs)?;
    match whole.split_last_chunk::<{ crc32::BYTES }>() {
        None | Some(([], _)) => Err(WireError::TooShort),
        Some((message, tail)) if crc32::of(message) == u32::from_le_bytes(*tail) => Ok(message),
        Some(_) => Err(WireError::Crc),
    }
}

/// Reads the bytes of [`open`] as a message, which may borrow from them.
pub fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, WireError> {
    match postcard::take_from_bytes(bytes) {
        Ok((message, [])) => Ok(message),
        Ok(_) => Err(WireError::LeftOver),
        Err(_) => Err(WireError::Message),
    }
}
