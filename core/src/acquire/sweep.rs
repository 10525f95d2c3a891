//! The scan of a free-running converter: levels of the select lines by address, and the taxels that each
//! input reads. A board whose DMA reads the garment makes its tables from this.

use super::Plan;
use super::addresses::{self, InputPins, Read};
use super::unfit::{SWEEP_INPUTS, Unfit};
use crate::garment::Circuit;
use heapless::Vec;

/// Most addresses of a sweep on the reference board: as many as 2,048 taxels take on four inputs.
pub const SWEEP_ADDRESSES: usize = 512;
/// Most stretches of a sweep on the reference board: one for each row of 16 blocks.
pub const SWEEP_STRETCHES: usize = 64;

/// Consecutive addresses at which every input reads consecutive taxels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SweepStretch {
    /// Index of its first address in [`Sweep::levels`].
    pub first: u16,
    /// Taxels at that address, by the position of their input in [`Sweep::inputs`]. None for an input that
    /// reads nothing in the whole stretch, which then lies within one row or column of a block (256 addresses
    /// at most).
    pub taxels: Read,
}

/// The sweep of a plan: up to ADDRESSES addresses in 2 to STRETCHES stretches.
#[derive(Debug)]
pub struct Sweep<const ADDRESSES: usize, const STRETCHES: usize> {
    inputs: InputPins,
    levels: Vec<u32, ADDRESSES>,
    stretches: Vec<SweepStretch, STRETCHES>,
}

impl<const ADDRESSES: usize, const STRETCHES: usize> Sweep<ADDRESSES, STRETCHES> {
    /// A sweep that reads nothing.
    pub const fn new() -> Self {
        Sweep { inputs: Vec::new(), levels: Vec::new(), stretches: Vec::new() }
    }

    /// Computes the sweep of a plan. After an error the sweep is incomplete and must not be used.
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
            let stretch = SweepStretch { first, taxels };
            self.stretches.push(stretch).map_err(|_| Unfit::Stretches(STRETCHES))?;
        }
        self.levels.push(levels).map_err(|_| Unfit::Addresses(ADDRESSES))
    }

    /// Splits a single stretch in two.
    fn split(&mut self) -> Result<(), Unfit> {
        let half = (self.levels.len() / 2) as u16;
        if half == 0 {
            return Err(Unfit::Small);
        }
        if let [whole] = self.stretches.as_slice() {
            let second =
                SweepStretch { first: half, taxels: whole.taxels.map(|t| t.map(|taxel| taxel + half)) };
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

    /// Stretches, in the order of the scan.
    pub fn stretches(&self) -> &[SweepStretch] {
        &self.stretches
    }
}

impl<const ADDRESSES: usize, const STRETCHES: usize> Default for Sweep<ADDRESSES, STRETCHES> {
    fn default() -> Self {
        Self::new()
    }
}
