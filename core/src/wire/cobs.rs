//! COBS: a group is a code byte, which tells where the next group begins, and bytes that are not 0; a 0 of
//! the data is where the next one begins.
//!
//! It is coded where the data are: a 0 becomes a code byte, and what is not 0 stays. Only a full group of 254
//! bytes, behind which a code byte comes in between, moves what stands before it.
//!
//! COBS is coded here and not by the crate `cobs` (0.3): that one walks its buffers by plain indices, whose
//! checks are panics in the image unless the optimiser proves every one of them away, and it takes a zero
//! inside a frame for the frame's end. The test below compares the two.

use bytemuck::pod_align_to;
use core::mem::replace;
use core::ops::Range;
use core::ptr;

/// Most bytes of a group.
const GROUP: usize = 254;

/// Most code bytes that come in between some data.
pub(super) const fn between(data: usize) -> usize {
    data / GROUP
}

/// Codes what stands in `data` there, with [`between`] bytes and one before, and one behind, which gets a
/// 0x00. Where the code stands, with its 0x00; `None` if there is no room.
///
/// Data that end with a full group end with it: no empty group follows.
pub(super) fn stuff(place: &mut [u8], data: Range<usize>) -> Option<Range<usize>> {
    *place.get_mut(data.end)? = 0;
    let first = data.start.checked_sub(1)?;
    match link(place.get_mut(first..=data.end)?) {
        Err(long) => apart(place, first..data.end, first + long),
        Ok(()) => Some(first..data.end + 1),
    }
}

/// Makes code bytes of the first of some bytes and of all zeros but the last. An error: where a code byte
/// would have to tell more than it can; what is before it is coded.
#[inline(never)] // M0+: out of line
fn link(bytes: &mut [u8]) -> Result<(), usize> {
    let start = bytes.as_ptr().addr();
    let Some((first, data)) = bytes.split_first_mut() else { return Ok(()) };
    let mut group = Group { head: first, code: 1 };
    let (blocks, last) = data.as_chunks_mut::<BLOCK>();
    let linked = blocks.iter_mut().try_for_each(|block| group.end_in(block));
    linked.and_then(|()| group.end_in(last)).map_err(|Long| ptr::from_ref(group.head).addr() - start)
}

/// Bytes that are looked at in a turn, each by code of its own: 5 cycles of an M0+ for each, and 10 more for
/// a zero. By words four bytes without a zero would take 15, but those with one 50.
const BLOCK: usize = 16;

/// A group that has not ended.
struct Group<'a> {
    head: &'a mut u8,
    /// Its code byte if the first byte of the block is a zero. Within a block in which it began this is that
    /// much less, modulo 2^32.
    code: u32,
}

/// The group is too long.
struct Long;

impl<'a> Group<'a> {
    /// Ends at each zero of some bytes that follow; the next group begins there.
    #[inline(always)]
    fn end_in(&mut self, bytes: &'a mut [u8]) -> Result<(), Long> {
        let count = bytes.len() as u32;
        for (byte, passed) in bytes.iter_mut().zip(0..) {
            if *byte == 0 {
                let code = self.code.wrapping_add(passed);
                if code > GROUP as u32 {
                    return Err(Long);
                }
                *replace(&mut self.head, byte) = code as u8;
                self.code = 0u32.wrapping_sub(passed);
            }
        }
        self.code = self.code.wrapping_add(count);
        Ok(())
    }
}

/// Whether one of the bytes of some words is 0: it borrows and its highest bit is not set.
#[inline(always)]
fn has_zero<const WORDS: usize>(words: &[u32; WORDS]) -> bool {
    const ONES: u32 = 0x0101_0101;
    words.iter().fold(0, |zeros, word| zeros | word.wrapping_sub(ONES) & !word) & ONES << 7 != 0
}

