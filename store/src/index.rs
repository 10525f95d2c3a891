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

/// All parts in force.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Index {
    /// [`VERSION`]
    pub version: u8,
    /// The parts.
    pub entries: Vec<Entry, { Part::ALL.len() }>,
}

impl Index {
    /// Longest form in bytes: version, number of entries, and the fields of each.
    pub const BYTES: usize = 2 + Part::ALL.len() * 10;

    /// Nothing is in force.
    pub const fn new() -> Index {
        Index { version: VERSION, entries: Vec::new() }
    }

    /// The entry of a part.
    pub fn entry(&self, part: Part) -> Option<Entry> {
        self.entries.iter().find(|entry| entry.part == part as u8).copied()
    }
}
