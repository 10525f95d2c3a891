//! Parts of a board for the firmware.

use crate::limits::{INPUTS, LINES};
use crate::{
    adc::Converter, led::Led, link::Wire, pins::LinePin, scan::DmaChain, sniffer::Sniffer, store::Flash,
};
use embassy_rp::watchdog::Watchdog;

/// Parts of a board, as its pins are assigned.
pub struct BoardParts {
    /// Unique id of the flash chip, in hexadecimal; empty without one.
    pub chip: &'static str,
    /// Pins for select lines of garments and reactions of scenes, with their GPIO numbers.
    pub lines: [(u8, LinePin); LINES],
    /// The converter inputs from GPIO 26 on.
    pub converter: Converter<INPUTS>,
    /// DMA and PIO for the scan.
    pub chain: DmaChain,
    /// DMA for checksums.
    pub sniffer: Sniffer,
    /// The link to the host.
    pub wire: Wire,
    /// The heartbeat.
    pub led: Led,
    /// The watchdog, not yet started.
    pub watchdog: Watchdog,
    /// The flash, whose last sectors hold the settings.
    pub flash: Flash,
}
