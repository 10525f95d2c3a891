//! Cuts a board's bytes into whole frames of the wire, and distinguishes images.

use super::stamp::PieceKind;
use taxel_core::wire::Report;

/// Longest frame; what is longer is none, and is passed on in parts.
const LONGEST: usize = 16 * 1024;
/// Numbers of the reports that hold an image or raw codes.
const IMAGES: [u8; 2] = [Report::FRAME as u8, Report::RAW as u8];

/// Cuts bytes, which come in any split, behind each 0x00. No byte is added, changed or left out: empty frames
/// go with the next one.
#[derive(Debug, Default)]
pub struct FrameCutter {
    /// Bytes since the end of the last frame.
    begun: Vec<u8>,
    /// One of them is not 0x00.
    is_begun: bool,
}

impl FrameCutter {
    /// Takes bytes; hands each complete frame, with its 0x00, to `each`.
    pub fn push(&mut self, bytes: &[u8], mut each: impl FnMut(PieceKind, &[u8])) {
        for byte in bytes {
            self.begun.push(*byte);
            let is_end = *byte == 0 && self.is_begun;
            self.is_begun |= *byte != 0;
            if is_end || self.begun.len() >= LONGEST {
                each(kind(&self.begun), &self.begun);
                self.reset();
            }
        }
    }

    /// Drops a partial frame: the link is lost.
    pub fn reset(&mut self) {
        self.begun.clear();
        self.is_begun = false;
    }
}

/// Kind of one piece that the cutter hands out. Error if it hands out none like this.
pub(super) fn kind_of_piece(bytes: &[u8]) -> Result<PieceKind, &'static str> {
    if bytes.len() > LONGEST {
        return Err("it is too long");
    }
    let first = bytes.iter().position(|byte| *byte != 0).unwrap_or(bytes.len());
    match bytes[first..].iter().position(|byte| *byte == 0) {
        Some(end) if first + end + 1 < bytes.len() => Err("it is more than one frame"),
        None if bytes.len() < LONGEST => Err("it has no end"),
        _ => Ok(kind(bytes)),
    }
}

/// Kind of a frame. What cannot be read is passed on like contacts, so that whoever gets it counts it.
fn kind(frame: &[u8]) -> PieceKind {
    match report(frame) {
        Some(number) if IMAGES.contains(&number) => PieceKind::Image,
        _ => PieceKind::Main,
    }
}

/// Number of the report in a frame: behind the message's own number, a varint of at most five bytes.
fn report(frame: &[u8]) -> Option<u8> {
    let mut head = unstuffed(frame.iter().copied().skip_while(|byte| *byte == 0)).take(6);
    head.by_ref().find(|byte| byte & 0x80 == 0)?;
    head.next()
}

/// Bytes of a message from those of its frame, without COBS.
fn unstuffed(mut frame: impl Iterator<Item = u8>) -> impl Iterator<Item = u8> {
    // Bytes until the next code, and whether a zero precedes it.
    let (mut left, mut zero) = (0, false);
    std::iter::from_fn(move || {
        while left == 0 {
            let code = frame.next().filter(|code| *code != 0)?;
            let is_zero = std::mem::replace(&mut zero, code != u8::MAX);
            left = code - 1;
            if is_zero {
                return Some(0);
            }
        }
        left -= 1;
        frame.next()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::format::Micros;
    use taxel_core::wire::{Frame, Level, Log, Raw, Report, encode, frame_bound};

    /// A frame of the wire of this message.
    fn frame(seq: u32, report: &Report<'_>) -> Vec<u8> {
        encode(&(seq, report), &mut [0; frame_bound(1024)]).unwrap().to_vec()
    }

    fn log(text: &str) -> Report<'_> {
        Report::Log(Log { time: Micros(0), level: Level::Info, text })
    }

    fn image(data: &[u8]) -> Report<'_> {
        Report::Frame(Frame { frame: 0, time: Micros(0), base: None, sum: 0, data })
    }

    /// Pieces of bytes that come `step` at a time.
    fn pieces(bytes: &[u8], step: usize) -> Vec<(PieceKind, Vec<u8>)> {
        let (mut cutter, mut all) = (FrameCutter::default(), Vec::new());
        for part in bytes.chunks(step) {
            cutter.push(part, |kind, piece| all.push((kind, piece.to_vec())));
        }
        all
    }

    #[test]
    fn bytes_are_cut_behind_each_frame_and_images_are_known() {
        let zeros = [0; 600];
        for seq in [0, 1, 0x80, 0x4000, u32::MAX] {
            let raw = Report::Raw(Raw { frame: 0, time: Micros(0), data: &[7; 300] });
            let reports =
                [(PieceKind::Main, log("a")), (PieceKind::Image, image(&zeros)), (PieceKind::Image, raw)];
            let frames: Vec<_> = reports.map(|(kind, report)| (kind, frame(seq, &report))).into();
            let bytes: Vec<u8> = frames.iter().flat_map(|(_, frame)| frame).copied().collect();
            for step in [1, 7, 4096] {
                assert_eq!(pieces(&bytes, step), frames, "{seq} in steps of {step}");
            }
        }
    }

    #[test]
    fn no_byte_is_left_out_and_garbage_is_passed_on() {
        let end = frame(3, &log("end"));
        let bytes = [&[0, 0], b"garbage\0".as_slice(), &[0], &end].concat();
        let cut = pieces(&bytes, 5);
        assert_eq!(cut.iter().map(|(kind, _)| *kind).collect::<Vec<_>>(), [PieceKind::Main; 2]);
        assert_eq!(cut.concat_bytes(), bytes);
        let endless = pieces(&[9; 3 * LONGEST], 4096);
        assert_eq!((endless.len(), endless.concat_bytes()), (3, vec![9; 3 * LONGEST]));
        let mut cutter = FrameCutter::default();
        cutter.push(&end[..5], |_, _| panic!("it is not complete"));
        cutter.reset();
        cutter.push(&end, |_, piece| assert_eq!(piece, end));
    }

    /// All bytes of pieces.
    trait ConcatBytes {
        fn concat_bytes(&self) -> Vec<u8>;
    }

    impl ConcatBytes for Vec<(PieceKind, Vec<u8>)> {
        fn concat_bytes(&self) -> Vec<u8> {
            self.iter().flat_map(|(_, piece)| piece).copied().collect()
        }
    }
}
