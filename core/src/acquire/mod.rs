//! Reading the garment: from a scan plan to a frame of raw codes by taxel number.
//!
//! The board's loop calls [`Acquire`]. [`MuxScan`] implements it for embedded-hal pins. A board with DMA has
//! its own implementation, with tables made from a [`Sweep`] and frames in a [`Ring`].

mod adc;
mod addresses;
mod duration;
mod fields;
mod lines;
mod mux;
mod plan;
mod reflex;
mod ring;
mod rounds;
mod sweep;
mod unfit;

pub use adc::{Adc, PulledAdc};
pub use addresses::Read;
pub use duration::{
    FrameTooLong, LONGEST_MS, WATCHDOG_MS, check_duration, longest_frame_us, longest_self_test_us,
};
pub use fields::{FIELDS, Fields};
pub use lines::{Lines, ProbePin, Pull};
pub use mux::{Clock, Mux, MuxScan};
pub use plan::{Depth, Plan};
pub use reflex::Reflex;
pub use ring::{Lent, PLACES, Ring, TURN_PLACES};
pub use rounds::{CONVERSION_CLOCKS, CONVERSION_NS, Rounds, frame_us};
pub use sweep::{SWEEP_ADDRESSES, SWEEP_STRETCHES, Sweep, SweepStretch};
pub use unfit::{SWEEP_INPUTS, Unfit};

use crate::format::{Celsius, Code, Micros};
use crate::garment::Circuit;
use crate::reflex::{Early, Reflexes};
use core::fmt;

/// One finished scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scan<'a> {
    /// Raw codes by taxel number; taxels outside the plan keep their last code.
    pub codes: &'a [Code],
    /// Time and conditions of the scan.
    pub report: ScanReport,
}

/// Time and conditions of a scan.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ScanReport {
    /// Start of the scan.
    pub start: Micros,
    /// Time from the first address to the last sample, microseconds.
    pub duration_us: u32,
    /// Complete frames since the last report that were overwritten before they were read.
    pub overruns: u32,
    /// Temperature of the converter; none without a thermometer.
    pub temperature: Option<Celsius>,
}

/// Reason why a scan failed. Only its frame is dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScanError {
    /// A pin with this GPIO number could not be driven or read.
    Output(u8),
    /// A select line could not be driven.
    Line {
        /// GPIO number
        pin: u8,
        /// number of the taxel being selected
        taxel: u16,
    },
    /// The converter delivered no sample.
    Converter {
        /// GPIO number of the input
        input: u8,
        /// number of the taxel being read
        taxel: u16,
    },
    /// A free-running converter reported a failed conversion.
    Conversion,
    /// A free-running converter made no frame in time; the scan restarts.
    Stalled,
    /// Samples were lost, so that later ones belong to other taxels; the scan restarts.
    OutOfStep,
    /// The board has no output pin of this number.
    NoPin(u8),
}

impl fmt::Display for ScanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ScanError::Output(pin) => write!(f, "pin {pin} cannot be driven"),
            ScanError::Line { pin, taxel } => {
                write!(f, "select line on pin {pin} cannot be driven (at taxel {taxel})")
            }
            ScanError::Converter { input, taxel } => {
                write!(f, "converter input on pin {input} gave no sample (at taxel {taxel})")
            }
            ScanError::Conversion => write!(f, "a conversion failed"),
            ScanError::Stalled => write!(f, "the converter stands still"),
            ScanError::OutOfStep => write!(f, "samples were lost"),
            ScanError::NoPin(pin) => write!(f, "this board has no output pin {pin}"),
        }
    }
}

impl core::error::Error for ScanError {}

/// Reader of a garment.
#[allow(async_fn_in_trait)] // one board, one executor: the future need not be Send
pub trait Acquire {
    /// Reads the blocks of `plan` once.
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError>;

    /// Sets the level of a pin that is no select line.
    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError>;

    /// Stops a free-running scan until the next [`Acquire::scan`]: something else needs the processor, the
    /// lines or the memory, or the circuit changes, which it does at no other time. No effect on readers that
    /// do not run freely.
    fn rest(&mut self) {}

    /// Sets what is checked in each sub-field from now on; none pauses the check. See
    /// [`Reflex::watch`]. No effect on readers of whole frames.
    fn watch(&mut self, _reflexes: Option<&Reflexes>, _active: u8, _limit: impl Fn(u16) -> Option<u16>) {}

    /// Returns the next reflex that has begun and was not returned yet.
    fn reflex(&mut self) -> Option<Early> {
        None
    }
}

impl<A: Acquire> Acquire for &mut A {
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError> {
        (**self).scan(circuit, plan).await
    }

    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        (**self).drive(pin, level)
    }

    fn rest(&mut self) {
        (**self).rest();
    }

    fn watch(&mut self, reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
        (**self).watch(reflexes, active, limit);
    }

    fn reflex(&mut self) -> Option<Early> {
        (**self).reflex()
    }
}
