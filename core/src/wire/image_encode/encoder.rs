//! Encodes images; the [decoder's module](crate::wire::image_decode) describes the code.
//!
//! Runs with one unchanged taxel between them are joined: a new run costs at least 2 bytes, an unchanged
//! taxel within one costs 1 (alone: 2 for the first after a value above 63). Joining over 2 taxels would cost
//! the same, joining over none costs 6 % more on a pressed image that does not move.
//!
//! Unchanged taxels far from a run are compared 8 at a time: 30 cycles of an M0+ for 8 of them, 41 with a
//! base, counted in its instructions. Taxels near a run are encoded by [stretches](super::stretch), with
//! about 80 cycles for each stretch.

use super::stretch::{LANES, ROOM, StretchEnd, Taxels, encode, encode_by_call, go_on, push, zigzag};
use crate::wire::image_decode::RUN;
use bytemuck::pod_align_to;
use core::mem::take;
use core::ops::Range;

/// Greatest varint of an image, plus one: 3 bytes hold 21 bits.
const LIMIT: usize = 1 << 21;

/// Encodes `values` into `out` and returns the length. `None` if there is no room, if the base has another
/// length, or for 2^21 taxels or more.
pub fn encode_image(values: &[u16], base: Option<&[u16]>, out: &mut [u8]) -> Option<usize> {
    if values.len() >= LIMIT || base.is_some_and(|base| base.len() != values.len()) {
        return None;
    }
    let room = out.len();
    let mut encoder = Encoder::new(out);
    encoder.part(0..values.len(), values, base)?;
    Some(room - encoder.room())
}

/// Returns the taxels from the first that is not 0. This loop reads all unchanged taxels of an image without a
/// base.
fn behind_zeros(mut values: &[u16]) -> &[u16] {
    // Often a run begins right behind the two taxels that end the last one.
    if let [0, 0, rest @ ..] = values
        && rest.first() != Some(&0)
    {
        return rest;
    }
    while let Some((block, rest)) = values.split_first_chunk()
        && zero(block)
    {
        values = rest;
    }
    while let [0, rest @ ..] = values {
        values = rest;
    }
    values
}

/// Unrolled by hand, because a compiler that optimises for size keeps a loop.
fn zero([a, b, c, d, e, f, g, h]: &[u16; 8]) -> bool {
    a | b | c | d | e | f | g | h == 0
}

/// Returns the number of taxels before the first that differs from the base. This loop reads most unchanged
/// taxels of a difference.
#[inline(never)]
fn same(values: &[u16], base: &[u16]) -> usize {
    let far = same_blocks(values, base);
    let (near, base) = (values.get(far..).unwrap_or(&[]), base.get(far..).unwrap_or(&[]));
    far + near.iter().zip(base).take_while(|(value, base)| value == base).count()
}

/// Compares like [`same`], word by word if both are aligned alike, and only in whole blocks.
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

/// Encodes an image part by part, in the order of the taxels. Taxels between two parts keep the reference.
pub(super) struct Encoder<'a> {
    out: &'a mut [u8],
    /// First taxel that is not encoded yet.
    encoded: usize,
}

impl<'a> Encoder<'a> {
    pub fn new(out: &'a mut [u8]) -> Self {
        Encoder { out, encoded: 0 }
    }

    /// Number of bytes left.
    pub fn room(&self) -> usize {
        self.out.len()
    }

    /// Encodes a part of the taxels. `values` and the base may extend beyond it: at least two taxels keep the
    /// reference there, and a run that begins behind those is encoded here or with the next part. `None` if
    /// there is no room.
    #[inline(always)] // so that its arguments need no place on the stack
    pub fn part(&mut self, part: Range<usize>, values: &[u16], base: Option<&[u16]>) -> Option<()> {
        match base {
            None => self.alone(part.start, values.get(part)?),
            Some(base) => self.difference(part, values, base),
        }
    }

