//! What is fixed by a board.

use crate::garment::Pins;

/// What is fixed by the board itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BoardInfo {
    /// Name and version of the firmware.
    pub firmware: &'static str,
    /// Pins that it brings out.
    pub pins: Pins,
    /// Largest code of its converter.
    pub full_scale: u16,
    /// What its link carries, bytes a second.
    pub link_bytes_per_s: u32,
}

impl BoardInfo {
    /// The board that ships, with its garment's codes of 12 bits and its link at 921,600 Bd; the firmware and
    /// a host that checks files for it know it from here.
    pub const fn feather(firmware: &'static str) -> BoardInfo {
        BoardInfo { firmware, pins: Pins::FEATHER, full_scale: 4095, link_bytes_per_s: 92_160 }
    }
}
