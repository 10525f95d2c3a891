//! Lossless coding of the conditioned image, alone or as the difference to a base image.
//!
//! The code is a sequence of runs: `varint(skip) varint(count)`, then `count` zigzag varints. `skip` taxels
//! keep the reference (the base; alone: 0), then `count` taxels are given; all taxels after the last run keep
//! the reference. With a base each number is `value - base`; alone it is the value minus the one before it in
//! the run (the first: minus 0). Varints are those of postcard (7 bits a byte, the lowest first), at most 3
//! bytes and never longer than needed.
//!
//! | 2,048 taxels, 12 bits | bytes |
//! |---|---|
//! | nothing changed | 0 |
//! | 5 contacts, 231 taxels, noise of 3 counts: alone | 534 |
//! | the same, difference: at rest / moving 6 / 59 taxels a second (195 frames/s) | 297 / 313 / 510 |
//! | most, see [`image_bound`] | 4,122 |
//!
//! The table is asserted by `core/tests/core/wire.rs`.

use core::{fmt, slice};

/// Greatest number of taxels of a run: its length takes one byte, which is reserved and filled in at the end
/// of the run.
pub(super) const RUN: usize = 127;

/// Greatest length of the code of an image of `taxels` taxels of `bits` bits: the numbers and the heads of
/// the runs.
///
/// A run that ends before its greatest length is followed by at least 2 unchanged taxels, which cost nothing;
/// the head of the next has at most 4 bytes.
pub const fn image_bound(taxels: usize, bits: u32) -> usize {
    // A difference has one bit more than a value.
    let each = match bits {
        0..7 => 1,
        7..14 => 2,
        _ => 3,
    };
    taxels.saturating_mul(each).saturating_add(2 * (taxels / RUN)).saturating_add(4)
}

/// Checksum of an image: the sum of `(i + 1) * value`, modulo 2^32. It proves that a base is the right one.
pub fn image_sum(values: &[u16]) -> u32 {
    let mut place = 0u32;
    values.iter().fold(0, |sum: u32, value| {
        place = place.wrapping_add(1);
        sum.wrapping_add(place.wrapping_mul(u32::from(*value)))
    })
}

/// Error in the code of an image, with its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageError {
    /// Number of bytes that had been read.
    pub byte: usize,
    /// Kind of error.
    pub fault: ImageFault,
}

/// Kind of error in the code of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageFault {
    /// The base has another number of taxels than the image.
    Base,
    /// The code ends within a run.
    Truncated,
    /// A varint has more than 3 bytes, or more than it needs.
    Varint,
    /// A run has no taxels.
    EmptyRun,
    /// A run ends after the last taxel.
    PastEnd,
    /// A value is outside 0 ..= 65535.
    Range,
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fault = match self.fault {
            ImageFault::Base => "the base image has another number of taxels",
            ImageFault::Truncated => "the image ends within a run",
            ImageFault::Varint => "a varint is too long",
            ImageFault::EmptyRun => "a run has no taxels",
            ImageFault::PastEnd => "a run ends after the last taxel",
            ImageFault::Range => "a value is outside 0 ..= 65535",
        };
        write!(f, "byte {}: {fault}", self.byte)
    }
}

impl core::error::Error for ImageError {}

/// Decodes `data` into all of `out`. After an error `out` mixes two images and must not be used.
pub fn decode_image(data: &[u8], base: Option<&[u16]>, out: &mut [u16]) -> Result<(), ImageError> {
    let mut bytes = data.iter();
    let done = start(base, out).and_then(|()| runs(&mut bytes, base.is_none(), out));
    done.map_err(|fault| ImageError { byte: data.len() - bytes.len(), fault })
}

fn start(base: Option<&[u16]>, out: &mut [u16]) -> Result<(), ImageFault> {
    match base {
        None => out.fill(0),
        Some(base) if base.len() == out.len() => out.iter_mut().zip(base).for_each(|(to, from)| *to = *from),
        Some(_) => return Err(ImageFault::Base),
    }
    Ok(())
}

fn runs(bytes: &mut slice::Iter<u8>, alone: bool, mut rest: &mut [u16]) -> Result<(), ImageFault> {
    while !bytes.as_slice().is_empty() {
        let skip = varint(bytes)? as usize;
        let count = varint(bytes)? as usize;
        if count == 0 {
            return Err(ImageFault::EmptyRun);
        }
        let from = rest.get_mut(skip..).ok_or(ImageFault::PastEnd)?;
        let (run, later) = from.split_at_mut_checked(count).ok_or(ImageFault::PastEnd)?;
        let mut last = 0;
        for value in run {
            let zigzag = varint(bytes)? as i32;
            let reference = if alone { last } else { *value };
            let sum = i32::from(reference) + (zigzag >> 1 ^ -(zigzag & 1));
            *value = u16::try_from(sum).map_err(|_| ImageFault::Range)?;
            last = *value;
        }
        rest = later;
    }
    Ok(())
}

fn varint(bytes: &mut slice::Iter<u8>) -> Result<u32, ImageFault> {
    let mut value = 0;
    for shift in [0, 7, 14] {
        let byte = *bytes.next().ok_or(ImageFault::Truncated)?;
        value |= u32::from(byte & 127) << shift;
        if byte < 128 {
            return if byte == 0 && shift > 0 { Err(ImageFault::Varint) } else { Ok(value) };
        }
    }
    Err(ImageFault::Varint)
}
