//! The USB port as a link.

use super::rings::{OPENED, PACKETS, RECEIVED, SENT};
use super::{device, packets, starts};
use core::sync::atomic::Ordering;
use embassy_rp::{peripherals::USB, usb};
use embassy_time::Instant;
use taxel_core::run::Link;
use taxel_core::wire::StartOfFrame;

/// Number of bytes copied at a time, with interrupts off: for less than 10 us.
const PIECE: usize = 256;

/// Time without a packet taken after which the host counts as not reading.
const PATIENCE_MS: u64 = 2_000;

/// The port.
pub struct Usb {
    /// Number of packets at the last check.
    packets: u32,
    /// Last time at which the host took one, or nothing was queued.
    moved: Instant,
}

impl Usb {
    /// Attaches the board to the bus, with its serial number if it has one. Must be called once.
    pub fn start(driver: usb::Driver<'static, USB>, number: Option<&'static str>) -> Usb {
        device::start(driver, number);
        Usb { packets: 0, moved: Instant::now() }
    }

    /// True if a program has opened the port and reads from it. A program that does not read must not keep
    /// the board from using the other link.
    pub fn is_read(&mut self) -> bool {
        let (open, packets) = (OPENED.get(), PACKETS.load(Ordering::Relaxed));
        let was_read = self.moved.elapsed().as_millis() < PATIENCE_MS;
        // Once it counts as not reading, only a taken packet proves the contrary.
        let moves = core::mem::replace(&mut self.packets, packets) != packets;
        if !open || moves || (was_read && SENT.is_empty()) {
            self.moved = Instant::now();
        }
        open && (was_read || moves)
    }

    /// Empties both rings.
    pub fn forget(&mut self) {
        SENT.clear();
        RECEIVED.clear();
    }
}

impl Link for Usb {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        RECEIVED.try_read(buffer).unwrap_or(0)
    }

    fn try_write(&mut self, bytes: &[u8]) -> usize {
        let mut given = 0;
        // The ring accepts only the bytes up to its end, hence the rounds.
        while let Some(piece) = bytes.get(given..bytes.len().min(given + PIECE)) {
            match SENT.try_write(piece) {
                Ok(count) if count > 0 => given += count,
                _ => break,
            }
        }
        packets::begin();
        given
    }

    fn start_of_frame(&mut self, next: bool) -> Option<StartOfFrame> {
        starts::take(next)
    }
}
