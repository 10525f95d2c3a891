//! Memory for the pictures of patterns, shared by all contacts: few are large enough to have one.

use super::gradient::SIDE;
use crate::capacity::TAXELS;
use crate::garment::Rect;

/// Smallest contact that has a picture: in a square of ten, six by six taxels are clear of the outline.
pub(crate) const LEAST_AREA: u16 = 100;

/// Most pictures: a garment has no more contacts that are large enough. Only contacts that have shrunk since
/// their picture was taken may hold more; a contact that finds no place then has no pattern.
const PICTURES: usize = if cfg!(feature = "slip") { TAXELS / LEAST_AREA as usize } else { 0 };

/// A picture of the middle of a contact.
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    pub anchor: [[u16; SIDE]; SIDE],
    /// Bit mask of the columns of each row that are compared: two taxels clear of the contact's outline.
    pub inner: [u16; SIDE],
    /// Position of the picture.
    pub window: Rect,
    /// Total and peak of the contact when the picture was taken.
    pub total: u32,
    pub peak: u16,
}

/// The pictures of all contacts.
#[derive(Debug, Clone)]
pub(crate) struct Album {
    pictures: [Picture; PICTURES],
    /// Places in use, one bit each.
    used: u32,
    /// True if a picture was taken in this frame, or was tried.
    pub busy: bool,
}

/// Number of a place, with which its owner asks for the picture.
pub(crate) type Leaf = u8;

impl Album {
    pub const fn new() -> Self {
        const { assert!(PICTURES <= 32, "one bit each") };
        const BLANK: Picture = Picture {
            anchor: [[0; SIDE]; SIDE],
            inner: [0; SIDE],
            window: Rect { panel: 0, top: 0, bottom: 0, left: 0, right: 0 },
            total: 0,
            peak: 0,
        };
        Album { pictures: [BLANK; PICTURES], used: 0, busy: false }
    }

    /// Takes a free place, if there is one.
    pub fn take(&mut self) -> Option<Leaf> {
        let leaf = self.used.trailing_ones();
        let fits = leaf < PICTURES as u32;
        self.used |= u32::from(fits).unbounded_shl(leaf);
        fits.then_some(leaf as Leaf)
    }

    /// Gives a place back.
    pub fn free(&mut self, leaf: Leaf) {
        self.used &= !1u32.unbounded_shl(leaf.into());
    }

    /// Gives all places back.
    pub fn clear(&mut self) {
        self.used = 0;
    }

    pub fn picture(&self, leaf: Leaf) -> Option<&Picture> {
        self.pictures.get(usize::from(leaf))
    }

    pub fn picture_mut(&mut self, leaf: Leaf) -> Option<&mut Picture> {
        self.pictures.get_mut(usize::from(leaf))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_place_has_one_owner() {
        let mut album = Album::new();
        for leaf in 0..PICTURES {
            assert_eq!(album.take(), Some(leaf as Leaf));
        }
        assert_eq!(album.take(), None);
        album.free(7);
        album.free(3);
        assert_eq!([album.take(), album.take(), album.take()], [Some(3), Some(7), None]);
        album.clear();
        assert_eq!(album.take(), Some(0));
    }
}
