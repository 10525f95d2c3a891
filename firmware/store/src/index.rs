//! The index: the parts of the settings that are in force, with their checksums.

use heapless::Vec;
use serde::{Deserialize, Serialize};
use taxel_core::board::Part;
use taxel_core::format::crc32;

/// Version of the storage format.
pub const VERSION: u8 = 1;

/// Entry of a part in force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Entry {
    /// Number of the [`Part`].
    pub part: u8,
    /// Place of the entry, 0 or 1.
    pub place: u8,
    /// Number of its bytes.
    pub length: u16,
    /// CRC-32/ISO-HDLC of its bytes.
    pub sum: u32,
}

impl Entry {
    /// Entry of a part with this content in this place.
    pub fn of(part: Part, place: u8, content: &[u8]) -> Entry {
        Entry { part: part as u8, place, length: content.len() as u16, sum: crc32(content) }
    }

    /// True if that is its content.
    pub fn holds(&self, content: &[u8]) -> bool {
        usize::from(self.length) == content.len() && self.sum == crc32(content)
    }
}

/// Index of all parts in force.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Index {
    /// Entries of the parts.
    pub entries: Vec<Entry, { Part::ALL.len() }>,
    /// Further fields.
    pub more: More,
}

/// Fields that later versions appended to an index. An older index ends before them, and an older firmware
/// does not read them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct More {
    /// Number of saves that the flash could take soon after this one.
    pub saves: u8,
    /// True if a host has set the settings aside: a board does not use them at start-up.
    pub aside: bool,
}

impl Index {
    /// Greatest length in bytes: version, number of entries, the fields of each, and the further fields.
    pub const BYTES: usize = 2 + Part::ALL.len() * 10 + 2;

    /// An index without parts, with that number of saves left.
    pub const fn new(saves: u8) -> Index {
        Index { entries: Vec::new(), more: More { saves, aside: false } }
    }

    /// The entry of a part.
    pub fn entry(&self, part: Part) -> Option<Entry> {
        self.entries.iter().find(|entry| entry.part == part as u8).copied()
    }

    /// Decodes the bytes of an index behind its version; none if they are damaged.
    pub fn read(bytes: &[u8]) -> Option<Index> {
        let (entries, rest) = postcard::take_from_bytes(bytes).ok()?;
        let older = More { saves: u8::MAX, aside: false };
        let more = if rest.is_empty() { older } else { postcard::from_bytes(rest).ok()? };
        Some(Index { entries, more })
    }

    /// Encodes the index with its version; none if there is no room.
    pub fn write<'b>(&self, to: &'b mut [u8; Index::BYTES]) -> Option<&'b [u8]> {
        let written = postcard::to_slice(&(VERSION, &self.entries, self.more), to).ok()?;
        Some(written)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_older_index_is_in_force_and_an_older_firmware_reads_this_one() {
        let mut index = Index::new(5);
        let _ = index.entries.push(Entry { part: 2, place: 1, length: 4096, sum: u32::MAX });
        index.more.aside = true;
        let mut bytes = [0; Index::BYTES];
        let bytes = index.write(&mut bytes).unwrap();
        assert_eq!(bytes, [VERSION, 1, 2, 1, 0x80, 0x20, 0xff, 0xff, 0xff, 0xff, 0x0f, 5, 1]);
        assert_eq!(Index::read(&bytes[1..]), Some(index.clone()));
        // The format before the further fields.
        let older = &bytes[..bytes.len() - 2];
        let read = Index::read(&older[1..]).unwrap();
        assert_eq!((read.entries, read.more), (index.entries.clone(), More { saves: u8::MAX, aside: false }));
        type Older = (u8, Vec<Entry, { Part::ALL.len() }>);
        assert_eq!(postcard::from_bytes::<Older>(bytes), Ok((VERSION, index.entries)));
        assert_eq!(Index::read(&bytes[1..bytes.len() - 1]), None);
    }

    #[test]
    fn an_entry_holds_its_own_content_alone() {
        let entry = Entry::of(Part::Gain, 0, b"gain");
        assert!(entry.holds(b"gain"));
        assert!(!entry.holds(b"gaim") && !entry.holds(b"gai"));
        assert!(!Entry { length: 5, ..entry }.holds(b"gain"));
    }

    #[test]
    fn the_longest_index_fits_its_bytes_and_no_others() {
        let mut index = Index::new(u8::MAX);
        for part in Part::ALL {
            let entry = Entry { part: part as u8, place: 1, length: u16::MAX, sum: u32::MAX };
            index.entries.push(entry).unwrap();
        }
        let mut bytes = [0; Index::BYTES];
        assert_eq!(index.write(&mut bytes).map(<[u8]>::len), Some(Index::BYTES));
    }
}
