//! Reading the garment: a scan plan goes in, a frame of raw codes by taxel number comes out.
//!
//! [`Acquire`] is what the board's loop calls. [`MuxScan`] is its portable implementation over embedded-hal
//! pins; a board with DMA brings its own, whose tables are made of a [`Sweep`] and whose frames lie in a
//! [`Ring`].

mod addresses;
mod duration;
mod fields;
mod lines;
mod mux;
mod plan;
mod ring;
mod rounds;
mod sweep;

pub use addresses::Read;
pub use duration::{
    LONGEST_MS, TooLong, WATCHDOG_MS, check_duration, longest_frame_us, longest_self_test_us,
};
pub use fields::{FIELDS, Fields};
pub use lines::{Lines, Pad, Pull, PulledAdc};
pub use mux::{Adc, Clock, MuxScan};
pub use plan::{Depth, Plan};
pub use ring::{Lent, PLACES, Ring, TURN_PLACES};
pub use rounds::{CONVERSION_CLOCKS, CONVERSION_NS, Rounds, frame_us};
pub use sweep::{SWEEP_ADDRESSES, SWEEP_INPUTS, SWEEP_STRETCHES, Stretch, Sweep, Unfit};

use crate::format::{Celsius, Code, Micros};
use crate::garment::Circuit;
use crate::reflex::{Early, Reflexes};
use core::fmt;

/// One finished scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scan<'a> {
    /// Raw codes by taxel number; taxels that the plan leaves out keep their last code.
    pub codes: &'a [Code],
    /// When and how it was read.
    pub report: ScanReport,
}

/// When and how a frame was read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ScanReport {
    /// Start of the scan.
    pub start: Micros,
    /// Time from the first address to the last sample, microseconds.
    pub duration_us: u32,
    /// Frames that the converter produced and nobody fetched in time, since the last report.
    pub overruns: u32,
    /// How warm the converter is; none: it has no thermometer.
    pub temperature: Option<Celsius>,
}

/// Why a scan failed. The frame is dropped; nothing else is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScanError {
    /// A line could not be driven, or not be looked at.
    Output(u8),
    /// A select line could not be driven.
    Line {
        /// GPIO number
        pin: u8,
        /// number of the taxel that was to be selected
        taxel: u16,
    },
    /// The converter did not deliver.
    Converter {
        /// GPIO number of the input
        input: u8,
        /// number of the taxel that was being read
        taxel: u16,
    },
    /// The converter, which runs by itself, reported a failed conversion.
    Conversion,
    /// The converter, which runs by itself, has made no frame in time: the scan begins anew.
    Stalled,
    /// Samples were lost, so that those after them belong to other taxels: the scan begins anew.
    OutOfStep,
    /// The garment has no pin of that number on this board.
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

/// What reads a garment.
#[allow(async_fn_in_trait)] // one board, one executor: nobody needs the future to be Send
pub trait Acquire {
    /// Reads the blocks of `plan` once.
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError>;

    /// Puts a pin that is no select line to a level.
    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError>;

    /// Stops what reads the garment by itself, until the next scan: something else needs the processor, the
    /// lines or the memory, or the circuit changes, which it does at no other time. Has no effect on what
    /// only works when it is asked to.
    fn rest(&mut self) {}

    /// What is to be watched in each sub-field from now on; none: nothing, for now. As
    /// [`Reflex::watch`](crate::reflex::Reflex::watch) says. Nothing is watched by what reads whole frames
    /// only.
    fn watch(&mut self, _reflexes: Option<&Reflexes>, _active: u8, _limit: impl Fn(u16) -> Option<u16>) {}

    /// The next reflex that has begun and was not told yet.
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
