//! The rings of the USB port. Tasks of a higher priority fill and empty them, so that perception does not
//! delay the bus.

use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use embassy_sync::{blocking_mutex::raw::CriticalSectionRawMutex, pipe::Pipe};

/// Number of bytes queued for the host: 2 ms of the bus, and a frame of 40 contacts.
const TO_HOST: usize = 2560;
/// Number of bytes queued from the host, four packets. While they are full, the host must wait.
const FROM_HOST: usize = 256;

/// A ring.
pub(super) type ByteRing<const N: usize> = Pipe<CriticalSectionRawMutex, N>;

pub(super) static SENT: ByteRing<TO_HOST> = ByteRing::new();
pub(super) static RECEIVED: ByteRing<FROM_HOST> = ByteRing::new();

/// State of the port: open if a program has opened it, and the cable was not pulled nor the host suspended
/// since.
pub(super) struct Opened {
    ready: AtomicBool,
    asleep: AtomicBool,
}

pub(super) static OPENED: Opened = Opened { ready: AtomicBool::new(false), asleep: AtomicBool::new(false) };

impl Opened {
    /// Sets whether the terminal is ready, by its line DTR.
    pub fn set_ready(&self, ready: bool) {
        self.ready.store(ready, Ordering::Relaxed);
    }

    /// Sets whether the bus is idle: the host is suspended or gone.
    pub fn set_asleep(&self, asleep: bool) {
        self.asleep.store(asleep, Ordering::Relaxed);
    }

    /// True if the port is open.
    pub fn get(&self) -> bool {
        self.ready.load(Ordering::Relaxed) && !self.asleep.load(Ordering::Relaxed)
    }
}

/// Number of packets that the host has taken.
pub(super) static PACKETS: AtomicU32 = AtomicU32::new(0);
