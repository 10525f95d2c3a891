//! Pins, delay and clock of the simulated board, on a common virtual time. Nothing sleeps.

use super::act::Act;
use super::pads::{self, Drive};
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{ErrorType, OutputPin};
use std::cell::{Cell, RefCell};
use std::convert::Infallible;
use std::rc::Rc;
use taxel_core::acquire::{Clock, ProbePin, Pull};
use taxel_core::format::Micros;
use taxel_core::selftest::PinFault;

/// Most pins of the simulated board: GPIO 0 to 63.
pub const PINS: usize = 64;

/// Durations in a scan by the processor. Those in a scan by a DMA chain are in
/// [`taxel_core::acquire::Rounds`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timing {
    /// One conversion, ns. The input is sampled at its start.
    pub conversion_ns: u32,
    /// True if the settling time is spent in whole conversions (rounded down, at least one); else it is
    /// waited for exactly.
    pub in_slots: bool,
}

impl Timing {
    /// Timing of the reference board's chain at its shipped settling: 500 kS/s, settling in slots. The
    /// reference garment takes 512 (1 + 4) conversions = 5.12 ms: 195 frames per second.
    pub const REFERENCE: Timing = Timing { conversion_ns: 2_000, in_slots: true };
    /// A waiting loop: 512 (3 us + 4 conversions) = 5.632 ms for the reference garment.
    pub const LOOP: Timing = Timing { conversion_ns: 2_000, in_slots: false };

    /// Time from a change of the select lines to the first sample, ns.
    pub fn settling_ns(&self, garment_ns: u32) -> u32 {
        if !self.in_slots || garment_ns == 0 || self.conversion_ns == 0 {
            return garment_ns;
        }
        (garment_ns / self.conversion_ns).max(1).saturating_mul(self.conversion_ns)
    }
}

/// State shared by the parts of the board.
#[derive(Debug, Default)]
pub(super) struct Bus {
    /// Levels, bit `n` for GPIO `n`.
    pub levels: Cell<u64>,
    pub drive: Cell<Drive>,
    /// Faults of the wires, and the time at which they begin, ns.
    pub faults: RefCell<(u64, Vec<PinFault>)>,
    pub now_ns: Cell<u64>,
    /// Time of the last change of a level.
    pub changed_ns: Cell<u64>,
    /// Acts of a hand since the last sample.
    pub acts: RefCell<Vec<Act>>,
}

impl Bus {
    /// Changes what the board drives.
    pub fn act(&self, change: impl FnOnce(&mut Drive)) {
        let mut drive = self.drive.get();
        change(&mut drive);
        self.drive.set(drive);
        let now = self.with_faults(|faults| pads::levels(drive, faults));
        if now != self.levels.replace(now) {
            self.changed_ns.set(self.now_ns.get());
        }
    }

    /// Calls `look` with the present faults of the wires.
    pub fn with_faults<T>(&self, look: impl FnOnce(&[PinFault]) -> T) -> T {
        let (from_ns, faults) = &*self.faults.borrow();
        look(if self.now_ns.get() >= *from_ns { faults } else { &[] })
    }

    pub fn pass(&self, ns: u64) {
        self.now_ns.set(self.now_ns.get().saturating_add(ns));
    }
}

/// An output pin.
#[derive(Debug, Clone)]
pub struct SimPin {
    pub(super) bus: Rc<Bus>,
    pub(super) mask: u64,
}

impl ErrorType for SimPin {
    type Error = Infallible;
}

impl SimPin {
    fn set(&self, high: u64) {
        self.bus.act(|drive| {
            drive.on |= self.mask;
            drive.high = drive.high & !self.mask | high & self.mask;
        });
    }
}

impl OutputPin for SimPin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.set(0);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.set(u64::MAX);
        Ok(())
    }
}

impl ProbePin for SimPin {
    fn release(&mut self, pull: Pull) -> Result<(), Infallible> {
        self.bus.act(|drive| {
            drive.on &= !self.mask;
            drive.pull(self.mask, pull);
        });
        Ok(())
    }

    fn level(&mut self) -> Result<bool, Infallible> {
        Ok(self.bus.levels.get() & self.mask != 0)
    }
}

/// Advances virtual time.
#[derive(Debug, Clone)]
pub struct SimDelay {
    pub(super) bus: Rc<Bus>,
    pub(super) timing: Timing,
}

impl DelayNs for SimDelay {
    fn delay_ns(&mut self, ns: u32) {
        self.bus.pass(u64::from(self.timing.settling_ns(ns)));
    }
}

/// The board's clock; clones show the same time.
#[derive(Debug, Clone)]
pub struct SimClock {
    pub(super) bus: Rc<Bus>,
}

impl SimClock {
    /// Idles until this time, us since the board's start; no effect if it has passed.
    pub fn advance_to(&self, us: u64) {
        let ns = us.saturating_mul(1000);
        self.bus.now_ns.set(self.bus.now_ns.get().max(ns));
    }

    /// Time since the board's start, ns.
    pub fn now_ns(&self) -> u64 {
        self.bus.now_ns.get()
    }

    /// Levels of the outputs, bit `n` for GPIO `n`.
    pub fn levels(&self) -> u64 {
        self.bus.levels.get()
    }
}

impl Clock for SimClock {
    fn now(&self) -> Micros {
        Micros(self.now_ns() / 1000)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timings_are_those_of_the_boards() {
        assert_eq!(512 * (Timing::REFERENCE.settling_ns(3_000) + 4 * 2_000), 5_120_000);
        assert_eq!(512 * (Timing::LOOP.settling_ns(3_000) + 4 * 2_000), 5_632_000);
        assert_eq!(Timing::REFERENCE.settling_ns(0), 0);
        assert_eq!(Timing::REFERENCE.settling_ns(20_000), 20_000);
    }
}
