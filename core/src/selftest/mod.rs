//! The self-test of the select lines and the converter inputs, by the pins' own weak resistors.
//!
//! | fault | what shows it |
//! |---|---|
//! | line stuck high, stuck low | driven alone, it does not show the level that it is driven to |
//! | line bridged | while another line is driven, it follows that one to both levels, pulled against it |
//! | input open | it follows its own resistor, whatever is selected |
//! | input at ground, at the supply | it stays there against its resistor, whatever is selected |
//!
//! A line is tried with all others released and pulled, 0.1 ms for each level; an input at the corners of
//! each of its blocks, pulled up and pulled down. The reference garment takes 2.6 ms (simulated): one frame
//! is not scanned.
//!
//! While the board runs, the levels of the lines are looked at, and so are the codes of the inputs: what
//! speaks against one of them makes the board examine them all again ([`Examine::is_misled`],
//! `board/doubt.rs`, `health/inputs.rs`).
//!
//! What cannot be told: a line that is broken between the board and the multiplexers shows nothing at its
//! pin; a source of less than 0.4 kOhm that rests at ground all over looks like an input at ground. What
//! reacts to the select lines sees levels that nobody asked for; outputs of reactions are not touched.

mod findings;
mod inputs;
mod lines;

pub use findings::{FAULTS, Fault, Findings, PinFault};

use crate::acquire::{Clock, MuxScan, Pad, PulledAdc, ScanError};
use crate::garment::Circuit;
use embedded_hal::delay::DelayNs;

/// What can examine its own lines and inputs. It does not scan meanwhile.
pub trait Examine {
    /// Examines all lines and inputs of a circuit; an error says what failed before the end.
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError>;

    /// Between two scans: drives the select lines to some address, another one each time, at which
    /// [`Examine::is_misled`] looks at them. What looks at them while it scans need not.
    fn pose(&mut self, _circuit: &Circuit) {}

    /// Whether a select line showed another level than it was driven to, since this was asked last.
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
    P: Pad,
    D: DelayNs,
    A: PulledAdc,
    C: Clock,
{
    // Not inlined: what it keeps is on the stack only meanwhile.
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