/// As [`stuff`] from the code byte at `head` on, where a full group may begin; what stands before it moves
/// out of its way.
///
/// It moves by as much as could come in between. Where that is not all needed, what follows moves too, and
/// ends earlier.
#[inline(never)]
fn apart(place: &mut [u8], data: Range<usize>, head: usize) -> Option<Range<usize>> {
    let most = between(data.end - head - 1);
    let first = data.start.checked_sub(most)?;
    shift(place, data.start..head, first)?;
    let (mut head, mut from) = (head - most, head + 1);
    while from <= data.end {
        if head + 1 == from {
            // No full group is left.
            link(place.get_mut(head..=data.end)?).ok()?;
            return Some(first..data.end + 1);
        }
        let next = zero(place, from)?;
        for _ in 0..full(from - 1, next, data.end) {
            *place.get_mut(head)? = 255;
            shift(place, from..from + GROUP, head + 1)?;
            (head, from) = (head + 1 + GROUP, from + GROUP);
        }
        let rest = next - from;
        *place.get_mut(head)? = rest as u8 + 1;
        shift(place, from..next, head + 1)?;
        (head, from) = (head + 1 + rest, next + 1);
    }
    *place.get_mut(head)? = 0;
    Some(first..head + 1)
}

/// Code bytes that come in between those from `head` to the zero at `next`; at the end a full group has none
/// behind it.
const fn full(head: usize, next: usize, end: usize) -> usize {
    (next - head).saturating_sub(if next == end { 2 } else { 1 }) / GROUP
}

/// Where the next zero is, from `at` on.
fn zero(place: &[u8], at: usize) -> Option<usize> {
    let bytes = place.get(at..)?;
    let (first, words, _) = pod_align_to(bytes);
    let is_zero = |byte: &u8| *byte == 0;
    let passed = match first.iter().position(is_zero) {
        Some(behind) => behind,
        None => first.len() + 4 * without_zero(words),
    };
    bytes.get(passed..)?.iter().position(is_zero).map(|behind| at + passed + behind)
}

/// How many words from the first on hold no zero.
fn without_zero(words: &[u32]) -> usize {
    let far = 4 * words.as_chunks::<4>().0.iter().take_while(|words| !has_zero(words)).count();
    let near = words.get(far..).unwrap_or(&[]).as_chunks::<1>().0;
    far + near.iter().take_while(|word| !has_zero(word)).count()
}

/// Moves some bytes to the front.
fn shift(place: &mut [u8], from: Range<usize>, to: usize) -> Option<()> {
    let by = from.start.checked_sub(to)?;
    let place = place.get_mut(to..from.end)?;
    if by <= place.len() {
        place.copy_within(by.., 0);
    }
    Some(())
}

/// Undoes COBS in place; the length of the data, or `None` if `frame` is not COBS.
pub(super) fn unstuff(frame: &mut [u8]) -> Option<usize> {
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
    use std::vec;
    use std::vec::Vec;

    /// Lengths around the group of 254, with zeros in every place that matters, among bytes of all sorts and
    /// among 0x80, of which a borrow would make what a zero leaves; and many zeros behind a full group.
    fn data() -> impl Iterator<Item = Vec<u8>> {
        let lengths = [1, 2, 5, 252, 253, 254, 255, 256, 507, 508, 509, 510, 762, 763, 1200];
        let zeros = [usize::MAX, 0, 1, 7, 252, 253, 254, 255, 507, 508, 509, 762];
        let fills: [fn(usize) -> u8; 2] = [|i| i as u8 | 1, |_| 0x80];
        let few = fills.into_iter().flat_map(move |fill| {
            lengths.into_iter().flat_map(move |length| {
                zeros.into_iter().map(move |zero| {
                    let byte = |i| if i == zero || i + 1 == length && zero == 1 { 0 } else { fill(i) };
                    (0..length).map(byte).collect()
                })
            })
        });
        let many = (400..=1200)
            .step_by(50)
            .map(|length| (0..length).map(|i| if i > 400 && i % 9 == 0 { 0 } else { i as u8 | 1 }).collect());
        few.chain(many)
    }

    #[test]
    fn cobs_is_that_of_the_crate_cobs() {
        for data in data() {
            let mut theirs = [0; 1300];
            let length = cobs::try_encode(&data, &mut theirs).unwrap();
            for free in 0..4 {
                let start = 1 + between(data.len()) + free;
                let mut mine = vec![0xaa; start];
                mine.extend(&data);
                let end = mine.len();
                assert_eq!(stuff(&mut mine, start..end), None);
                mine.push(0xaa);
                let range = stuff(&mut mine, start..end).unwrap();
                let (end, frame) = mine[range].split_last_mut().unwrap();
                assert!(*end == 0 && !frame.contains(&0));
                assert_eq!(frame, &theirs[..length]);
                assert_eq!(unstuff(frame), Some(data.len()));
                assert_eq!(frame[..data.len()], data);
            }
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
