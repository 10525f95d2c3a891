//! Writes the code of an image; the [module of its reader](super::image) says what it is.
//!
//! Runs with one unchanged taxel between them are joined: a new run costs at least 2 bytes, an unchanged
//! taxel within one costs 1 (alone: 2 for the first after a value above 63). 2 would cost as much, 0 costs 6 % more on a
//! pressed image that does not move.
//!
//! Quiet taxels are looked at 8 at a time: 30 cycles of an M0+ for 8 of them, 41 with a base, counted in its instructions; the
//! first 16 behind a run one by one with 15 each. One that has changed takes 31 for its difference, and a run 130.

use bytemuck::pod_align_to;
use core::mem::{replace, take};
use core::slice;

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
    encoder.part(0, values, base)?;
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

/// How many taxels from the first on are those of the base: these are the loops that see all quiet taxels of a difference.
#[inline(always)]
fn same(values: &[u16], base: &[u16]) -> usize {
    /// Behind a run it is a few nearly always.
    const FEW: usize = 16;
    let mut at = 0;
    while let (Some(values), Some(base)) = (values.get(at..), base.get(at..)) {
        let near = values.get(..FEW).unwrap_or(values);
        let few = near.iter().zip(base).take_while(|(value, base)| value == base).count();
        at += few;
        if few < FEW {
            break;
        }
        at += same_blocks(values.get(FEW..).unwrap_or(&[]), base.get(FEW..).unwrap_or(&[]));
    }
    at
}

/// As [`same`], two by two where both stand alike in memory, and as many as stand in whole blocks.
#[inline(never)]
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
    out: slice::IterMut<'a, u8>,
    /// First taxel that is not told yet.
    told: usize,
}

impl<'a> Encoder<'a> {
    pub fn new(out: &'a mut [u8]) -> Self {
        Encoder { out: out.iter_mut(), told: 0 }
    }

    /// Bytes that are left.
    pub fn room(&self) -> usize {
        self.out.len()
    }

    /// Codes the taxels from number `start` on. `None`: no room.
    pub fn part(&mut self, start: usize, values: &[u16], base: Option<&[u16]>) -> Option<()> {
        match base {
            None => self.alone(start, values),
            Some(base) => self.difference(start, values, base),
        }
    }

    /// Not inlined, as [`Encoder::difference`]: the loops within need the few registers of a Cortex-M0+.
    #[inline(never)]
    fn alone(&mut self, start: usize, values: &[u16]) -> Option<()> {
        let from = |taxel: usize| values.get(taxel..).unwrap_or(&[]);
        let quiet = |taxel| zeros(from(taxel));
        self.runs(start, values.len(), quiet, |taxel| {
            let mut last = 0;
            let values = from(taxel);
            values.get(..RUN).unwrap_or(values).iter().map(move |value| {
                let value = i32::from(*value);
                (value != 0, value - replace(&mut last, value))
            })
        })
    }

    #[inline(never)]
    fn difference(&mut self, start: usize, values: &[u16], base: &[u16]) -> Option<()> {
        let base = base.get(..values.len())?;
        let from = |taxel: usize| (values.get(taxel..).unwrap_or(&[]), base.get(taxel..).unwrap_or(&[]));
        let quiet = |taxel| {
            let (values, base) = from(taxel);
            same(values, base)
        };
        self.runs(start, values.len(), quiet, |taxel| {
            let (values, base) = from(taxel);
            let values = values.get(..RUN).unwrap_or(values);
            let difference = |(value, base): (&u16, &u16)| i32::from(*value) - i32::from(*base);
            values.iter().zip(base).map(difference).map(|number| (number != 0, number))
        })
    }

    /// Writes the runs of some taxels: from one of them on so many are `quiet`, and each of the next has one of the `numbers`, if it has
    /// changed.
    #[inline(always)]
    fn runs<Numbers: ExactSizeIterator<Item = (bool, i32)>>(
        &mut self,
        start: usize,
        taxels: usize,
        quiet: impl Fn(usize) -> usize,
        numbers: impl Fn(usize) -> Numbers,
    ) -> Option<()> {
        // In registers: few of them are left for what is behind a pointer.
        let (mut out, mut told) = (take(&mut self.out), self.told);
        let mut seen = 0;
        loop {
            seen += quiet(seen);
            if seen >= taxels {
                break;
            }
            varint(&mut out, (start + seen - told) as u32)?;
            // Written when it is known: it has one byte.
            let length = out.next()?;
            let mut numbers = numbers(seen);
            let (all, unchanged) = (numbers.len(), run(&mut out, &mut numbers)?);
            let passed = all - numbers.len();
            *length = (passed - unchanged) as u8;
            seen += passed;
            told = start + seen - unchanged;
        }
        (self.out, self.told) = (out, told);
        Some(())
    }
}

/// Writes the numbers of a run, up to two unchanged taxels; how many of these were seen.
#[inline(always)]
fn run(out: &mut slice::IterMut<'_, u8>, numbers: &mut impl Iterator<Item = (bool, i32)>) -> Option<usize> {
    while let Some((changed, mut number)) = numbers.next() {
        if !changed {
            let next = numbers.next();
            let Some((true, later)) = next else {
                return Some(1 + usize::from(next.is_some()));
            };
            varint(out, zigzag(number))?;
            number = later;
        }
        varint(out, zigzag(number))?;
    }
    Some(0)
}

const fn zigzag(number: i32) -> u32 {
    (number << 1 ^ number >> 31) as u32
}

#[inline]
fn varint(out: &mut slice::IterMut<'_, u8>, mut value: u32) -> Option<()> {
    while value > 127 {
        *out.next()? = value as u8 | 128;
        value >>= 7;
    }
    *out.next()? = value as u8;
    Some(())
}