    #[inline(never)]
    fn alone(&mut self, start: usize, values: &[u16]) -> Option<()> {
        let (mut out, mut encoded, mut now) = (take(&mut self.out), self.encoded, values);
        loop {
            now = behind_zeros(now);
            let Some((first, more)) = now.split_first() else { break };
            let at = start + values.len() - now.len();
            let (length, begun) = varint(out, (at - encoded) as u32)?.split_first_mut()?;
            let run = rest::<true>(varint(begun, zigzag((*first).into()))?, more, now, RUN - 1)?;
            *length = 1 + run.taxels as u8;
            now = more.get(run.taxels..)?;
            (out, encoded) = (run.out, at + 1 + run.taxels);
        }
        (self.out, self.encoded) = (out, encoded);
        Some(())
    }

    /// Begins a run. Returns the place of its length, one byte, which is filled in when the run ends.
    #[inline(always)]
    fn begin(&mut self, start: usize) -> Option<&'a mut u8> {
        let out = varint(take(&mut self.out), (start - self.encoded) as u32)?;
        let (length, rest) = out.split_first_mut()?;
        (self.out, self.encoded) = (rest, start);
        Some(length)
    }

    fn difference(&mut self, part: Range<usize>, values: &[u16], base: &[u16]) -> Option<()> {
        let base = base.get(..values.len())?;
        let mut at = part.start.max(self.encoded);
        loop {
            at = self.stretches(at..part.end, values, base)?;
            if at >= part.end {
                return Some(());
            }
            let unchanged = same(values.get(at..part.end)?, base.get(at..part.end)?);
            at += unchanged;
            if unchanged == 0 {
                let length = self.begin(at)?;
                let run = rest::<false>(take(&mut self.out), values.get(at..)?, base.get(at..)?, RUN)?;
                *length = run.taxels as u8;
                (self.out, self.encoded) = (run.out, at + run.taxels);
                at = self.encoded;
            }
        }
    }

    /// Encodes taxels by stretches, as long as these are close together. Returns the first taxel that was not
    /// read.
    #[inline(never)] // M0+: out of line
    fn stretches(&mut self, taxels: Range<usize>, values: &[u16], base: &[u16]) -> Option<usize> {
        let base = base.get(..values.len())?;
        let mut out = take(&mut self.out);
        let (mut at, mut skip) = (taxels.start, taxels.start - self.encoded);
        while at < taxels.end {
            // One by one: a compiler turns joined conditions into numbers first.
            let (now, last) = (values.get(at..)?, base.get(at..)?);
            let Some(now) = now.first_chunk() else { break };
            let Some(last) = last.first_chunk() else { break };
            let Some(place) = out.first_chunk_mut() else { break };
            let seen = match skip {
                0..NEAR => begin_near(place, skip, now, last),
                128..FAR => begin_far(place, skip, now, last),
                _ => break,
            };
            if seen.unchanged() == LANES {
                (at, skip) = (at + LANES, skip + LANES);
                break;
            }
            let used = seen.end - out.as_ptr().addr();
            at += seen.next();
            if seen.ends() {
                // The two that end the run need no second comparison.
                (at, skip) = (at + 2, 2);
                out = out.get_mut(used..)?;
            } else {
                let (head, begun) = out.split_at_mut_checked(used)?;
                let length = head.get_mut(if skip < NEAR { 1 } else { 2 })?;
                let most = RUN - usize::from(*length);
                let more = rest::<false>(begun, values.get(at..)?, base.get(at..)?, most)?;
                *length += more.taxels as u8;
                out = more.out;
                (at, skip) = (at + more.taxels, 0);
            }
        }
        (self.out, self.encoded) = (out, at - skip);
        Some(at)
    }
}

/// Number of unchanged taxels up to which the distance of the next run surely fits in one byte.
const NEAR: usize = 128 - LANES;
/// From 128 on, number of unchanged taxels up to which it surely fits in two bytes.
const FAR: usize = (1 << 14) - LANES;

