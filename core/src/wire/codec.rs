//! The frame: `COBS( postcard(message) ++ CRC-32/ISO-HDLC of those bytes, little-endian ) ++ 0x00`.
//!
//! | layer | what it is for | cost |
//! |---|---|---|
//! | postcard | the message: varints, no field names | - |
//! | CRC-32/ISO-HDLC (zlib, Ethernet) | finds any change of the message | 4 bytes; a table of 1 KiB in flash |
//! | COBS | no zero inside a frame, so that 0x00 ends it and nothing else does | 1 byte, and 1 for each 254 |
//!
//! The CRC is checked over the bytes as received, before anything reads them as a message; a message that leaves bytes
//! over is an error. The length of a frame is known before it is written: [`frame_bound`].
//!
//! COBS is coded here and not by the crate `cobs` (0.3): that one walks its buffers by plain indices, whose checks are
//! panics in the image unless the optimiser proves every one of them away, and it takes a zero inside a frame for the
//! frame's end. The test below compares the two.

use core::fmt;
use core::mem::{replace, take};

use crc::{CRC_32_ISO_HDLC, Crc, Table};
use serde::{Deserialize, Serialize};

/// A `static`: a `const` would copy the table to the stack of each user.
static CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// Bytes of the CRC.
pub(crate) const CRC_BYTES: usize = 4;

/// Most bytes of a group of COBS.
const GROUP: usize = 254;

/// Bytes that are stuffed together.
const BLOCK: usize = 8;

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
    let body = bytes.saturating_add(CRC_BYTES);
    body.saturating_add(body / 254).saturating_add(2)
}

/// Writes `message` into `out` as one frame with its 0x00 and returns the frame's length.
///
/// `body` is scratch space, for the message and 4 bytes more; [`frame_bound`] tells what `out` needs.
pub fn encode<T: Serialize + ?Sized>(
    message: &T,
    body: &mut [u8],
    out: &mut [u8],
) -> Result<usize, WireError> {
    stuff(pack(message, body)?, out).ok_or(WireError::NoRoom)
}

/// Writes `message` and its CRC into `body`.
pub(crate) fn pack<'a, T: Serialize + ?Sized>(
    message: &T,
    body: &'a mut [u8],
) -> Result<&'a [u8], WireError> {
    let bytes = match postcard::to_slice(message, body) {
        Ok(used) => used.len(),
        Err(postcard::Error::SerializeBufferFull) => return Err(WireError::NoRoom),
        Err(_) => return Err(WireError::Message),
    };
    if bytes == 0 {
        return Err(WireError::TooShort);
    }
    body.get_mut(..bytes + CRC_BYTES).and_then(sealed).ok_or(WireError::NoRoom)
}

/// A message whose last bytes were left free for its CRC.
#[inline(never)]
pub(crate) fn sealed(whole: &mut [u8]) -> Option<&[u8]> {
    let (message, tail) = whole.split_last_chunk_mut::<CRC_BYTES>()?;
    *tail = CRC.checksum(message).to_le_bytes();
    Some(whole)
}

/// Opens one received `frame` (without its 0x00) in place: checks length, COBS and CRC, and returns the message's bytes.
pub fn open(frame: &mut [u8]) -> Result<&[u8], WireError> {
    if frame.len() <= CRC_BYTES + 1 {
        return Err(WireError::TooShort);
    }
    let bytes = unstuff(frame).ok_or(WireError::Cobs)?;
    let whole = frame.get(..bytes).ok_or(WireError::Cobs)?;
    match whole.split_last_chunk::<CRC_BYTES>() {
        None | Some(([], _)) => Err(WireError::TooShort),
        Some((message, tail)) if CRC.checksum(message) == u32::from_le_bytes(*tail) => Ok(message),
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

/// COBS of `data` and a 0x00 into `out`; the length of both, or `None` if there is no room.
///
/// Data that end with a full group of 254 bytes end with it: no empty group follows.
#[inline(never)] // the few registers of an M0+ are for its loop
pub(crate) fn stuff(data: &[u8], out: &mut [u8]) -> Option<usize> {
    let room = out.len();
    let (head, mut out) = out.split_first_mut()?;
    let mut group = Group { head, length: 0 };
    let mut data = data;
    loop {
        // Most bytes are far from the end of a full group.
        while group.length <= GROUP - BLOCK
            && let Some((block, later)) = data.split_first_chunk::<BLOCK>()
        {
            let (to, rest) = take(&mut out).split_first_chunk_mut::<BLOCK>()?;
            block.iter().zip(to).for_each(|(byte, to)| group.take(*byte, to));
            (data, out) = (later, rest);
        }
        let Some((byte, later)) = data.split_first() else { break };
        if group.length == GROUP {
            group.end(take_first(&mut out)?);
        }
        group.take(*byte, take_first(&mut out)?);
        data = later;
    }
    let end = room - out.len() + 1;
    let last = take_first(&mut out)?;
    *last = 0;
    *group.head = group.length as u8 + 1;
    Some(end)
}

fn take_first<'a>(out: &mut &'a mut [u8]) -> Option<&'a mut u8> {
    let (first, rest) = take(out).split_first_mut()?;
    *out = rest;
    Some(first)
}

