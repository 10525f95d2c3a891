//! LZ4 frames, written block by block, and decoded from one buffer of the caller's into the other.
//!
//! Supports frames of independent blocks without a dictionary, as in our chunks and most others. Checksums
//! (of block and content) are ignored, because a chunk of MCAP has its own.

use lz4_flex::block::{compress_into, get_maximum_output_size};

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

/// Largest block of a frame of ours, bytes: LZ4 looks back 64 KiB, and at its beginning not at all.
const BLOCK: usize = 256 << 10;
/// Head of a frame of such blocks.
const HEAD: [u8; 7] = [0x04, 0x22, 0x4D, 0x18, 0x60, 0x50, 0xFB];

/// True if a frame's head is one that chunks of this program have. Other heads must be checked against their
/// own checksum, which [`decode`] ignores.
pub fn is_ours(frame: &[u8]) -> bool {
    frame.starts_with(&HEAD)
}

/// A frame being written: what fills a block is compressed at once, while it is in the processor's cache.
#[derive(Debug)]
pub struct FrameWriter {
    /// Bytes that are not compressed yet.
    rest: Vec<u8>,
    /// The frame so far.
    frame: Vec<u8>,
    /// Room for a compressed block.
    room: Box<[u8]>,
    /// Number of bytes that are compressed, and their CRC-32.
    packed: usize,
    sum: crc32fast::Hasher,
}

impl Default for FrameWriter {
    fn default() -> FrameWriter {
        FrameWriter {
            rest: Vec::new(),
            frame: HEAD.to_vec(),
            room: vec![0; get_maximum_output_size(BLOCK)].into(),
            packed: 0,
            sum: crc32fast::Hasher::new(),
        }
    }
}

impl FrameWriter {
    /// Adds what this appends to a buffer; nothing on error.
    pub fn add<E>(&mut self, append: impl FnOnce(&mut Vec<u8>) -> Result<(), E>) -> Result<(), E> {
        let before = self.rest.len();
        let appended = append(&mut self.rest);
        if appended.is_err() {
            self.rest.truncate(before);
        }
        while self.rest.len() >= BLOCK {
            self.pack(BLOCK);
        }
        appended
    }

    /// Number of bytes that were added.
    pub fn length(&self) -> usize {
        self.packed + self.rest.len()
    }

    /// Ends the frame, and begins another. Returns it, and the number of bytes that were added and their CRC-32.
    pub fn end(&mut self) -> (Vec<u8>, u64, u32) {
        if !self.rest.is_empty() {
            self.pack(self.rest.len());
        }
        // A block of no length ends the frame.
        self.frame.extend([0; 4]);
        // The next one will be about as long.
        let mut next = Vec::with_capacity(self.frame.len());
        next.extend(HEAD);
        let frame = std::mem::replace(&mut self.frame, next);
        let length = std::mem::take(&mut self.packed) as u64;
        (frame, length, std::mem::take(&mut self.sum).finalize())
    }

    /// Compresses the first bytes that are not yet.
    fn pack(&mut self, length: usize) {
        let block = &self.rest[..length];
        let packed = compress_into(block, &mut self.room).ok().and_then(|length| self.room.get(..length));
        let (flag, bytes) = packed.filter(|it| it.len() < length).map_or((PLAIN, block), |it| (0, it));
        self.frame.extend_from_slice(&(bytes.len() as u32 | flag).to_le_bytes());
        self.frame.extend_from_slice(bytes);
        self.sum.update(block);
        self.packed += length;
        self.rest.drain(..length);
    }
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
    use lz4_flex::frame::{BlockMode, BlockSize, FrameDecoder, FrameEncoder, FrameInfo};
    use std::io::{Read, Write};

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

    fn add(writer: &mut FrameWriter, bytes: &[u8]) {
        let added: Result<(), &str> = writer.add(|out| {
            out.extend_from_slice(bytes);
            Ok(())
        });
        assert_eq!(added, Ok(()));
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
    fn a_frame_of_ours_is_that_of_the_library_and_comes_back() {
        let (long, mut writer) = (body().repeat(11), FrameWriter::default());
        let mut random = fastrand::Rng::with_seed(3);
        for length in [0, 1, 12, 65_536, 65_537, 262_144, 262_145, 470_000, 4 << 20, long.len()] {
            // Runs first, and noise first, which does not become shorter.
            for body in [&long[..length], &long[long.len() - length..]] {
                // In pieces of all lengths.
                let mut rest = body;
                while let Some(piece) = rest
                    .split_off(..rest.len().min(random.usize(1..100_000)))
                    .filter(|piece| !piece.is_empty())
                {
                    add(&mut writer, piece);
                    let failed = writer.add(|out| {
                        out.extend_from_slice(piece);
                        Err("no")
                    });
                    assert_eq!(failed, Err("no"));
                }
                assert_eq!(writer.length(), length);
                let (ours, stated, sum) = writer.end();
                assert_eq!((stated, sum), (length as u64, crc32fast::hash(body)));
                assert!(ours == frame(FrameInfo::new().block_size(BlockSize::Max256KB), body), "{length}");
                let mut out = vec![0; body.len()];
                assert!(decode(&ours, &mut out) && out == body, "{length}");
                out.clear();
                FrameDecoder::new(&ours[..]).read_to_end(&mut out).unwrap();
                assert!(out == body, "{length}");
            }
        }
    }

    #[test]
    fn a_frame_of_ours_is_known_by_its_head_and_any_other_head_is_not() {
        let mut writer = FrameWriter::default();
        add(&mut writer, &body());
        let ours = writer.end().0;
        assert!(is_ours(&ours));
        for (at, bit) in (0..7).flat_map(|at| (0..8).map(move |bit| (at, bit))) {
            let mut damaged = ours.clone();
            damaged[at] ^= 1 << bit;
            assert!(!is_ours(&damaged), "bit {bit} of byte {at}");
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
