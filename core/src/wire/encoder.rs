//! Writes the code of an image; the [module of its reader](super::image) says what it is.
//!
//! Runs with one unchanged taxel between them are joined: a new run costs at least 2 bytes, an unchanged
//! taxel within one costs 1 (alone: 2 for the first after a value above 63). 2 would cost as much, 0 costs 6 % more on a
//! pressed image that does not move.
//!
//! Quiet taxels far from a run are looked at 8 at a time: 30 cycles of an M0+ for 8 of them, 41 with a base, counted in its
//! instructions. What is near a run is told by [stretches](super::stretch), with about 120 for each.

use super::stretch::{LANES, ROOM, go_on, push, tell, zigzag};
use bytemuck::pod_align_to;
use core::mem::{replace, take};
use core::ops::Range;

/// Most taxels of a run: its length has one byte, which is left free and written at its end.
pub(super) const RUN: usize = 127;

/// No varint of an image is as large: 3 bytes hold 21 bits.
const LIMIT: usize = 1 << 21;

/// Codes `values` into `out` and returns the length. `None`: no room, or a base of another length, or 2^21 taxels.
pub fn encode_image(values: &[u16], base: Option<&[u16]>, out: &mut [u8]) -> Option<usize> {
    if values.len() >= LIMIT || base.is_some_and(|base| base.len() != values.len()) {
        return None;
    }
    let room = out.len();
    let mut encoder = Encoder::new(out);
    encoder.part(0..values.len(), values, base)?;
    Some(room - encoder.room())
}

/// How many taxels from the first on are 0: this is the loop that sees all quiet taxels of an image that stands alone.
fn zeros(values: &[u16]) -> usize {
    let whole = values.as_chunks::<8>().0.iter().take_while(|block| zero(block)).count() * 8;
    whole + values.iter().skip(whole).take_while(|value| **value == 0).count()
}

/// Written out, because a compiler that optimises for size keeps a loop.
fn zero([a, b, c, d, e, f, g, h]: &[u16; 8]) -> bool {
    a | b | c | d | e | f | g | h == 0
}

/// How many taxels from the first on are those of the base: this is the loop that sees most quiet taxels of a difference.
#[inline(never)]
fn same(values: &[u16], base: &[u16]) -> usize {
    let far = same_blocks(values, base);
    let (near, base) = (values.get(far..).unwrap_or(&[]), base.get(far..).unwrap_or(&[]));
    far + near.iter().zip(base).take_while(|(value, base)| value == base).count()
}

/// As [`same`], two by two where both stand alike in memory, and as many as stand in whole blocks.
fn same_blocks(values: &[u16], base: &[u16]) -> usize {
    let ((odd, words, _), (base_odd, base_words, _)) = (pod_align_to(values), pod_align_to(base));
    if odd.first() != base_odd.first() {
        return 0;
    }
    let blocks = words.as_chunks::<4>().0.iter().zip(base_words.as_chunks::<4>().0);
    odd.len() + 8 * blocks.take_while(|(block, base)| equal(block, base)).count()
}

fn equal([a, b, c, d]: &[u32; 4], [e, f, g, h]: &[u32; 4]) -> bool {
    (a ^ e) | (b ^ f) | (c ^ g) | (d ^ h) == 0
}

/// Writes the code of an image part by part, in the order of the taxels; those between two parts keep the reference.
pub(super) struct Encoder<'a> {
    out: &'a mut [u8],
    /// First taxel that is not told yet.
    told: usize,
}

impl<'a> Encoder<'a> {
    pub fn new(out: &'a mut [u8]) -> Self {
        Encoder { out, told: 0 }
    }

    /// Bytes that are left.
    pub fn room(&self) -> usize {
        self.out.len()
    }

    /// Codes a part of the taxels. `values`, and the base, may go on behind it: two at least keep the reference there, and what begins
    /// behind them is told here or with the next part. `None`: no room.
    pub fn part(&mut self, part: Range<usize>, values: &[u16], base: Option<&[u16]>) -> Option<()> {
        match base {
            None => self.alone(part.start, values.get(part)?),
            Some(base) => self.difference(part, values, base),
        }
    }

    #[inline(never)]
    fn alone(&mut self, start: usize, values: &[u16]) -> Option<()> {
        let mut rest = values;
        loop {
            rest = rest.get(zeros(rest)..)?;
            if rest.is_empty() {
                return Some(());
            }
            let length = self.begin(start + values.len() - rest.len())?;
            let mut last = 0;
            let number = |value: &u16| {
                let value = i32::from(*value);
                (value != 0, value - replace(&mut last, value))
            };
            let told = self.run(rest.iter().take(RUN).map(number))?;
            *length = told as u8;
            self.told += told;
            rest = rest.get(told..)?;
        }
    }

