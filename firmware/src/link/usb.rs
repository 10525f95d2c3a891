//! The port that the board is for a host on USB: two rings, which tasks of a higher priority fill and empty,
//! so that perception does not hold up the bus.

use super::device;
use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use embassy_rp::{peripherals::USB, usb};
use embassy_sync::{blocking_mutex::raw::CriticalSectionRawMutex, pipe::Pipe};
use embassy_time::Instant;
use taxel_core::run::Link;

/// Bytes to the host that may wait: what the bus carries in 2 ms, and what a frame of 40 contacts takes.
const TO_HOST: usize = 2560;
/// Bytes from the host, four packets: when they are full, the host is made to wait.
const FROM_HOST: usize = 256;
/// Bytes that are copied at once, with interrupts off: for less than 10 us.
const PIECE: usize = 256;

/// A ring.
pub(super) type Ring<const N: usize> = Pipe<CriticalSectionRawMutex, N>;

pub(super) static SENT: Ring<TO_HOST> = Ring::new();
pub(super) static RECEIVED: Ring<FROM_HOST> = Ring::new();

/// A program has the port open: it has said so, and nobody has pulled the cable since or put the host to sleep.
pub(super) struct Opened {
    ready: AtomicBool,
    asleep: AtomicBool,
}

pub(super) static OPENED: Opened = Opened { ready: AtomicBool::new(false), asleep: AtomicBool::new(false) };

impl Opened {
    /// The terminal is ready, as it says by its line DTR.
    pub fn set_ready(&self, ready: bool) {
        self.ready.store(ready, Ordering::Relaxed);
    }

    /// Nothing moves on the bus: the host sleeps, or is no longer there.
    pub fn set_asleep(&self, asleep: bool) {
        self.asleep.store(asleep, Ordering::Relaxed);
    }

    fn get(&self) -> bool {
        self.ready.load(Ordering::Relaxed) && !self.asleep.load(Ordering::Relaxed)
    }
}

/// A host takes a packet within this time, or it is taken not to read.
const PATIENCE_MS: u64 = 2_000;

/// Packets that the host has taken, or refused.
pub(super) static PACKETS: AtomicU32 = AtomicU32::new(0);

/// The port.
pub struct Usb {
    /// Packets when they were looked at last.
    packets: u32,
    /// When the host last took one, or nothing waited.
    moved: Instant,
}

impl Usb {
    /// Attaches the board to the bus. Must be called once.
    pub fn start(driver: usb::Driver<'static, USB>) -> Usb {
        device::start(driver);
        Usb { packets: 0, moved: Instant::now() }
    }

    /// Whether a program has opened the port, and reads from it: one that does not must not keep the other
    /// link silent.
    pub fn is_read(&mut self) -> bool {
        let (open, packets) = (OPENED.get(), PACKETS.load(Ordering::Relaxed));
        let was_read = self.moved.elapsed().as_millis() < PATIENCE_MS;
        // Once it is taken not to read, only a packet that it takes shows otherwise.
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
        // A ring takes what goes in before its end, hence the rounds.
        while let Some(piece) = bytes.get(given..bytes.len().min(given + PIECE)) {
            match SENT.try_write(piece) {
                Ok(count) if count > 0 => given += count,
                _ => break,
            }
        }
        given
    }
}
