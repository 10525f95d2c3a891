//! What a converter that never waits reads: the select lines' levels in the order of the scan, and where the
//! codes of each input go. A board whose DMA reads the garment turns this into its tables.

use super::Plan;
use super::addresses::{self, Inputs, Read};
use crate::garment::Circuit;
use core::fmt;
use heapless::Vec;

/// Most converter inputs of a sweep.
pub const SWEEP_INPUTS: usize = 4;

/// Addresses for which the reference board has room: as many as 2,048 taxels take on four inputs.
pub const SWEEP_ADDRESSES: usize = 512;
/// Stretches for which it has room: one for each row of 16 blocks.
pub const SWEEP_STRETCHES: usize = 64;

/// Addresses that follow each other, and so do, at every input, the numbers of the taxels read there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// Index of its first address in [`Sweep::levels`].
    pub first: u16,
    /// Taxels at that address, by the position of their input in [`Sweep::inputs`]; none where an input reads
    /// nothing in the whole stretch, which then lies within one row or column of a block (256 addresses at
    /// most).
    pub taxels: Read,
}

/// Why a plan cannot be read in one sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfit {
    /// The plan reads fewer than two addresses.
    Small,
    /// It reads more than [`SWEEP_INPUTS`] inputs.
    Inputs,
    /// A select line is on a pin past GPIO 31.
    Line(u8),
    /// It reads more addresses than there is room for.
    Addresses(usize),
    /// The taxels jump more often than there is room for.
    Stretches(usize),
    /// A frame is as short as a part of it should be: nothing is gained by interlacing it.
    Short,
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
        }
    }
}

impl core::error::Error for Unfit {}

/// The sweep of a plan: up to ADDRESSES addresses in up to STRETCHES stretches, of which there are at least
/// two.
#[derive(Debug)]
pub struct Sweep<const ADDRESSES: usize, const STRETCHES: usize> {
    inputs: Inputs,
    levels: Vec<u32, ADDRESSES>,
    stretches: Vec<Stretch, STRETCHES>,
}

impl<const ADDRESSES: usize, const STRETCHES: usize> Sweep<ADDRESSES, STRETCHES> {
    /// Reads nothing.
    pub const fn new() -> Self {
        Sweep { inputs: Vec::new(), levels: Vec::new(), stretches: Vec::new() }
    }

    /// Works out the sweep of a plan. After an error nothing of it is to be used.
    pub fn fill(&mut self, circuit: &Circuit, plan: &Plan) -> Result<(), Unfit> {
        self.inputs.clear();
        self.levels.clear();
        self.stretches.clear();
        self.inputs = addresses::inputs(circuit, plan)?;
        let mut last = [None; SWEEP_INPUTS];
        addresses::each(circuit, plan, |address| {
            let here = address.taxels(&self.inputs);
            let goes_on = last.iter().zip(&here).take(self.inputs.len()).all(|pair| match pair {
                (Some(last), Some(here)) => last + 1 == *here,
                (None, None) => address.point > 0,
                _ => false,
            });
            last = here;
            self.add(address.levels(), here, goes_on)
        })?;
        self.split()
    }

    fn add(&mut self, levels: u32, taxels: Read, goes_on: bool) -> Result<(), Unfit> {
        let first = self.levels.len() as u16;
        if !goes_on || first == 0 {
            let stretch = Stretch { first, taxels };
            self.stretches.push(stretch).map_err(|_| Unfit::Stretches(STRETCHES))?;
        }
        self.levels.push(levels).map_err(|_| Unfit::Addresses(ADDRESSES))
    }

    /// Makes two stretches of a single one.
    fn split(&mut self) -> Result<(), Unfit> {
        let half = (self.levels.len() / 2) as u16;
        if half == 0 {
            return Err(Unfit::Small);
        }
        if let [whole] = self.stretches.as_slice() {
            let second = Stretch { first: half, taxels: whole.taxels.map(|t| t.map(|taxel| taxel + half)) };
            self.stretches.push(second).map_err(|_| Unfit::Stretches(STRETCHES))?;
        }
        Ok(())
    }

    /// GPIO numbers of the converter inputs that are read at each address, ascending.
    pub fn inputs(&self) -> &[u8] {
        &self.inputs
    }

    /// Levels of the select lines by address, bit `n` for GPIO `n`.
    pub fn levels(&self) -> &[u32] {
        &self.levels
    }

    /// Where the codes go.
    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }
}

impl<const ADDRESSES: usize, const STRETCHES: usize> Default for Sweep<ADDRESSES, STRETCHES> {
    fn default() -> Self {
        Self::new()
    }
}
