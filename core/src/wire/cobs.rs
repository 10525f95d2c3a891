//! COBS, encoded in place. A group is a code byte, which gives the distance to the next group, and bytes that
//! are not 0. Each 0 of the data becomes the code byte of the next group, and all other bytes stay. Only a
//! full group of 254 bytes needs an extra code byte behind it; then the bytes before it move.
//!
//! This module replaces the crate `cobs` (0.3): that one walks its buffers by plain indices, whose checks are
//! panics in the image unless the optimiser removes every one of them, and it takes a zero inside a frame for
//! the frame's end. The test below compares the two.

use bytemuck::pod_align_to;
use core::mem::replace;
use core::ops::Range;
use core::ptr;

/// Greatest number of data bytes of a group.
const GROUP: usize = 254;

/// Greatest number of extra code bytes for `data` bytes.
pub(super) const fn between(data: usize) -> usize {
    data / GROUP
}

/// Encodes the range `data` of `place` in place. It needs [`between`] bytes and one more before the data, and
/// one byte behind them for a 0x00. Returns the range of the code with its 0x00; `None` if there is no room.
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

/// Turns the first byte and all zeros but the last into code bytes. Error if a code byte would exceed its
/// range: the index of that byte. All before it is encoded.
#[inline(never)] // M0+: out of line
fn link(bytes: &mut [u8]) -> Result<(), usize> {
    let start = bytes.as_ptr().addr();
    let Some((first, data)) = bytes.split_first_mut() else { return Ok(()) };
    let mut group = CobsGroup { head: first };
    let (blocks, last) = data.as_chunks_mut::<BLOCK>();
    let linked = blocks.iter_mut().try_for_each(|block| group.end_in(block));
    linked.and_then(|()| group.end_in(last)).map_err(|Long| ptr::from_ref(group.head).addr() - start)
}

/// Bytes of an unrolled step: 5 cycles of an M0+ for each byte, and 10 more for a zero. In a longer step the
/// code for zeros is beyond the reach of a branch. Word by word, four bytes without a zero would take 15, but
/// those with one 50.
const BLOCK: usize = 8;

/// A group whose end is not found yet.
struct CobsGroup<'a> {
    head: &'a mut u8,
}

/// Error: the group is too long.
struct Long;

impl<'a> CobsGroup<'a> {
    /// Ends the group at each zero of the bytes that follow, and begins the next one there.
    #[inline(always)]
    fn end_in(&mut self, bytes: &'a mut [u8]) -> Result<(), Long> {
        for byte in bytes {
            if *byte == 0 {
                let code = ptr::from_ref(byte).addr() - ptr::from_ref(self.head).addr();
                if code > GROUP {
                    return Err(Long);
                }
                *replace(&mut self.head, byte) = code as u8;
            }
        }
        Ok(())
    }
}

/// True if a byte of the words is 0: such a byte borrows while its highest bit is not set.
#[inline(always)]
fn has_zero<const WORDS: usize>(words: &[u32; WORDS]) -> bool {
    const ONES: u32 = 0x0101_0101;
    words.iter().fold(0, |zeros, word| zeros | word.wrapping_sub(ONES) & !word) & ONES << 7 != 0
}

/// Encodes like [`stuff`], from the code byte at `head` on, where a full group may begin. The bytes before it
/// move to make room.
///
/// They move by the greatest number of extra code bytes. If fewer are needed, the rest moves too, and ends
/// earlier.
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

/// Number of full groups from the code byte at `head` to the zero at `next`. At the end of the data, a full
/// group has no code byte behind it.
const fn full(head: usize, next: usize, end: usize) -> usize {
    (next - head).saturating_sub(if next == end { 2 } else { 1 }) / GROUP
}

/// Index of the next zero, from `at` on.
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

/// Number of words before the first that holds a zero.
fn without_zero(words: &[u32]) -> usize {
    let far = 4 * words.as_chunks::<4>().0.iter().take_while(|words| !has_zero(words)).count();
    let near = words.get(far..).unwrap_or(&[]).as_chunks::<1>().0;
    far + near.iter().take_while(|word| !has_zero(word)).count()
}

/// Moves bytes towards the front, to `to`.
fn shift(place: &mut [u8], from: Range<usize>, to: usize) -> Option<()> {
    let by = from.start.checked_sub(to)?;
    let place = place.get_mut(to..from.end)?;
    if by <= place.len() {
        place.copy_within(by.., 0);
    }
    Some(())
}

/// Decodes COBS in place: each code byte becomes the 0 that it stands for, and all other bytes stay. Only the
/// code byte behind a full group stands for none; then the bytes before it move. Returns the data, or `None`
/// if `frame` is not COBS.
pub(super) fn unstuff(frame: &mut [u8]) -> Option<&[u8]> {
    if frame.contains(&0) {
        return None;
    }
    let (mut start, mut at, mut code) = (1, 0, *frame.first()?);
    loop {
        let next = at + usize::from(code);
        let is_full = code == u8::MAX;
        let Some(head) = frame.get_mut(next) else {
            return if next == frame.len() { frame.get(start..) } else { None };
        };
        (at, code) = (next, replace(head, 0));
        if is_full {
            let place = frame.get_mut(start..=next)?;
            place.copy_within(..place.len().checked_sub(1)?, 1);
            start += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec;
    use std::vec::Vec;

    /// Lengths around the group of 254, with zeros in every place that matters, among random bytes and among
    /// 0x80, for which a borrow would look like a zero; and many zeros behind a full group.
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
                assert_eq!(unstuff(frame), Some(&data[..]));
            }
        }
    }

    #[test]
    fn what_is_not_cobs_is_refused() {
        for frame in [&mut [0][..], &mut [2], &mut [3, 1], &mut [3, 1, 0], &mut [1, 0, 1], &mut [255; 254]] {
            assert_eq!(unstuff(frame), None);
        }
        // Other encoders append an empty group to a full one; the meaning is the same.
        let mut frame = [255; 256];
        frame[255] = 1;
        assert_eq!(unstuff(&mut frame), Some(&[255; 254][..]));
    }
}