/// Room for a stretch and the head of its run.
type RunBuffer = [u8; 3 + ROOM];

/// Encodes a stretch and the head of its run, behind `skip` unchanged taxels. Without a run the bytes have no
/// meaning.
#[inline(always)]
fn begin_near(place: &mut RunBuffer, skip: usize, now: &Taxels, base: &Taxels) -> StretchEnd {
    let [first, length, room @ .., _] = place;
    let seen = encode(room, now, base);
    *first = (skip + seen.unchanged()) as u8;
    *length = (seen.next() - seen.unchanged()) as u8;
    seen
}

/// Encodes like [`begin_near`], behind more taxels.
#[inline(never)] // rarely called
fn begin_far(place: &mut RunBuffer, skip: usize, now: &Taxels, base: &Taxels) -> StretchEnd {
    let [first, second, length, room @ ..] = place;
    let seen = encode_by_call(room, now, base);
    let skip = skip + seen.unchanged();
    (*first, *second) = (skip as u8 | 128, (skip >> 7) as u8);
    *length = (seen.next() - seen.unchanged()) as u8;
    seen
}

/// Number of encoded taxels of a run, and the room that is left.
struct RunRest<'a> {
    taxels: usize,
    out: &'a mut [u8],
}

/// Encodes the rest of a run, at most `most` taxels. `ALONE` stands for an image without a base; `base` then
/// begins with the taxel before.
#[inline(never)]
fn rest<'a, const ALONE: bool>(
    mut out: &'a mut [u8],
    now: &[u16],
    base: &[u16],
    most: usize,
) -> Option<RunRest<'a>> {
    let base = base.get(..now.len())?;
    let mut taxels = 0;
    loop {
        let (ahead, base_ahead) = (now.get(taxels..)?, base.get(taxels..)?);
        let seen = go_on::<ALONE>(out, ahead, base_ahead, most - taxels)?;
        taxels += seen.next();
        let used = seen.end - out.as_ptr().addr();
        out = out.get_mut(used..)?;
        if taxels == most {
            break;
        }
        if seen.ends() {
            break;
        }
        // A difference of three bytes, which a stretch does not encode.
        if seen.next() < LANES {
            let (value, last) = (now.get(taxels)?, base.get(taxels)?);
            out = varint(out, zigzag(i32::from(*value) - i32::from(*last)))?;
            taxels += 1;
        }
    }
    Some(RunRest { taxels, out })
}

