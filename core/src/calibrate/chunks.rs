//! Codes to pressure in chunks of sixteen taxels, for those beyond their limits only.

use super::marks::Marks;
use super::panel::PanelCodes;
use super::scale::scale;
use crate::format::Code;
use crate::image::row16::ROW16;
use bytemuck::{Pod, try_cast_slice};

/// Taxels that are compared together.
const CHUNK: usize = ROW16;
/// Taxels of a chunk that are calibrated together.
const PART: usize = 8;
/// Chunks whose masks are kept until they are marked.
const KEPT: usize = 8;

impl PanelCodes<'_> {
    /// Calibrates with any number of columns and codes.
    pub fn calibrate_chunks<const FALLING: bool>(
        &mut self,
        marks: &mut Marks<'_>,
        unity: Option<u16>,
    ) -> bool {
        let whole = self.codes.len() / CHUNK * CHUNK;
        let any = self.chunks::<CHUNK, PART, FALLING>(0, marks, unity);
        whole < self.codes.len() && self.chunks::<1, 1, FALLING>(whole, marks, unity) || any
    }

    /// Calibrates all whole chunks of N taxels from `first` on: skips inactive chunks, then calibrates up to
    /// the next inactive one, and so on.
    fn chunks<const N: usize, const PART: usize, const FALLING: bool>(
        &mut self,
        first: usize,
        marks: &mut Marks<'_>,
        unity: Option<u16>,
    ) -> bool {
        let (codes, _) = self.codes.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (limit, _) = self.limit.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (rest, _) = self.rest.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (gain, _) = self.gain.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (out, _) = self.out.get_mut(first..).unwrap_or(&mut []).as_chunks_mut::<N>();
        let mut any = false;
        let mut at = 0;
        while let (Some(codes), Some(limit)) = (codes.get(at..), limit.get(at..)) {
            let skipped = inactive::<N, FALLING>(codes, limit);
            at += skipped;
            let (Some(codes), Some(limit)) = (codes.get(skipped..), limit.get(skipped..)) else { break };
            let (Some(rest), Some(gain), Some(out)) = (rest.get(at..), gain.get(at..), out.get_mut(at..))
            else {
                break;
            };
            if codes.is_empty() {
                break;
            }
            let mut active = |found: &mut [u16]| match unity {
                Some(margin) => active_unity::<N, PART, FALLING>(codes, limit, out, found, margin),
                None => active::<N, PART, FALLING>(codes, limit, rest, gain, out, found),
            };
            let (held, there) = if N == CHUNK
                && let Some(found) = marks.rows(at)
            {
                let held = active(found);
                let there = found.len();
                marks.hold(at..at + held);
                (held, there)
            } else {
                let mut found = [0; KEPT];
                let held = active(&mut found);
                for (chunk, bits) in (at..at + held).zip(found) {
                    marks.mark(first + chunk * N, N, bits.into());
                }
                (held, KEPT)
            };
            // The chunk after those is known to be inactive.
            at += (held + 1).min(there);
            any |= held > 0;
        }
        any
    }
}

/// Returns the number of leading chunks that are inactive. The next one may be inactive, too.
fn inactive<const N: usize, const FALLING: bool>(codes: &[[Code; N]], limit: &[[u16; N]]) -> usize {
    match (pairs(codes), pairs(limit)) {
        (Some(codes), Some(limit)) => inactive_pairs::<FALLING>(codes, limit),
        _ => inactive_taxels::<N, FALLING>(codes, limit),
    }
}

/// Two taxels in a word, in either order.
type Pair = u32;
/// Pairs per step of the comparison: as many as need no stack on a Cortex-M0+.
const PAIRS: usize = 2;

/// Casts whole chunks to pairs, if they are aligned like words.
fn pairs<T: Pod, const N: usize>(chunks: &[[T; N]]) -> Option<&[[Pair; CHUNK / 2]]> {
    if N != CHUNK {
        return None;
    }
    let words: &[Pair] = try_cast_slice(chunks.as_flattened()).ok()?;
    Some(words.as_chunks().0)
}

