//! Self-test of the select lines and the converter inputs, with the pins' own pull resistors.
//!
//! | fault | symptom |
//! |---|---|
//! | line stuck high, stuck low | driven alone, it is not at the level to which it is driven |
//! | line bridged | while another line is driven, it follows that one to both levels against its pull |
//! | input open | it follows its pull, whatever is selected |
//! | input at ground, at the supply | it stays there against its pull, whatever is selected |
//!
//! A line is tested with all others released and pulled, 0.1 ms for each level; an input at the corners of
//! each of its blocks, pulled up and pulled down. The reference garment takes 2.6 ms (simulated), so one
//! frame is not scanned.
//!
//! While the board runs, the levels of the lines and the codes of the inputs are monitored. Evidence against
//! one of them makes the board examine them all again ([`Examine::is_misled`], `board/retest.rs`,
//! `health/inputs.rs`).
//!
//! Limits: a line that is broken between the board and the multiplexers shows nothing at its pin. A source of
//! less than 0.4 kOhm that rests at ground all over looks like an input at ground. The test drives the select
//! lines to levels that no scan uses, which anything else connected to them sees. Outputs of reactions are
//! not touched.

mod findings;
mod inputs;
mod lines;

pub use findings::{FAULTS, Fault, Findings, PinFault};

use crate::acquire::{Clock, Mux, MuxScan, ProbePin, PulledAdc, ScanError};
use crate::garment::Circuit;
use embedded_hal::delay::DelayNs;

/// Self-test of a scanner's lines and inputs. No scan runs meanwhile.
pub trait Examine {
    /// Examines all lines and inputs of a circuit. The error says what stopped it.
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError>;

    /// Called between two scans: drives the select lines to some address, another one each time, at which
    /// [`Examine::is_misled`] reads them. Not needed by scanners that read them during the scan.
    fn pose(&mut self, _circuit: &Circuit) {}

    /// True if a select line was not at the level it was driven to, since the last call.
    fn is_misled(&mut self) -> bool;
}

impl<E: Examine> Examine for &mut E {
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        (**self).examine(circuit)
    }

    fn pose(&mut self, circuit: &Circuit) {
        (**self).pose(circuit);
    }

    fn is_misled(&mut self) -> bool {
        (**self).is_misled()
    }
}

impl<P, D, A, C, const PINS: usize, const TAXELS: usize> Examine for MuxScan<'_, P, D, A, C, PINS, TAXELS>
where
    P: ProbePin,
    D: DelayNs,
    A: PulledAdc,
    C: Clock,
{
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        self.mux().examine(circuit)
    }

    fn pose(&mut self, circuit: &Circuit) {
        self.mux().pose(circuit);
    }

    fn is_misled(&mut self) -> bool {
        self.mux().is_misled()
    }
}

impl<P, D, A, C, const PINS: usize> Examine for Mux<'_, P, D, A, C, PINS>
where
    P: ProbePin,
    D: DelayNs,
    A: PulledAdc,
    C: Clock,
{
    // Own frame: its stack is free again on return.
    #[inline(never)]
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        let (lines, delay, adc, clock) = self.parts();
        let mut findings = Findings::default();
        lines::examine(lines, delay, clock, circuit, &mut findings)?;
        inputs::examine(lines, delay, adc, clock, circuit, &mut findings)?;
        Ok(findings)
    }

    fn pose(&mut self, circuit: &Circuit) {
        self.pose_next(circuit);
    }

    fn is_misled(&mut self) -> bool {
        self.shows_another()
    }
}
