//! A frame of the wire on its way between machines.

use super::cut;

/// How a frame travels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PieceKind {
    /// Contacts, reactions, answers, and all else that is no image: reliable, and before images.
    Main,
    /// An image or raw codes: dropped where the network is too slow.
    Image,
}

/// Where a frame belongs: the attachment of its sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PieceStamp {
    /// Who has published it: a number that a program draws when it begins to serve the board.
    pub publisher: u64,
    /// Number of frames without an image that it has published, with this one.
    pub main: u64,
    /// Number of images that it has published, with this one.
    pub images: u64,
}

impl PieceStamp {
    /// The stamp of the next frame of this kind.
    pub fn next(self, kind: PieceKind) -> PieceStamp {
        match kind {
            PieceKind::Main => PieceStamp { main: self.main + 1, ..self },
            PieceKind::Image => PieceStamp { images: self.images + 1, ..self },
        }
    }

    /// The higher number of each way.
    pub fn max(self, other: PieceStamp) -> PieceStamp {
        PieceStamp { main: self.main.max(other.main), images: self.images.max(other.images), ..self }
    }

    /// As bytes: three numbers of 64 bits, low byte first.
    pub fn to_bytes(self) -> [u8; 24] {
        let mut bytes = [0; 24];
        for (place, number) in bytes.chunks_exact_mut(8).zip([self.publisher, self.main, self.images]) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        bytes
    }

    /// From these bytes; none if they are no stamp.
    pub fn from_bytes(bytes: &[u8]) -> Option<PieceStamp> {
        let bytes: &[u8; 24] = bytes.try_into().ok()?;
        let (numbers, _) = bytes.as_chunks::<8>();
        let [publisher, main, images] = [0, 1, 2].map(|place| u64::from_le_bytes(numbers[place]));
        Some(PieceStamp { publisher, main, images })
    }
}

/// A frame and its stamp.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WirePiece {
    /// How it has travelled.
    pub kind: PieceKind,
    /// Where it belongs.
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

    #[test]
    fn a_stamp_is_what_was_written() {
        let stamp = PieceStamp { publisher: u64::MAX - 1, main: 7, images: 1 << 40 };
        assert_eq!(PieceStamp::from_bytes(&stamp.to_bytes()), Some(stamp));
        assert_eq!(PieceStamp::from_bytes(&stamp.to_bytes()[1..]), None);
        assert_eq!(stamp.to_bytes()[8], 7);
        assert_eq!(stamp.next(PieceKind::Main).main, 8);
        assert_eq!(stamp.next(PieceKind::Image).images, (1 << 40) + 1);
    }

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
        let image = [3, 7, 1, 0];
        assert_eq!(read(&stamp, &image), Err("it holds an image"));
        let stamp = PieceStamp { publisher: 5, main: 0, images: 1 }.to_bytes();
        assert!(WirePiece::read(PieceKind::Image, &stamp, &image).is_ok());
        assert_eq!(WirePiece::read(PieceKind::Image, &stamp, &[2, 1, 0]), Err("it holds no image"));
    }
}