/// Skips inactive chunks, two taxels at once.
///
/// SWAR compare: bit 15 of a half is set on underflow. The borrow changes the other half, but the chunk
/// counts as active then in any case. An underflow can leave bit 15 clear only if the subtrahend has it set,
/// so that bit counts, too. Values and differences from 0x8000 may therefore report a false positive.
#[inline(never)] // M0+: out of line
fn inactive_pairs<const FALLING: bool>(codes: &[[Pair; CHUNK / 2]], limit: &[[Pair; CHUNK / 2]]) -> usize {
    let maybe_active = |codes: &[Pair; CHUNK / 2], limit: &[Pair; CHUNK / 2]| {
        let [codes, limit] = [codes, limit].map(|pairs| pairs.as_chunks::<PAIRS>().0);
        codes.iter().zip(limit).any(|(codes, limit)| {
            let over = codes.iter().zip(limit).fold(0, |all, (code, limit)| {
                let (from, less) = if FALLING { (code, limit) } else { (limit, code) };
                all | from.wrapping_sub(*less) | less
            });
            over & 0x8000_8000 != 0
        })
    };
    let there = codes.len().min(limit.len());
    let (Some(mut codes), Some(mut limit)) = (codes.get(..there), limit.get(..there)) else { return 0 };
    while let ([code, codes_after @ ..], [most, limit_after @ ..]) = (codes, limit)
        && !maybe_active(code, most)
    {
        (codes, limit) = (codes_after, limit_after);
    }
    there - codes.len()
}

/// Skips inactive chunks, one taxel after the other.
///
/// No branch per taxel: a chunk's differences are combined, and the sign of the result says if one is
/// negative.
#[inline(never)] // M0+: out of line
fn inactive_taxels<const N: usize, const FALLING: bool>(codes: &[[Code; N]], limit: &[[u16; N]]) -> usize {
    let active = |(codes, limit): (&[Code; N], &[u16; N])| {
        let over = codes.iter().zip(limit).map(|(code, limit)| {
            let (code, limit) = (i32::from(code.0), i32::from(*limit));
            if FALLING { code - limit } else { limit - code }
        });
        over.fold(0, |all, one| all | one) < 0
    };
    codes.iter().zip(limit).position(active).unwrap_or(codes.len())
}

/// Calibrates chunks up to the first inactive one, or until `found` is full. Returns their number; `found[i]`
/// masks the active taxels.
#[inline(never)]
fn active<const N: usize, const PART: usize, const FALLING: bool>(
    codes: &[[Code; N]],
    limit: &[[u16; N]],
    rest: &[[u16; N]],
    gain: &[[u16; N]],
    out: &mut [[u16; N]],
    found: &mut [u16],
) -> usize {
    let mut held = 0;
    let chunks = codes.iter().zip(limit).zip(rest).zip(gain).zip(out).zip(found);
    for (((((codes, limit), rest), gain), out), found) in chunks {
        let ((codes, _), (limit, _)) = (codes.as_chunks(), limit.as_chunks());
        let ((rest, _), (gain, _), (parts, _)) = (rest.as_chunks(), gain.as_chunks(), out.as_chunks_mut());
        let mut bits = 0;
        for (part, ((((codes, limit), rest), gain), out)) in
            codes.iter().zip(limit).zip(rest).zip(gain).zip(parts).enumerate()
        {
            bits |= scale::<PART, FALLING>(codes, limit, rest, gain, out) << (part * PART);
        }
        replace::<N, PART>(out, found, bits);
        if bits == 0 {
            break;
        }
        held += 1;
    }
    held
}

/// Calibrates like [`active`] with unity gain: code - baseline = (code - limit) + margin.
#[inline(never)]
fn active_unity<const N: usize, const PART: usize, const FALLING: bool>(
    codes: &[[Code; N]],
    limit: &[[u16; N]],
    out: &mut [[u16; N]],
    found: &mut [u16],
    margin: u16,
) -> usize {
    let mut held = 0;
    for (((codes, limit), out), found) in codes.iter().zip(limit).zip(out).zip(found) {
        let bits = exceed::<N, PART, FALLING>(codes, limit, out, margin);
        replace::<N, PART>(out, found, bits);
        if bits == 0 {
            break;
        }
        held += 1;
    }
    held
}

