//! Reasons why a plan cannot be read by a free-running converter.

use crate::format::LEFT_OUT;
use core::fmt;

/// Most converter inputs of a sweep.
pub const SWEEP_INPUTS: usize = 4;

/// Reason why a plan cannot be read in one sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfit {
    /// The plan reads fewer than two addresses.
    Small,
    /// The plan reads more than [`SWEEP_INPUTS`] inputs.
    Inputs,
    /// A select line is on a pin past GPIO 31.
    Line(u8),
    /// The plan reads more addresses than there is room for.
    Addresses(usize),
    /// Taxel numbers are not consecutive more often than there is room for.
    Stretches(usize),
    /// The whole frame is shorter than two sub-fields may be: interlacing it gains nothing.
    Short,
    /// This build leaves interlaced scans out.
    LeftOut,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unfit::Small => write!(f, "fewer than two addresses are read"),
            Unfit::Inputs => write!(f, "more than {SWEEP_INPUTS} converter inputs are read"),
            Unfit::Line(pin) => write!(f, "the select line on pin {pin} is out of reach"),
            Unfit::Addresses(room) => write!(f, "more than {room} addresses are read"),
            Unfit::Stretches(room) => write!(f, "the taxels jump more than {room} times"),
            Unfit::Short => write!(f, "a frame of less than 200 us is not interlaced"),
            Unfit::LeftOut => write!(f, "it {LEFT_OUT}"),
        }
    }
}

impl core::error::Error for Unfit {}
