//! Decodes LZ4 frames directly into the caller's buffer, without copies or allocation.
//!
//! Supports frames of independent blocks without a dictionary, as in our chunks and most others. Checksums
//! (of block and content) are ignored, because a chunk of MCAP has its own.

use lz4_flex::frame::{BlockSize, FrameEncoder, FrameInfo};
use std::sync::LazyLock;

const MAGIC: u32 = 0x184D_2204;
/// Bits of the frame's first byte.
const VERSION: u8 = 0b1100_0000;
const VERSION_1: u8 = 0b0100_0000;
const INDEPENDENT: u8 = 0b0010_0000;
const BLOCK_CHECKSUMS: u8 = 0b0001_0000;
const CONTENT_SIZE: u8 = 0b0000_1000;
const DICTIONARY: u8 = 0b0000_0001;
/// Flag of a block's length: the block is uncompressed.
const PLAIN: u32 = 1 << 31;

/// True if a frame's head is one that chunks of this program have. Other heads must be checked against their
/// own checksum, which [`decode`] ignores.
pub fn is_ours(frame: &[u8]) -> bool {
    static HEADS: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
        [BlockSize::Max64KB, BlockSize::Max256KB, BlockSize::Max4MB].into_iter().filter_map(head).collect()
    });
    HEADS.iter().any(|head| frame.starts_with(head))
}

/// Head of a frame with this block size and no other options.
fn head(size: BlockSize) -> Option<Vec<u8>> {
    let empty = FrameEncoder::with_frame_info(FrameInfo::new().block_size(size), Vec::new()).finish().ok()?;
    // An empty frame ends with a block length of 0.
    empty.strip_suffix(&[0; 4]).map(<[u8]>::to_vec)
}

/// Decodes a frame that fills `out` exactly. Returns false if it is of another kind or damaged; then the
/// contents of `out` are undefined.
pub fn decode(mut frame: &[u8], out: &mut [u8]) -> bool {
    blocks(&mut frame, out).is_some_and(|length| length == out.len())
}

/// Decodes blocks. Returns the number of decoded bytes.
fn blocks(frame: &mut &[u8], out: &mut [u8]) -> Option<usize> {
    if number(frame)? != MAGIC {
        return None;
    }
    let flags = *frame.split_off_first()?;
    if flags & VERSION != VERSION_1 || flags & INDEPENDENT == 0 || flags & DICTIONARY != 0 {
        return None;
    }
    // Largest block, size of the content if present, checksum of this head.
    let rest = if flags & CONTENT_SIZE == 0 { 2 } else { 10 };
    frame.split_off(..rest)?;
    let mut length = 0;
    loop {
        let size = number(frame)?;
        if size == 0 {
            return Some(length);
        }
        let block = frame.split_off(..(size & !PLAIN) as usize)?;
        let room = out.get_mut(length..)?;
        length += if size & PLAIN == 0 {
            lz4_flex::block::decompress_into(block, room).ok()?
        } else {
            room.get_mut(..block.len())?.copy_from_slice(block);
            block.len()
        };
        if flags & BLOCK_CHECKSUMS != 0 {
            frame.split_off(..4)?;
        }
    }
}

fn number(frame: &mut &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(frame.split_off(..4)?.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lz4_flex::frame::BlockMode;
    use std::io::Write;

    fn frame(info: FrameInfo, body: &[u8]) -> Vec<u8> {
        let mut encoder = FrameEncoder::with_frame_info(info, Vec::new());
        encoder.write_all(body).unwrap();
        encoder.finish().unwrap()
    }

    /// Compressible runs, and 70,000 incompressible bytes.
    fn body() -> Vec<u8> {
        let mut random = fastrand::Rng::with_seed(1);
        let noise = std::iter::repeat_with(move || random.u8(..)).take(70_000);
        (0..400_000u32).map(|index| (index / 1000) as u8).chain(noise).collect()
    }

    #[test]
    fn frames_of_every_kind_are_decoded_or_left_to_others() {
        let (body, info) = (body(), FrameInfo::new().block_size(BlockSize::Max64KB));
        let mut out = vec![0; body.len()];
        for info in [
            info.clone(),
            info.clone().block_checksums(true),
            info.clone().content_checksum(true),
            info.clone().content_size(Some(body.len() as u64)),
            FrameInfo::new().block_size(BlockSize::Max4MB),
        ] {
            out.fill(0);
            assert!(decode(&frame(info.clone(), &body), &mut out), "{info:?}");
            assert!(out == body, "{info:?}");
        }
        assert!(!decode(&frame(info.clone().block_mode(BlockMode::Linked), &body), &mut out));
        let whole = frame(info, &body);
        assert!(!decode(&whole, &mut vec![0; body.len() + 1]));
        assert!(!decode(&whole, &mut vec![0; body.len() - 1]));
        for length in (0..whole.len()).step_by(97) {
            assert!(!decode(&whole[..length], &mut out), "{length} of {}", whole.len());
        }
    }

    #[test]
    fn a_frame_of_ours_is_known_by_its_head_and_any_other_head_is_not() {
        for length in [0, 1, 70_000, 300_000, 400_000] {
            // As chunks are written.
            let mut encoder = FrameEncoder::new(Vec::new());
            encoder.write_all(&body()[..length]).unwrap();
            let whole = encoder.finish().unwrap();
            assert!(is_ours(&whole), "{length}");
            for (at, bit) in (0..7).flat_map(|at| (0..8).map(move |bit| (at, bit))) {
                let mut damaged = whole.clone();
                damaged[at] ^= 1 << bit;
                assert!(!is_ours(&damaged), "bit {bit} of byte {at}");
            }
        }
        assert!(!is_ours(&frame(FrameInfo::new().content_checksum(true), &body())));
    }

    #[test]
    fn any_bytes_are_decoded_or_refused() {
        let mut random = fastrand::Rng::with_seed(2);
        let whole = frame(FrameInfo::new(), &body()[..3000]);
        let mut out = vec![0; 3000];
        for _ in 0..20_000 {
            let mut damaged = whole.clone();
            for _ in 0..random.usize(1..4) {
                let at = random.usize(..damaged.len());
                damaged[at] = random.u8(..);
            }
            decode(&damaged, &mut out);
        }
    }
}