/// A group of COBS: a byte that tells where the next one begins, and bytes that are not 0. A 0 of the data is where the next
/// begins.
struct Group<'a> {
    head: &'a mut u8,
    length: usize,
}

impl<'a> Group<'a> {
    #[inline(always)]
    fn take(&mut self, byte: u8, to: &'a mut u8) {
        if byte == 0 {
            self.end(to);
        } else {
            *to = byte;
            self.length += 1;
        }
    }

    /// The next one begins at `next`.
    #[inline(always)]
    fn end(&mut self, next: &'a mut u8) {
        *replace(&mut self.head, next) = self.length as u8 + 1;
        self.length = 0;
    }
}

/// Undoes COBS in place; the length of the data, or `None` if `frame` is not COBS.
fn unstuff(frame: &mut [u8]) -> Option<usize> {
    let (mut from, mut to) = (0, 0);
    while let Some(code) = frame.get(from).copied() {
        let next = from + usize::from(code);
        if code == 0 || next > frame.len() {
            return None;
        }
        for at in from + 1..next {
            let byte = *frame.get(at).filter(|byte| **byte != 0)?;
            *frame.get_mut(to)? = byte;
            to += 1;
        }
        // A group shorter than 255 stands for its bytes and a zero, but for the last one.
        if code != 255 && next < frame.len() {
            *frame.get_mut(to)? = 0;
            to += 1;
        }
        from = next;
    }
    Some(to)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    /// Lengths around the group of 254, with zeros in every place that matters.
    fn data() -> impl Iterator<Item = Vec<u8>> {
        let lengths = [1, 2, 5, 252, 253, 254, 255, 256, 507, 508, 509, 510, 762];
        let zeros = [usize::MAX, 0, 1, 252, 253, 254, 255, 507, 508];
        lengths.into_iter().flat_map(move |length| {
            zeros.into_iter().map(move |zero| {
                let byte = |i| if i == zero || i + 1 == length && zero == 1 { 0 } else { i as u8 | 1 };
                (0..length).map(byte).collect()
            })
        })
    }

    #[test]
    fn cobs_is_that_of_the_crate_cobs() {
        for data in data() {
            let mut mine = [0xaa; 800];
            let length = stuff(&data, &mut mine).unwrap();
            assert!(length <= frame_bound(data.len()) - CRC_BYTES);
            assert_eq!(stuff(&data, &mut mine[..length]), Some(length));
            assert_eq!(stuff(&data, &mut [0; 800][..length - 1]), None);
            let (frame, end) = mine[..length].split_at_mut(length - 1);
            assert!(*end == [0] && !frame.contains(&0));
            let mut theirs = [0; 800];
            assert_eq!(cobs::decode(frame, &mut theirs), Ok(data.len()));
            assert_eq!(theirs[..data.len()], data);
            let length = cobs::try_encode(&data, &mut theirs).unwrap();
            assert_eq!(theirs[..length], *frame);
            assert_eq!(unstuff(frame), Some(data.len()));
            assert_eq!(frame[..data.len()], data);
        }
    }

    #[test]
    fn what_is_not_cobs_is_refused() {
        for frame in [&mut [0][..], &mut [2], &mut [3, 1], &mut [3, 1, 0], &mut [1, 0, 1], &mut [255; 254]] {
            assert_eq!(unstuff(frame), None);
        }
        // Other encoders append an empty group to a full one; it means the same.
        let mut frame = [255; 256];
        frame[255] = 1;
        assert_eq!(unstuff(&mut frame), Some(254));
    }
}
