//! Writes the code of an image; the [module of its reader](super::image) says what it is.
//!
//! Runs with one unchanged taxel between them are joined: a new run costs at least 2 bytes, an unchanged
//! taxel within one costs 1 (alone: 2 for the first after a value above 63). 2 would cost as much, 0 costs 6 % more on a
//! pressed image that does not move.
//!
//! Quiet taxels are looked at 8 at a time: 30 cycles of an M0+ for 8 of them, 58 with a base, counted in its instructions.
//! One that has changed takes 31 for its difference.

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

/// How many taxels from the first on are unchanged: these are the loops that see all quiet taxels.
fn quiet(values: &[u16], base: Option<&[u16]>) -> usize {
    match base {
        None => {
            let whole = values.as_chunks::<8>().0.iter().take_while(|block| zero(block)).count() * 8;
            whole + values.iter().skip(whole).take_while(|value| **value == 0).count()
        }
        // Behind a run nearly always.
        Some(base) if values.first() != base.first() => 0,
        Some(base) => unchanged(values, base),
    }
}

/// Written out, because a compiler that optimises for size keeps a loop.
fn zero([a, b, c, d, e, f, g, h]: &[u16; 8]) -> bool {
    a | b | c | d | e | f | g | h == 0
}

/// As [`quiet`]: taxel by taxel, for behind a run it is a few at most, and where there are more of them two by two.
#[inline(never)]
fn unchanged(values: &[u16], base: &[u16]) -> usize {
    const FEW: usize = 16;
    let near = values.get(..FEW).unwrap_or(values);
    let few = near.iter().zip(base).take_while(|(value, base)| value == base).count();
    let (Some(values), Some(base), FEW) = (values.get(FEW..), base.get(FEW..), few) else { return few };
    let ((odd, words, _), (base_odd, base_words, _)) = (pod_align_to(values), pod_align_to(base));
    let mut many = 0;
    if odd.first() == base_odd.first() {
        let pairs = words.as_chunks::<4>().0.iter().zip(base_words.as_chunks::<4>().0);
        many = odd.len() + 8 * pairs.take_while(|(words, base)| equal(words, base)).count();
    }
    let (values, base) = (values.get(many..).unwrap_or(&[]), base.get(many..).unwrap_or(&[]));
    few + many + values.iter().zip(base).take_while(|(value, base)| value == base).count()
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
        let mut seen = 0;
        loop {
            let skip = quiet(values.get(seen..)?, after(base, seen)?);
            seen += skip;
            let rest = values.get(seen..)?;
            if rest.is_empty() {
                return Some(());
            }
            self.varint((start + seen - self.told) as u32)?;
            // Written when it is known: it has one byte.
            let length = self.out.next()?;
            let most = rest.get(..RUN).unwrap_or(rest);
            let (told, unchanged) = match after(base, seen)? {
                None => self.alone(most)?,
                Some(base) => self.differences(most, base)?,
            };
            *length = told as u8;
            self.told = start + seen + told;
            seen += told + unchanged;
        }
    }

    /// Writes a run that stands alone; how many taxels it has, and how many unchanged ones were seen behind it. Not inlined, as
    /// [`Encoder::differences`]: the loop within needs the few registers of a Cortex-M0+.
    #[inline(never)]
    fn alone(&mut self, values: &[u16]) -> Option<(usize, usize)> {
        let mut last = 0;
        self.run(values.iter().map(|value| {
            let value = i32::from(*value);
            (value != 0, value - replace(&mut last, value))
        }))
    }

    /// Writes a run of differences, as [`Encoder::alone`].
    #[inline(never)]
    fn differences(&mut self, values: &[u16], base: &[u16]) -> Option<(usize, usize)> {
        let difference = |(value, base): (&u16, &u16)| i32::from(*value) - i32::from(*base);
        self.run(values.iter().zip(base).map(difference).map(|number| (number != 0, number)))
    }

    /// Writes the numbers of the taxels up to two unchanged ones; how many there are, and how many of these.
    #[inline(always)]
    fn run(&mut self, mut taxels: impl ExactSizeIterator<Item = (bool, i32)>) -> Option<(usize, usize)> {
        // In registers: few of them are left for what is behind a pointer.
        let mut out = take(&mut self.out);
        let (all, mut unchanged) = (taxels.len(), 0);
        while let Some((changed, mut number)) = taxels.next() {
            if !changed {
                let next = taxels.next();
                let Some((true, later)) = next else {
                    unchanged = 1 + usize::from(next.is_some());
                    break;
                };
                varint(&mut out, zigzag(number))?;
                number = later;
            }
            varint(&mut out, zigzag(number))?;
        }
        self.out = out;
        Some((all - taxels.len() - unchanged, unchanged))
    }

    fn varint(&mut self, value: u32) -> Option<()> {
        varint(&mut self.out, value)
    }
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

/// The base from a taxel on; `None` if it ends before, which it does not.
fn after(base: Option<&[u16]>, taxels: usize) -> Option<Option<&[u16]>> {
    match base {
        None => Some(None),
        Some(base) => base.get(taxels..).map(Some),
    }
}
