//! Lossless coding of the conditioned image, alone or as the difference to a base image.
//!
//! The code is a sequence of runs: `varint(skip) varint(count)`, then `count` zigzag varints. `skip` taxels keep the
//! reference (the base; alone: 0), then `count` taxels are given; what follows the last run keeps the reference. With a
//! base each number is `value - base`; alone it is the value less the one before it in the run (the first: less 0).
//! Varints are those of postcard (7 bits a byte, the lowest first), at most 3 bytes and never longer than needed.
//!
//! Runs with at most `GAP` = 1 unchanged taxel between them are joined: a new run costs at least 2 bytes, an unchanged
//! taxel within one costs 1 (alone: 2 for the first after a value above 63). 2 would cost as much, 0 costs 6 % more on a
//! pressed image that does not move.
//!
//! | 2,048 taxels, 12 bits | bytes |
//! |---|---|
//! | nothing changed | 0 |
//! | 5 contacts, 231 taxels, noise of 3 counts: alone | 534 |
//! | the same, difference: at rest / moving 6 / 59 taxels a second (195 frames/s) | 297 / 313 / 510 |
//! | most, see [`image_bound`] | 4,099 |
//!
//! The table is asserted by `tests/wire.rs`. Quiet taxels are looked at 8 at a time: 30 cycles of an M0+ for 8 of them,
//! 58 with a base, counted in its instructions (2,048 taxels at 125 MHz: 0.06 and 0.12 ms).

use core::{fmt, slice};

/// Unchanged taxels between two changed ones that do not end a run.
const GAP: usize = 1;

/// No varint of an image is as large: 3 bytes hold 21 bits.
const LIMIT: usize = 1 << 21;

/// The longest code of an image of `taxels` taxels of `bits` bits: the numbers and one run's head.
///
/// Every later run follows at least 2 unchanged taxels, which cost nothing, and its head has at most 4 bytes.
pub const fn image_bound(taxels: usize, bits: u32) -> usize {
    // A difference has one bit more than a value.
    let each = match bits {
        0..7 => 1,
        7..14 => 2,
        _ => 3,
    };
    taxels.saturating_mul(each).saturating_add(4)
}

/// The checksum of an image: the sum of `(i + 1) * value`, modulo 2^32. It tells that a base is the one meant.
pub fn image_sum(values: &[u16]) -> u32 {
    let mut place = 0u32;
    values.iter().fold(0, |sum: u32, value| {
        place = place.wrapping_add(1);
        sum.wrapping_add(place.wrapping_mul(u32::from(*value)))
    })
}

/// Codes `values` into `out` and returns the length. `None`: no room, or a base of another length, or 2^21 taxels.
pub fn encode_image(values: &[u16], base: Option<&[u16]>, out: &mut [u8]) -> Option<usize> {
    if values.len() >= LIMIT || base.is_some_and(|base| base.len() != values.len()) {
        return None;
    }
    let room = out.len();
    let mut writer = Writer(out.iter_mut());
    let (mut values, mut base) = (values, base);
    loop {
        let skip = quiet(values, base);
        (values, base) = (values.get(skip..)?, after(base, skip)?);
        if values.is_empty() {
            return Some(room - writer.0.len());
        }
        let count = match base {
            None => run(values.iter().map(|value| *value != 0)),
            Some(base) => run(values.iter().zip(base).map(|(value, base)| value != base)),
        };
        writer.varint(skip as u32)?;
        writer.varint(count as u32)?;
        let (now, later) = values.split_at_checked(count)?;
        match base {
            None => writer.alone(now)?,
            Some(base) => writer.differences(now, base)?,
        }
        (values, base) = (later, after(base, count)?);
    }
}

/// The base from a taxel on; `None` if it ends before, which it does not.
fn after(base: Option<&[u16]>, taxels: usize) -> Option<Option<&[u16]>> {
    match base {
        None => Some(None),
        Some(base) => base.get(taxels..).map(Some),
    }
}

/// How many taxels from the first on are unchanged: this is the loop that sees all quiet taxels.
fn quiet(values: &[u16], base: Option<&[u16]>) -> usize {
    let (blocks, _) = values.as_chunks::<8>();
    let Some(base) = base else {
        let whole = blocks.iter().take_while(|block| zero(block)).count() * 8;
        return whole + values.iter().skip(whole).take_while(|value| **value == 0).count();
    };
    let pairs = blocks.iter().zip(base.as_chunks::<8>().0);
    let whole = pairs.take_while(|(block, base)| equal(block, base)).count() * 8;
    whole + values.iter().zip(base).skip(whole).take_while(|(value, base)| value == base).count()
}

/// Written out, because a compiler that optimises for size keeps a loop.
fn zero([a, b, c, d, e, f, g, h]: &[u16; 8]) -> bool {
    a | b | c | d | e | f | g | h == 0
}

fn equal([a, b, c, d, e, f, g, h]: &[u16; 8], [i, j, k, l, m, n, o, p]: &[u16; 8]) -> bool {
    (a ^ i) | (b ^ j) | (c ^ k) | (d ^ l) | (e ^ m) | (f ^ n) | (g ^ o) | (h ^ p) == 0
}

/// How many taxels the run has that starts with the first.
fn run(changed: impl Iterator<Item = bool>) -> usize {
    let mut count = 0;
    for (at, changed) in changed.enumerate() {
        if changed {
            count = at + 1;
        } else if at - count >= GAP {
            break;
        }
    }
    count
}

struct Writer<'a>(slice::IterMut<'a, u8>);

impl Writer<'_> {
    fn varint(&mut self, mut value: u32) -> Option<()> {
        while value > 127 {
            *self.0.next()? = value as u8 | 128;
            value >>= 7;
        }
        *self.0.next()? = value as u8;
        Some(())
    }

    fn zigzag(&mut self, value: u16, reference: u16) -> Option<()> {
        let difference = i32::from(value) - i32::from(reference);
        self.varint((difference << 1 ^ difference >> 31) as u32)
    }

    fn alone(&mut self, values: &[u16]) -> Option<()> {
        let mut last = 0;
        values.iter().try_for_each(|value| self.zigzag(*value, core::mem::replace(&mut last, *value)))
    }

    fn differences(&mut self, values: &[u16], base: &[u16]) -> Option<()> {
        values.iter().zip(base).try_for_each(|(value, base)| self.zigzag(*value, *base))
    }
}

/// What is wrong with the code of an image, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageError {
    /// Bytes that had been read.
    pub byte: usize,
    /// What is wrong.
    pub fault: ImageFault,
}

/// What can be wrong with the code of an image.
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

/// Decodes `data` into all of `out`. After an error `out` is part of one image and part of another: not to be used.
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
