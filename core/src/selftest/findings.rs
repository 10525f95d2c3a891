//! Results of a self-test.

use core::fmt;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Most faults reported; a garment with more has these to be mended first.
pub const FAULTS: usize = 12;

/// Fault of a line or an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// a line that stays high at whatever level it is driven
    StuckHigh,
    /// a line that stays low at whatever level it is driven
    StuckLow,
    /// a line connected to another one, of this GPIO number
    Bridged(u8),
    /// an input that is not connected
    Open,
    /// an input shorted to ground
    Grounded,
    /// an input shorted to the supply
    Supplied,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::StuckHigh => write!(f, "stuck high"),
            Fault::StuckLow => write!(f, "stuck low"),
            Fault::Bridged(other) => write!(f, "bridged to GPIO {other}"),
            Fault::Open => write!(f, "open"),
            Fault::Grounded => write!(f, "shorted to ground"),
            Fault::Supplied => write!(f, "shorted to the supply"),
        }
    }
}

/// A faulty pin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PinFault {
    /// GPIO number.
    pub pin: u8,
    /// Fault of the pin.
    pub fault: Fault,
}

/// Lines and inputs that were examined, and the faults found.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Findings {
    /// Select lines that were examined.
    pub lines: u8,
    /// Converter inputs that were examined.
    pub inputs: u8,
    /// Faults of lines in the order of the wiring, then of inputs. Of two bridged lines the first is named.
    /// Those beyond [`FAULTS`] are left out.
    pub faults: Vec<PinFault, FAULTS>,
}

impl Findings {
    pub(super) fn add(&mut self, pin: u8, fault: Fault) {
        let _ = self.faults.push(PinFault { pin, fault });
    }
}
