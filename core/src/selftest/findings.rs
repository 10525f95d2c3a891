//! What a self-test has found.

use core::fmt;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Most faults that are told; a garment with more has others to be mended first.
pub const FAULTS: usize = 12;

/// What is wrong with a line or an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// a line that is high, whatever drives it
    StuckHigh,
    /// a line that is low, whatever drives it
    StuckLow,
    /// a line that is connected to another one: its GPIO number
    Bridged(u8),
    /// an input to which nothing is connected
    Open,
    /// an input that is connected to ground
    Grounded,
    /// an input that is connected to the supply
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

/// A pin that is not well.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PinFault {
    /// GPIO number.
    pub pin: u8,
    /// What is wrong.
    pub fault: Fault,
}

/// What was examined and found.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Findings {
    /// Select lines that were examined.
    pub lines: u8,
    /// Converter inputs that were examined.
    pub inputs: u8,
    /// Lines in the order of the wiring, then inputs. Of two lines that are bridged the first one is named;
    /// at most [`FAULTS`], those beyond are left out.
    pub faults: Vec<PinFault, FAULTS>,
}

impl Findings {
    pub(super) fn add(&mut self, pin: u8, fault: Fault) {
        let _ = self.faults.push(PinFault { pin, fault });
    }
}
