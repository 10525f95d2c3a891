//! Limits of what the board can hold and connect.

use taxel_core::board::BoardInfo;

/// Limits for garments and scenes, equal on the board and on a host.
pub const INFO: BoardInfo = BoardInfo::feather(concat!("taxel ", env!("CARGO_PKG_VERSION")));

/// Number of converter inputs, from GP26 on.
pub const INPUTS: usize = INFO.pins.inputs.count_ones() as usize;

/// Number of pins for select lines and reactions.
pub const LINES: usize = INFO.pins.outputs.count_ones() as usize;
