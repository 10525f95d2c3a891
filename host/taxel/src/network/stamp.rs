//! Way of a frame between machines, and place to which it belongs.

/// Way of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PieceKind {
    /// Contacts, reactions, answers, and all else that is no image: reliable, and before images.
    Main,
    /// An image or raw codes: dropped where the network is too slow.
    Image,
}

/// Place to which a frame belongs: the attachment of its sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PieceStamp {
    /// Number of the publisher, which a program draws when it begins to serve the board.
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

    /// Returns it as bytes: three numbers of 64 bits, low byte first.
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
}
