//! The frame: `COBS( postcard(message) ++ CRC-32/ISO-HDLC of those bytes, little-endian ) ++ 0x00`.
//!
//! | layer | purpose | cost |
//! |---|---|---|
//! | postcard | the message: varints, no field names | - |
//! | CRC-32/ISO-HDLC (zlib, Ethernet) | detects changes of the message | 4 bytes; a table of 1 KiB in flash |
//! | COBS | no zero inside a frame, so that only its end is 0x00 | 1 byte, and 1 for each 254 |
//!
//! The CRC is checked over the bytes as received, before they are decoded. The length of a frame has a bound
//! before it is written: [`frame_bound`].

use super::error::WireError;
use super::rest::Rest;
use super::{cobs, writer};
use crate::format::crc32;
use core::ops::Range;
use serde::{Deserialize, Serialize};

/// Number of bytes of the CRC.
const CRC_BYTES: usize = 4;

/// Greatest length of a frame, with its 0x00, for a message of `bytes` bytes.
pub const fn frame_bound(bytes: usize) -> usize {
    let body = bytes.saturating_add(CRC_BYTES);
    body.saturating_add(cobs::between(body)).saturating_add(2)
}

/// Encodes `message` into `out` as one frame with its 0x00, and returns the frame. [`frame_bound`] gives the
/// room that it needs.
pub fn encode<'a, T: Serialize + ?Sized>(message: &T, out: &'a mut [u8]) -> Result<&'a [u8], WireError> {
    let message = put(message, out)?;
    let frame = close(out, message, &mut ()).ok_or(WireError::NoRoom)?;
    out.get(frame).ok_or(WireError::NoRoom)
}

/// Computes the CRC-32/ISO-HDLC of messages; a board's chip may have hardware for it.
pub trait Checksum {
    /// Returns what [`crc32`] returns.
    fn crc32(&mut self, bytes: &[u8]) -> u32 {
        crc32(bytes)
    }
}

/// By table.
impl Checksum for () {}

/// Writes `message` into `out`, with the room around it that [`close`] needs; returns its range.
pub(crate) fn put<T: Serialize + ?Sized>(message: &T, out: &mut [u8]) -> Result<Range<usize>, WireError> {
    // Room before the message: for the extra code bytes of a frame of this length, and for the first one.
    let start = 1 + out.len().saturating_sub(2) / 255;
    let end = out.len().saturating_sub(CRC_BYTES + 1);
    match writer::write(message, out.get_mut(start..end).unwrap_or(&mut []))? {
        0 => Err(WireError::TooShort),
        bytes => Ok(start..start + bytes),
    }
}

/// Turns the range `message` into a frame in place; returns the range of the frame with its 0x00. It needs
/// [`lead`] bytes before the message. `None` if there is no room.
pub(crate) fn close(
    place: &mut [u8],
    message: Range<usize>,
    checksum: &mut impl Checksum,
) -> Option<Range<usize>> {
    let crc = checksum.crc32(place.get(message.clone())?);
    *place.get_mut(message.end..)?.first_chunk_mut()? = crc.to_le_bytes();
    cobs::stuff(place, message.start..message.end + CRC_BYTES)
}

/// Bytes needed before a message of `bytes` bytes that becomes a frame in place.
pub(crate) const fn lead(bytes: usize) -> usize {
    1 + cobs::between(bytes + CRC_BYTES)
}

/// Opens one received `frame` (without its 0x00) in place. Checks length, COBS and CRC; returns the bytes of
/// the message.
pub fn open(frame: &mut [u8]) -> Result<&[u8], WireError> {
    if frame.len() <= CRC_BYTES + 1 {
        return Err(WireError::TooShort);
    }
    let whole = cobs::unstuff(frame).ok_or(WireError::Cobs)?;
    match whole.split_last_chunk::<{ CRC_BYTES }>() {
        None | Some(([], _)) => Err(WireError::TooShort),
        Some((message, tail)) if crc32(message) == u32::from_le_bytes(*tail) => Ok(message),
        Some(_) => Err(WireError::Crc),
    }
}

/// Decodes the bytes from [`open`] as a message, which may borrow from them. Fields that a later version has
/// added are passed over; those that an earlier one did not have are 0, none or empty.
pub fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, WireError> {
    let mut fields = postcard::Deserializer::from_flavor(Rest(bytes));
    T::deserialize(&mut fields).map_err(|_| WireError::Message)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec;

    #[test]
    fn the_room_before_a_message_is_enough() {
        for bytes in 1..1200 {
            let start = lead(bytes);
            // Without a zero, each full group takes an extra byte.
            let mut place = vec![0x55; start + bytes + CRC_BYTES + 1];
            let frame = close(&mut place, start..start + bytes, &mut ()).expect("there is room");
            assert!(frame.len() <= frame_bound(bytes) && frame.end <= place.len(), "{bytes} bytes");
            assert_eq!(start, 1 + (bytes + 4) / 254, "{bytes} bytes");
        }
    }
}