fn varint(mut out: &mut [u8], mut value: u32) -> Option<&mut [u8]> {
    while value > 127 {
        out = push(out, value as u8 | 128)?;
        value >>= 7;
    }
    push(out, value as u8)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::wire::decode_image;
    use std::vec;
    use std::vec::Vec;

    /// Number of taxels that each run of a code skips, and number that it contains.
    fn runs(code: &[u8]) -> Vec<(usize, usize)> {
        let mut bytes = code.iter();
        let number = |bytes: &mut core::slice::Iter<u8>| {
            let ends = bytes.as_slice().iter().position(|byte| *byte < 128).unwrap();
            let number =
                (0..=ends).fold(0, |number, i| number | (bytes.as_slice()[i] as usize & 127) << (7 * i));
            *bytes = bytes.as_slice()[ends + 1..].iter();
            number
        };
        let mut runs = Vec::new();
        while !bytes.as_slice().is_empty() {
            let run = (number(&mut bytes), number(&mut bytes));
            (0..run.1).for_each(|_| assert_ne!(number(&mut bytes), usize::MAX));
            runs.push(run);
        }
        runs
    }

    #[test]
    fn runs_of_any_length_follow_each_other_at_any_distance() {
        let skips = [
            2, 3, 23, 24, 25, 101, 103, 104, 105, 126, 127, 128, 129, 151, 152, 16_358, 16_361, 16_383,
            16_384,
        ];
        for skip in skips {
            for count in [1, 2, 22, 24, 25, 48, 126, 127] {
                for behind in [0, 1, 30] {
                    let start = 3 + 5 + skip;
                    let base: Vec<u16> = (0..start + count + behind).map(|i| i as u16 & 7).collect();
                    let mut now = base.clone();
                    let encoded = (3..8).chain(start..start + count);
                    encoded.for_each(|i| now[i] += if i % 3 == 0 { 1000 } else { 1 });
                    let mut code = vec![0; now.len() * 3 + 9];
                    let length = encode_image(&now, Some(&base), &mut code).unwrap();
                    assert_eq!(runs(&code[..length]), [(3, 5), (skip, count)]);
                    let mut back = vec![0; now.len()];
                    decode_image(&code[..length], Some(&base), &mut back).unwrap();
                    assert!(back == now, "{skip} {count} {behind}");
                }
            }
        }
    }

    #[test]
    fn images_too_long_or_of_another_length_than_the_base_are_refused() {
        let (values, mut out) = (vec![0; LIMIT], [0; 16]);
        let length = |taxels: usize, base: Option<usize>, out: &mut [u8]| {
            encode_image(&values[..taxels], base.map(|base| &values[..base]), out)
        };
        assert_eq!((LIMIT, length(LIMIT, None, &mut out)), (2_097_152, None));
        assert_eq!(length(LIMIT - 1, None, &mut out), Some(0));
        assert_eq!(length(LIMIT - 1, Some(LIMIT - 1), &mut out), Some(0));
        assert_eq!([8, 10].map(|base| length(9, Some(base), &mut out)), [None; 2]);
    }

    /// The code by its definition, taxel by taxel; what is behind the image or the longest run is unchanged.
    fn plain(values: &[u16], base: Option<&[u16]>) -> Vec<u8> {
        let same = |i: usize| values.get(i).is_none_or(|value| *value == base.map_or(0, |base| base[i]));
        let mut code = Vec::new();
        let mut number = |mut number: usize| {
            while number > 127 {
                code.push(number as u8 | 128);
                number >>= 7;
            }
            code.push(number as u8);
        };
        let mut encoded = 0;
        while let Some(start) = (encoded..values.len()).find(|i| !same(*i)) {
            let last = start + RUN;
            let end = (start..last).find(|i| same(*i) && (i + 1 == last || same(i + 1))).unwrap_or(last);
            number(start - encoded);
            number(end - start);
            for i in start..end {
                let before = base.map_or(if i == start { 0 } else { values[i - 1] }, |base| base[i]);
                let difference = i32::from(values[i]) - i32::from(before);
                number(if difference < 0 { -2 * difference - 1 } else { 2 * difference } as usize);
            }
            encoded = end;
        }
        code
    }

    #[test]
    fn it_is_the_plain_code_of_any_image() {
        let mut rng = fastrand::Rng::with_seed(11);
        for round in 0..3000 {
            let (changed, far) = ([2, 20, 60, 95, 99][rng.usize(..5)], [0, 1, 10, 100][rng.usize(..4)]);
            let base: Vec<u16> = (0..rng.usize(..700)).map(|_| rng.u16(..)).collect();
            let mut change = |value: u16| match rng.usize(..100) {
                of if of >= changed => value,
                _ if rng.usize(..100) < far => value ^ rng.u16(0x2000..),
                _ => value ^ rng.u16(..100),
            };
            let now: Vec<u16> = base.iter().map(|value| change(*value)).collect();
            let alone: Vec<u16> = base.iter().map(|_| change(0)).collect();
            for (values, base) in [(&now, Some(&base[..])), (&alone, None)] {
                let plain = plain(values, base);
                let mut code = vec![0; plain.len()];
                let room = encode_image(values, base, &mut code);
                assert!(room == Some(plain.len()) && code == plain, "round {round}, {changed} %");
                if let Some(less) = plain.len().checked_sub(1) {
                    assert_eq!(encode_image(values, base, &mut code[..less]), None, "round {round}");
                }
            }
        }
    }
}