    /// Begins a run; where its length is written when it is known: it has one byte.
    #[inline(always)]
    fn begin(&mut self, start: usize) -> Option<&'a mut u8> {
        let out = varint(take(&mut self.out), (start - self.told) as u32)?;
        let (length, rest) = out.split_first_mut()?;
        (self.out, self.told) = (rest, start);
        Some(length)
    }

    /// Writes the numbers of a run, up to two unchanged taxels; how many are told.
    #[inline(always)]
    fn run(&mut self, mut numbers: impl ExactSizeIterator<Item = (bool, i32)>) -> Option<usize> {
        let mut told = 0;
        let mut out = take(&mut self.out);
        while let Some((changed, number)) = numbers.next() {
            let later = if changed { None } else { numbers.next() };
            out = match later {
                None if changed => varint(out, zigzag(number))?,
                Some((true, later)) => varint(varint(out, zigzag(number))?, zigzag(later))?,
                _ => break,
            };
            told += 1 + usize::from(later.is_some());
        }
        self.out = out;
        Some(told)
    }

    /// Not inlined, as [`Encoder::alone`]: what they call needs the few registers of a Cortex-M0+.
    #[inline(never)]
    fn difference(&mut self, part: Range<usize>, values: &[u16], base: &[u16]) -> Option<()> {
        let base = base.get(..values.len())?;
        let mut out = take(&mut self.out);
        let (mut at, mut told) = (part.start.max(self.told), self.told);
        while at < part.end {
            let (now, last) = (values.get(at..)?, base.get(at..)?);
            let skip = at - told;
            if skip <= 127 - LANES
                && let (Some(stretch), Some(base)) = (now.first_chunk(), last.first_chunk())
                && let Some([first, length, room @ ..]) = out.first_chunk_mut::<{ ROOM + 2 }>()
            {
                let seen = tell(room, stretch, base, false);
                let (quiet, next) = (seen.quiet(), seen.next());
                if quiet < LANES {
                    *first = (skip + quiet) as u8;
                    *length = (next - quiet) as u8;
                    let used = seen.end - out.as_ptr().addr();
                    if next < LANES && now.get(next) == last.get(next) {
                        at += next;
                        told = at;
                        out = out.get_mut(used..)?;
                        continue;
                    }
                    let (length, begun) = out.get_mut(1..)?.split_first_mut()?;
                    let begun = begun.get_mut(used - 2..)?;
                    let count = next - quiet;
                    let more = rest(begun, now.get(next..)?, last.get(next..)?, RUN - count)?;
                    *length = (count + more.taxels) as u8;
                    out = more.out;
                    at += next + more.taxels;
                    told = at;
                    continue;
                }
                at += LANES;
                if at >= part.end {
                    break;
                }
            }
            at += same(values.get(at..part.end)?, base.get(at..part.end)?);
            if at == part.end {
                break;
            }
            let (now, last) = (values.get(at..)?, base.get(at..)?);
            let (length, place) = varint(out, (at - told) as u32)?.split_first_mut()?;
            let run = rest(place, now, last, RUN)?;
            *length = run.taxels as u8;
            out = run.out;
            at += run.taxels;
            told = at;
        }
        (self.out, self.told) = (out, told);
        Some(())
    }
}

/// Taxels of a run that are told, and the room behind them.
struct More<'a> {
    taxels: usize,
    out: &'a mut [u8],
}

/// Writes what is left of a run, at most so many taxels.
#[inline(never)]
fn rest<'a>(mut out: &'a mut [u8], now: &[u16], base: &[u16], most: usize) -> Option<More<'a>> {
    let base = base.get(..now.len())?;
    let mut taxels = 0;
    loop {
        let (ahead, base_ahead) = (now.get(taxels..)?, base.get(taxels..)?);
        let seen = go_on(out, ahead, base_ahead, most - taxels)?;
        taxels += seen.next();
        let used = seen.end - out.as_ptr().addr();
        out = out.get_mut(used..)?;
        if taxels == most {
            break;
        }
        if seen.next() < LANES {
            match (now.get(taxels), base.get(taxels)) {
                (Some(value), Some(base)) if value != base => {
                    out = varint(out, zigzag(i32::from(*value) - i32::from(*base)))?;
                    taxels += 1;
                }
                _ => break,
            }
        }
    }
    Some(More { taxels, out })
}

fn varint(mut out: &mut [u8], mut value: u32) -> Option<&mut [u8]> {
    while value > 127 {
        out = push(out, value as u8 | 128)?;
        value >>= 7;
    }
    push(out, value as u8)
}
