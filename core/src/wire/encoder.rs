//! Writes the code of an image; the [module of its reader](super::image) says what it is.
//!
//! Runs with at most `GAP` = 1 unchanged taxel between them are joined: a new run costs at least 2 bytes, an unchanged
//! taxel within one costs 1 (alone: 2 for the first after a value above 63). 2 would cost as much, 0 costs 6 % more on a
//! pressed image that does not move.
//!
//! Quiet taxels are looked at 8 at a time: 30 cycles of an M0+ for 8 of them, 58 with a base, counted in its instructions.

use core::slice;

/// Unchanged taxels between two changed ones that do not end a run.
const GAP: usize = 1;

/// No varint of an image is as large: 3 bytes hold 21 bits.
const LIMIT: usize = 1 << 21;

/// Codes `values` into `out` and returns the length. `None`: no room, or a base of another length, or 2^21 taxels.
pub fn encode_image(values: &[u16], base: Option<&[u16]>, out: &mut [u8]) -> Option<usize> {
    if values.len() >= LIMIT || base.is_some_and(|base| base.len() != values.len()) {
        return None;
    }
    let room = out.len();
    let mut encoder = Encoder::new(out);
    encoder.part(0, values, base)?;
    Some(room - encoder.room())
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

/// Writes the code of an image part by part, in the order of the taxels; those between two parts keep the reference.
pub(super) struct Encoder<'a> {
    out: slice::IterMut<'a, u8>,
    /// First taxel that is not told yet.
    told: usize,
    /// What the written runs change in the [`image_sum`] of the reference.
    sum: u32,
}

impl<'a> Encoder<'a> {
    pub fn new(out: &'a mut [u8]) -> Self {
        Encoder { out: out.iter_mut(), told: 0, sum: 0 }
    }

    /// Bytes that are left.
    pub fn room(&self) -> usize {
        self.out.len()
    }

    /// What the image sums up to more than its reference.
    pub fn sum(&self) -> u32 {
        self.sum
    }

    /// Codes the taxels from number `start` on. `None`: no room.
    pub fn part(&mut self, mut start: usize, mut values: &[u16], mut base: Option<&[u16]>) -> Option<()> {
        loop {
            let skip = quiet(values, base);
            (values, base) = (values.get(skip..)?, after(base, skip)?);
            if values.is_empty() {
                return Some(());
            }
            let count = match base {
                None => run(values.iter().map(|value| *value != 0)),
                Some(base) => run(values.iter().zip(base).map(|(value, base)| value != base)),
            };
            start += skip;
            self.varint((start - self.told) as u32)?;
            self.varint(count as u32)?;
            let (now, later) = values.split_at_checked(count)?;
            match base {
                None => self.alone(start, now)?,
                Some(base) => self.differences(start, now, base)?,
            }
            start += count;
            self.told = start;
            (values, base) = (later, after(base, count)?);
        }
    }

    fn alone(&mut self, start: usize, values: &[u16]) -> Option<()> {
        let (mut last, mut place) = (0, start as u32);
        values.iter().try_for_each(|value| {
            let value = i32::from(*value);
            place = place.wrapping_add(1);
            self.sum = self.sum.wrapping_add(place.wrapping_mul(value as u32));
            self.zigzag(value - core::mem::replace(&mut last, value))
        })
    }

    fn differences(&mut self, start: usize, values: &[u16], base: &[u16]) -> Option<()> {
        let mut place = start as u32;
        values.iter().zip(base).try_for_each(|(value, base)| {
            let difference = i32::from(*value) - i32::from(*base);
            place = place.wrapping_add(1);
            self.sum = self.sum.wrapping_add(place.wrapping_mul(difference as u32));
            self.zigzag(difference)
        })
    }

    fn zigzag(&mut self, difference: i32) -> Option<()> {
        self.varint((difference << 1 ^ difference >> 31) as u32)
    }

    fn varint(&mut self, mut value: u32) -> Option<()> {
        while value > 127 {
            *self.out.next()? = value as u8 | 128;
            value >>= 7;
        }
        *self.out.next()? = value as u8;
        Some(())
    }
}

/// The base from a taxel on; `None` if it ends before, which it does not.
fn after(base: Option<&[u16]>, taxels: usize) -> Option<Option<&[u16]>> {
    match base {
        None => Some(None),
        Some(base) => base.get(taxels..).map(Some),
    }
}
