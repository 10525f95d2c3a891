//! Fixed properties of a board.

use crate::garment::Pins;

/// Fixed properties of a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BoardInfo {
    /// Name and version of the firmware.
    pub firmware: &'static str,
    /// Unique id of the chip; empty without one.
    pub chip: &'static str,
    /// Pins that the board brings out.
    pub pins: Pins,
    /// Largest code of the converter.
    pub full_scale: u16,
    /// Throughput of the link, bytes per second.
    pub link_bytes_per_s: u32,
}

impl BoardInfo {
    /// The shipped board, with 12-bit codes and a link at 921,600 Bd. Defined here for the firmware and for a
    /// host that checks files for it.
    pub const fn feather(firmware: &'static str) -> BoardInfo {
        BoardInfo { firmware, chip: "", pins: Pins::FEATHER, full_scale: 4095, link_bytes_per_s: 92_160 }
    }
}
