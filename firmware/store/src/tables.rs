//! A table of a kind, in a region of two halves: one holds the table in force, in place; the
//! next table is written to the other, piece by piece.
//!
//! At the end of a half lies its seal: number, length of the table and CRC-32/ISO-HDLC of both,
//! little-endian. The half with the later seal is in force. The seal is written last, and the old one is
//! erased first, so that the table in force stays so until the next one is complete, whatever happens during
//! the write.

use crate::store::StoreError;
use core::ops::Range;
use embedded_storage::nor_flash::NorFlash;
use taxel_core::board::{PieceToStore, TableKind};
use taxel_core::format::crc32;

/// Size of a sector of the flash.
const SECTOR: u32 = 4096;
/// Bytes of a seal.
const SEAL: usize = 12;
/// Size of a half: the longest table and its seal.
const fn half_bytes(kind: TableKind) -> u32 {
    (kind.bytes() + SEAL).next_multiple_of(SECTOR as usize) as u32
}

/// Size of the region of tables of a kind.
pub const fn tables_bytes(kind: TableKind) -> u32 {
    2 * half_bytes(kind)
}

/// The seal of a half.
#[derive(Debug, Clone, Copy)]
struct Seal {
    half: u32,
    number: u32,
    length: u32,
}

/// Two halves of a flash from an offset on.
pub struct Tables<F: NorFlash> {
    flash: F,
    start: u32,
    kind: TableKind,
}

impl<F: NorFlash> Tables<F> {
    /// The region of [`tables_bytes`] from offset `start` of the flash on. Error if it is not of whole
    /// sectors.
    pub fn new(flash: F, start: u32, kind: TableKind) -> Result<Self, StoreError> {
        let is_whole = F::ERASE_SIZE as u32 == SECTOR && start.is_multiple_of(SECTOR);
        let ends = (start as usize).checked_add(tables_bytes(kind) as usize);
        if !is_whole || ends.is_none_or(|end| end > flash.capacity()) {
            return Err(StoreError::Range);
        }
        Ok(Tables { flash, start, kind })
    }

    /// Returns the range of the table in force in the flash; none if there is none.
    pub fn in_force(&mut self) -> Result<Option<Range<u32>>, StoreError> {
        let seal = self.newest()?.filter(|seal| seal.length > 0);
        Ok(seal.map(|seal| self.table(seal.half, seal.length)))
    }

    /// Stores a piece of the next table. Returns where all of that table lies once its last piece is stored.
    pub fn store(&mut self, piece: &PieceToStore<'_>) -> Result<Range<u32>, StoreError> {
        let half = self.free()?;
        let end = piece.offset.checked_add(piece.bytes.len() as u32);
        if piece.length as usize > self.kind.bytes() || end.is_none_or(|end| end > piece.length) {
            return Err(StoreError::Range);
        }
        let last = self.last_sector(half);
        if piece.offset == 0 {
            self.erase(last)?;
        }
        let at = self.start + half * half_bytes(self.kind) + piece.offset;
        if at.is_multiple_of(SECTOR) && at != last {
            self.erase(at)?;
        }
        self.flash.write(at, piece.bytes).map_err(|_| StoreError::Flash)?;
        Ok(self.table(half, piece.length))
    }

    /// Puts the table in force whose pieces were stored last; none if its length is 0.
    pub fn keep(&mut self, length: u32) -> Result<(), StoreError> {
        let half = self.free()?;
        if length == 0 {
            self.erase(self.last_sector(half))?;
        }
        let number = self.newest()?.map_or(0, |seal| seal.number.wrapping_add(1));
        let mut bytes = [0; SEAL];
        bytes[..4].copy_from_slice(&number.to_le_bytes());
        bytes[4..8].copy_from_slice(&length.to_le_bytes());
        let crc = crc32(&bytes[..8]);
        bytes[8..].copy_from_slice(&crc.to_le_bytes());
        self.flash.write(self.seal_at(half), &bytes).map_err(|_| StoreError::Flash)?;
        // A flash reports no error for bits that it could not raise.
        match self.newest()? {
            Some(seal) if seal.half == half => Ok(()),
            _ => Err(StoreError::Damaged),
        }
    }

    fn table(&self, half: u32, length: u32) -> Range<u32> {
        let start = self.start + half * half_bytes(self.kind);
        start..start + length
    }

    fn last_sector(&self, half: u32) -> u32 {
        self.start + (half + 1) * half_bytes(self.kind) - SECTOR
    }

    fn seal_at(&self, half: u32) -> u32 {
        self.start + (half + 1) * half_bytes(self.kind) - SEAL as u32
    }

    /// The half that is not in force.
    fn free(&mut self) -> Result<u32, StoreError> {
        Ok(self.newest()?.map_or(0, |seal| 1 - seal.half))
    }

    /// The later of the valid seals.
    fn newest(&mut self) -> Result<Option<Seal>, StoreError> {
        Ok(match (self.seal(0)?, self.seal(1)?) {
            (Some(a), Some(b)) if b.number.wrapping_sub(a.number) < 1 << 31 => Some(b),
            (a, b) => a.or(b),
        })
    }

    fn seal(&mut self, half: u32) -> Result<Option<Seal>, StoreError> {
        let mut bytes = [0; SEAL];
        self.flash.read(self.seal_at(half), &mut bytes).map_err(|_| StoreError::Flash)?;
        let word = |at: usize| u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        let seal = Seal { half, number: word(0), length: word(4) };
        let is_whole = word(8) == crc32(&bytes[..8]) && seal.length as usize <= self.kind.bytes();
        Ok(is_whole.then_some(seal))
    }

    fn erase(&mut self, sector: u32) -> Result<(), StoreError> {
        self.flash.erase(sector, sector + SECTOR).map_err(|_| StoreError::Flash)
    }
}
