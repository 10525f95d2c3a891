//! Scans at the pace of real time, and of a host that reads.

use super::beside::yielded;
use super::pipe::BoardEnd;
use crate::sim::SimClock;
use crate::time::Instant;
use std::cell::Cell;
use std::time::Duration;
use taxel_core::acquire::{Acquire, Clock, Plan, Scan, ScanError};
use taxel_core::garment::Circuit;
use taxel_core::reflex::{Early, Reflexes};
use taxel_core::selftest::{Examine, Findings};

/// Lag behind real time beyond which a simulation gives up catching up.
const LAG: Duration = Duration::from_millis(250);

/// Pacing of a simulated board.
pub(super) struct Pacing<'a> {
    link: &'a BoardEnd,
    clock: SimClock,
    /// Real time at which the board's time was 0; none if it may run ahead.
    origin: Cell<Option<Instant>>,
}

impl<'a> Pacing<'a> {
    /// The pace of a board that starts now, in real time or ahead of it.
    pub fn new(link: &'a BoardEnd, clock: SimClock, realtime: bool) -> Pacing<'a> {
        Pacing { link, clock, origin: Cell::new(realtime.then(Instant::now)) }
    }

    /// Waits until real time has come as far as the board's, and the host has room for what the board sends.
    pub async fn wait(&self) {
        yielded().await;
        self.link.room().await;
        while self.is_early() {
            yielded().await;
        }
    }

    /// True if the board is ahead of real time, after sleeping for as long as that.
    fn is_early(&self) -> bool {
        let Some(origin) = self.origin.get() else { return false };
        let (due, passed) = (Duration::from_micros(self.clock.now().0), origin.elapsed());
        if due > passed {
            self.link.sleep(due - passed);
        } else if passed - due > LAG {
            self.origin.set(Some(origin + (passed - due)));
        }
        origin.elapsed() < due && !self.link.is_alone()
    }
}

/// Scans that wait for their time.
pub(super) struct Paced<'a, A> {
    scan: A,
    pace: &'a Pacing<'a>,
}

impl<'a, A> Paced<'a, A> {
    /// These scans at this pace.
    pub fn new(scan: A, pace: &'a Pacing<'a>) -> Paced<'a, A> {
        Paced { scan, pace }
    }
}

impl<A: Acquire> Acquire for Paced<'_, A> {
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError> {
        self.pace.wait().await;
        self.scan.scan(circuit, plan).await
    }

    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        self.scan.drive(pin, level)
    }

    fn rest(&mut self) {
        self.scan.rest();
    }

    fn watch(&mut self, reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
        self.scan.watch(reflexes, active, limit);
    }

    fn reflex(&mut self) -> Option<Early> {
        self.scan.reflex()
    }
}

impl<A: Examine> Examine for Paced<'_, A> {
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        self.scan.examine(circuit)
    }

    fn pose(&mut self, circuit: &Circuit) {
        self.scan.pose(circuit);
    }

    fn is_misled(&mut self) -> bool {
        self.scan.is_misled()
    }
}