/// Stores the mask of a chunk's active taxels, and clears the values of taxels that were active before.
#[inline(always)]
fn replace<const N: usize, const PART: usize>(out: &mut [u16; N], found: &mut u16, bits: u32) {
    silence::<N, PART>(out, u32::from(*found) & !bits);
    *found = bits as u16;
}

/// Clears the values of taxels that were active in the last image, and are no more.
#[inline(always)]
fn silence<const N: usize, const PART: usize>(out: &mut [u16; N], gone: u32) {
    if gone == 0 {
        return;
    }
    if gone & gone.wrapping_sub(1) == 0 {
        if let Some(out) = out.get_mut(gone.trailing_zeros() as usize) {
            *out = 0;
        }
        return;
    }
    silence_several::<N, PART>(out, gone);
}

/// Clears several taxels by testing all: finding them one by one would take longer.
#[inline(never)]
fn silence_several<const N: usize, const PART: usize>(out: &mut [u16; N], gone: u32) {
    let mut gone = gone;
    for part in out.as_chunks_mut::<PART>().0 {
        for (at, out) in part.iter_mut().enumerate() {
            if gone & 1 << at != 0 {
                *out = 0;
            }
        }
        gone >>= PART;
    }
}

/// Values of all active taxels of a chunk with unity gain, for which a code is `margin` further from its
/// baseline than from its limit. Returns their mask.
#[inline(never)] // M0+: out of line
fn exceed<const N: usize, const PART: usize, const FALLING: bool>(
    codes: &[Code; N],
    limit: &[u16; N],
    out: &mut [u16; N],
    margin: u16,
) -> u32 {
    let ((codes, _), (limit, _), (parts, _)) = (codes.as_chunks(), limit.as_chunks(), out.as_chunks_mut());
    let mut bits = 0;
    for (part, ((codes, limit), out)) in codes.iter().zip(limit).zip(parts).enumerate() {
        let (codes, limit, out): (&[Code; PART], &[u16; PART], &mut [u16; PART]) = (codes, limit, out);
        for (at, ((code, limit), out)) in codes.iter().zip(limit).zip(out).enumerate() {
            let (more, less) = if FALLING { (*limit, code.0) } else { (code.0, *limit) };
            if more > less {
                *out = (more - less).wrapping_add(margin);
                bits |= 1 << (part * PART + at);
            }
        }
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Few distinct values, so that many are equal, at both ends of the scale and in its middle.
    #[test]
    fn pairs_are_inactive_where_both_taxels_are() {
        let mut noise = 1u32;
        let mut next = |sizes: &[u16]| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            sizes[(noise >> 16) as usize % sizes.len()]
        };
        let all = [0, 1, 700, 701, 0x7fff, 0x8000, 0x8001, 0xffff];
        for round in 0..20_000 {
            // Mostly inactive; half the rounds within 15 bits.
            let sizes = if round % 2 == 0 { &all[..5] } else { &all };
            let [mut less, mut more] = [[0; CHUNK]; 2];
            for (less, more) in less.iter_mut().zip(&mut more) {
                let sizes = [next(sizes), next(sizes)];
                (*less, *more) = (sizes[0].min(sizes[1]), sizes[0].max(sizes[1]));
            }
            if round % 3 == 0 {
                let at = usize::from(next(&[0, 1, 2, 14, 15]));
                (less[at], more[at]) = (more[at], less[at]);
            }
            let words = |taxels: [u16; CHUNK]| [bytemuck::must_cast::<_, [Pair; CHUNK / 2]>(taxels)];
            let codes = |taxels: [u16; CHUNK]| [taxels.map(Code)];
            for (quick, exact) in [
                (
                    inactive_pairs::<false>(&words(less), &words(more)),
                    inactive_taxels::<_, false>(&codes(less), &[more]),
                ),
                (
                    inactive_pairs::<true>(&words(more), &words(less)),
                    inactive_taxels::<_, true>(&codes(more), &[less]),
                ),
            ] {
                if sizes.len() < all.len() {
                    assert_eq!(quick, exact);
                } else {
                    assert!(quick <= exact);
                }
            }
        }
    }
}
