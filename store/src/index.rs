//! The index: which parts of the settings are in force, and how they are known to be whole.

use crc::{CRC_32_ISO_HDLC, Crc, Table};
use heapless::Vec;
use serde::{Deserialize, Serialize};
use taxel_core::board::Part;

/// Version of the form in which settings are stored.
pub const VERSION: u8 = 1;

static CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// A part in force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Entry {
    /// Number of the [`Part`].
    pub part: u8,
    /// Which of its two places, 0 or 1.
    pub place: u8,
    /// Its bytes.
    pub length: u16,
    /// CRC-32/ISO-HDLC of them.
    pub sum: u32,
}

impl Entry {
    /// Of a part with this content, in this place.
    pub fn of(part: Part, place: u8, content: &[u8]) -> Entry {
        Entry { part: part as u8, place, length: content.len() as u16, sum: CRC.checksum(content) }
    }

    /// Whether that is its content.
    pub fn holds(&self, content: &[u8]) -> bool {
        usize::from(self.length) == content.len() && self.sum == CRC.checksum(content)
    }
}

/// All parts in force, and what goes with them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Index {
    /// The parts.
    pub entries: Vec<Entry, { Part::ALL.len() }>,
    /// What else is known of them.
    pub more: More,
}

/// What an index holds behind its parts since that was first stored. An older one has nothing there, and an
/// older firmware does not read so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct More {
    /// Saves that the flash could take soon after this one.
    pub saves: u8,
    /// A host has put the settings aside: a board that starts does not use them.
    pub aside: bool,
}

impl Index {
    /// Longest form in bytes: version, number of entries, the fields of each, and what else there is.
    pub const BYTES: usize = 2 + Part::ALL.len() * 10 + 2;

    /// No part is in force, and so many saves are left.
    pub const fn new(saves: u8) -> Index {
        Index { entries: Vec::new(), more: More { saves, aside: false } }
    }

    /// The entry of a part.
    pub fn entry(&self, part: Part) -> Option<Entry> {
        self.entries.iter().find(|entry| entry.part == part as u8).copied()
    }

    /// The bytes of an index, behind its version; none: they are damaged.
    pub fn read(bytes: &[u8]) -> Option<Index> {
        let (entries, rest) = postcard::take_from_bytes(bytes).ok()?;
        let older = More { saves: u8::MAX, aside: false };
        let more = if rest.is_empty() { older } else { postcard::from_bytes(rest).ok()? };
        Some(Index { entries, more })
    }

    /// As it is stored; none: there is no room.
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
        // As it was written before it had an end.
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
