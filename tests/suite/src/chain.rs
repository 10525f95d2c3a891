//! The whole chain: a board that gets codes, and whose messages are read at once.

use crate::folds::FOLDS;
use crate::surface::TABLE;
use crc::{CRC_32_ISO_HDLC, Crc, Table};
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, SetupError, Shipped, TableKind};
pub use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::pipeline::{Probe, Stage};
use taxel_core::scene::Scene;
use taxel_core::wire::Checksum;

/// Time from scan to scan, us: 195 frames a second.
pub const PERIOD_US: u64 = 5_128;

/// Largest code of the converter.
pub const FULL_SCALE: u16 = 4095;

/// A `static`: a `const` would copy the table to the stack.
static CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// A board without pins, whose link takes everything at once.
pub struct Chain {
    board: Shipped,
    scans: u64,
}

/// Output of a board since the last call.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Said {
    /// Number of bytes on the wire.
    pub bytes: u32,
    /// CRC-32/ISO-HDLC of them: images, contacts, shapes, symbols and intentions in the order of sending.
    pub digest: u32,
}

impl Chain {
    /// A board without a garment, built in the caller's place.
    #[inline(never)]
    pub fn bare() -> Chain {
        let info = BoardInfo {
            firmware: "bench",
            chip: "",
            pins: Pins::ANY,
            full_scale: FULL_SCALE,
            link_bytes_per_s: u32::MAX,
        };
        Chain { board: Shipped::bare(info), scans: 0 }
    }

    /// Sets the reference garment with a surface, and the shipped scene.
    #[inline(never)]
    pub fn ship(&mut self) -> Result<(), SetupError> {
        self.board.set_garment(Garment::reference())?;
        self.board.recall_table(TableKind::Surface, Some(&TABLE.0));
        self.board.set_scene(Scene::shipped())
    }

    /// Puts the table of folds in force, or none.
    pub fn fold(&mut self, on: bool) {
        self.board.recall_table(TableKind::Folds, on.then_some(&FOLDS.0[..]));
    }

    fn now(&self) -> Micros {
        Micros(self.scans * PERIOD_US)
    }

    /// Receives bytes from the host.
    pub fn receive(&mut self, bytes: &[u8]) -> Said {
        let now = self.now();
        self.board.step(now, Input::Received(bytes), &mut ());
        self.drain(&mut (), |_| ())
    }

    /// Processes a finished scan; the bytes that the board sends also go to `link`. `probe` gets the stages
    /// of the board; [`Stage::Scan`] stands for everything outside of it.
    pub fn scanned(
        &mut self,
        codes: &[Code],
        probe: &mut (impl Probe + Checksum),
        link: impl FnMut(&[u8]),
    ) -> Said {
        self.scans += 1;
        let now = self.now();
        let report = ScanReport { start: now, duration_us: 0, overruns: 0, temperature: None };
        probe.begin(Stage::Idle);
        self.board.step(now, Input::Scanned(Ok(Scan { codes, report })), probe);
        let said = self.drain(probe, link);
        probe.begin(Stage::Scan);
        said
    }

    /// Takes all pending bytes.
    fn drain(&mut self, probe: &mut (impl Probe + Checksum), mut link: impl FnMut(&[u8])) -> Said {
        let now = self.now();
        let (mut digest, mut bytes) = (CRC.digest(), 0);
        loop {
            let pending = self.board.pending(now, probe);
            probe.begin(Stage::Scan);
            digest.update(pending);
            link(pending);
            let count = pending.len();
            probe.begin(Stage::Idle);
            if count == 0 {
                return Said { bytes, digest: digest.finalize() };
            }
            bytes += count as u32;
            self.board.sent(count);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_ships_fits() {
        assert_eq!(Chain::bare().ship(), Ok(()));
    }
}
