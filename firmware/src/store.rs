//! The sectors of the flash with the settings, with the levels of outputs, and with tables.

use crate::watchdog::WATCHDOG;
use core::ops::Range;
use embassy_rp::flash::{self, Blocking, ERASE_SIZE, Error, READ_SIZE, WRITE_SIZE};
use embassy_rp::{peripherals::FLASH, watchdog::Watchdog};
use embedded_storage::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use taxel_core::board::{Saved, TableKind};
use taxel_core::react::Levels;
use taxel_store::{Store, StoreError, Tables, keep_levels, tables_bytes};

/// Size of the smallest flash of any board with an RP2040.
const BYTES: usize = 2 * 1024 * 1024;

/// Sectors of the settings, the last 64 KiB. Two sets of the longest settings take 25 KB; the rest spreads
/// the erasures.
const SECTORS: Range<u32> = BYTES as u32 - 64 * 1024..BYTES as u32;

/// The two sectors before them, with the levels of outputs at start-up.
pub const LEVELS: [u32; 2] = [SECTORS.start - 2 * ERASE_SIZE as u32, SECTORS.start - ERASE_SIZE as u32];

/// Returns the start of the tables of a kind: those of the surface before the levels, those of folds before
/// them.
const fn tables_start(kind: TableKind) -> u32 {
    let surface = LEVELS[0] - tables_bytes(TableKind::Surface);
    match kind {
        TableKind::Surface => surface,
        TableKind::Folds => surface - tables_bytes(TableKind::Folds),
    }
}

/// Address of the flash's first byte.
const MAPPED: usize = 0x1000_0000;

/// The flash. While it is written or erased nothing runs, not even interrupts: it holds the code.
pub type Flash = flash::Flash<'static, FLASH, Blocking, BYTES>;

/// The flash with a watchdog that is fed before each step: erasing a sector may take 0.4 s.
pub struct FedFlash<'a> {
    /// The flash.
    pub flash: &'a mut Flash,
    /// The watchdog.
    pub watchdog: &'a mut Watchdog,
}

impl FedFlash<'_> {
    /// Opens the settings.
    pub fn store(self) -> Result<Store<Self>, StoreError> {
        Store::new(self, SECTORS)
    }

    /// Opens the tables of a kind.
    pub fn tables(self, kind: TableKind) -> Result<Tables<Self>, StoreError> {
        Tables::new(self, tables_start(kind), kind)
    }

    /// Stores the levels of outputs for the next start.
    pub fn keep_levels(&mut self, levels: Levels) -> Result<Saved, StoreError> {
        keep_levels(self, LEVELS, levels)
    }
}

/// A table, where it lies.
pub fn in_place(table: Range<u32>) -> &'static [u8] {
    // SAFETY: `Tables` gives ranges of the flash, which is mapped from that address on, and writes only to
    // the half that holds no table in force. The board refers to no other table.
    #[allow(unsafe_code)]
    unsafe {
        core::slice::from_raw_parts((MAPPED + table.start as usize) as *const u8, table.len())
    }
}

impl ErrorType for FedFlash<'_> {
    type Error = Error;
}

impl ReadNorFlash for FedFlash<'_> {
    const READ_SIZE: usize = READ_SIZE;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Error> {
        self.flash.blocking_read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        BYTES
    }
}

impl NorFlash for FedFlash<'_> {
    const WRITE_SIZE: usize = WRITE_SIZE;
    const ERASE_SIZE: usize = ERASE_SIZE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Error> {
        self.watchdog.feed(WATCHDOG);
        self.flash.blocking_erase(from, to)
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Error> {
        self.watchdog.feed(WATCHDOG);
        self.flash.blocking_write(offset, bytes)
    }
}
