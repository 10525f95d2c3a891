//! A frame of the wire on its way between machines.

use super::cut;
use super::stamp::{PieceKind, PieceStamp};

/// A frame and its stamp.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WirePiece {
    /// Kind by which it has travelled.
    pub kind: PieceKind,
    /// Place to which it belongs.
    pub stamp: PieceStamp,
    /// The bytes, as the board has sent them.
    pub bytes: Vec<u8>,
}

impl WirePiece {
    /// A piece that came by this way, from the attachment and the payload of its sample. Error if no program that
    /// offers a board sends this.
    pub fn read(kind: PieceKind, attachment: &[u8], bytes: &[u8]) -> Result<WirePiece, &'static str> {
        let stamp = PieceStamp::from_bytes(attachment).ok_or("its attachment is no stamp")?;
        let number = match kind {
            PieceKind::Main => stamp.main,
            PieceKind::Image => stamp.images,
        };
        if number == 0 {
            return Err("its stamp does not count it");
        }
        match cut::kind_of_piece(bytes)? {
            of if of == kind => Ok(WirePiece { kind, stamp, bytes: bytes.to_vec() }),
            PieceKind::Main => Err("it holds no image"),
            PieceKind::Image => Err("it holds an image"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::Report;

    #[test]
    fn only_what_a_program_sends_is_read() {
        let stamp = PieceStamp { publisher: 5, main: 1, images: 0 }.to_bytes();
        let read = |attachment: &[u8], bytes: &[u8]| WirePiece::read(PieceKind::Main, attachment, bytes);
        assert_eq!(read(&stamp, &[0, 2, 1, 0]).unwrap().bytes, [0, 2, 1, 0]);
        assert!(read(&stamp, &[9; 16 * 1024]).is_ok(), "a part of what is no frame");
        for (attachment, bytes, why) in [
            (&[][..], &[2, 1, 0][..], "its attachment is no stamp"),
            (&[0; 24], &[2, 1, 0], "its stamp does not count it"),
            (&stamp, &[], "it has no end"),
            (&stamp, &[0], "it has no end"),
            (&stamp, &[2, 1], "it has no end"),
            (&stamp, &[2, 0, 2, 0], "it is more than one frame"),
            (&stamp, &[9; 16 * 1024 + 1], "it is too long"),
        ] {
            assert_eq!(read(attachment, bytes), Err(why), "{bytes:?}");
        }
        let image = [3, 7, Report::FRAME as u8, 0];
        assert_eq!(read(&stamp, &image), Err("it holds an image"));
        let stamp = PieceStamp { publisher: 5, main: 0, images: 1 }.to_bytes();
        assert!(WirePiece::read(PieceKind::Image, &stamp, &image).is_ok());
        assert_eq!(WirePiece::read(PieceKind::Image, &stamp, &[2, 1, 0]), Err("it holds no image"));
    }
}
