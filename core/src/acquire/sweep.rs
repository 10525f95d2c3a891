//! What a converter that never waits reads: the select lines' levels in the order of the scan, and where the codes of
//! each input go. A board whose DMA reads the garment turns this into its tables.

use super::Plan;
use crate::garment::{Circuit, Site};
use core::fmt;
use heapless::Vec;

/// Most converter inputs of a sweep.
pub const SWEEP_INPUTS: usize = 4;

/// Addresses for which the reference board has room: as many as 2,048 taxels take on four inputs.
pub const SWEEP_ADDRESSES: usize = 512;
/// Stretches for which it has room: one for each row of 16 blocks.
pub const SWEEP_STRETCHES: usize = 64;

/// Taxels that a sweep reads at one address, by the position of their input in [`Sweep::inputs`].
type Read = [Option<u16>; SWEEP_INPUTS];

/// Addresses that follow each other, and so do, at every input, the numbers of the taxels read there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// Index of its first address in [`Sweep::levels`].
    pub first: u16,
    /// Taxels at that address, by the position of their input in [`Sweep::inputs`]; none where an input reads nothing
    /// in the whole stretch, which then lies within one row or column of a block (256 addresses at most).
    pub taxels: [Option<u16>; SWEEP_INPUTS],
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
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unfit::Small => write!(f, "fewer than two addresses are read"),
            Unfit::Inputs => write!(f, "more than {SWEEP_INPUTS} converter inputs are read"),
            Unfit::Line(pin) => write!(f, "the select line on pin {pin} is out of reach"),
            Unfit::Addresses(room) => write!(f, "more than {room} addresses are read"),
            Unfit::Stretches(room) => write!(f, "the taxels jump more than {room} times"),
        }
    }
}

impl core::error::Error for Unfit {}

/// The sweep of a plan: up to ADDRESSES addresses in up to STRETCHES stretches, of which there are at least two.
#[derive(Debug)]
pub struct Sweep<const ADDRESSES: usize, const STRETCHES: usize> {
    inputs: Vec<u8, SWEEP_INPUTS>,
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
        if let Some(pin) = circuit.lines().iter().find(|pin| **pin >= 32) {
            return Err(Unfit::Line(*pin));
        }
        for site in circuit.sites().iter().filter(|s| plan.reads(s.panel, s.block)) {
            if !self.inputs.contains(&site.input) {
                self.inputs.push(site.input).map_err(|_| Unfit::Inputs)?;
            }
        }
        self.inputs.sort_unstable();
        let mut last = [None; SWEEP_INPUTS];
        for sites in circuit.selects() {
            self.add_select(circuit, plan, sites, &mut last)?;
        }
        self.split()
    }

    /// All addresses of the blocks that share one select code. Their order within it is that of the taxels of its first
    /// block, so that as many taxels as possible follow each other.
    fn add_select(
        &mut self,
        circuit: &Circuit,
        plan: &Plan,
        sites: &[Site],
        last: &mut Read,
    ) -> Result<(), Unfit> {
        let read = || sites.iter().filter(|s| plan.reads(s.panel, s.block));
        let Some(lead) = read().next() else { return Ok(()) };
        let rows = read().map(|s| s.rows).max().unwrap_or(0);
        let columns = read().map(|s| s.columns).max().unwrap_or(0);
        let by_rows = lead.column_step.abs() == 1;
        let (lines, points, step) =
            if by_rows { (rows, columns, lead.column_step) } else { (columns, rows, lead.row_step) };
        for line in 0..lines {
            for point in 0..points {
                let point_here = if step < 0 { points - 1 - point } else { point };
                let (row, column) = if by_rows { (line, point_here) } else { (point_here, line) };
                let mut here = [None; SWEEP_INPUTS];
                for site in read().filter(|s| row < s.rows && column < s.columns) {
                    let position = self.inputs.iter().position(|input| *input == site.input);
                    if let Some(slot) = position.and_then(|position| here.get_mut(position)) {
                        *slot = Some(site.taxel(row, column) as u16);
                    }
                }
                let goes_on = last.iter().zip(&here).take(self.inputs.len()).all(|pair| match pair {
                    (Some(last), Some(here)) => last + 1 == *here,
                    (None, None) => point > 0,
                    _ => false,
                });
                self.add(levels(circuit, circuit.word(lead.select, row, column)), here, goes_on)?;
                *last = here;
            }
        }
        Ok(())
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

/// A circuit's word, with bit `n` for GPIO `n`.
fn levels(circuit: &Circuit, word: u32) -> u32 {
    let bits = circuit.lines().iter().enumerate();
    bits.fold(0, |levels, (bit, pin)| levels | (word >> bit & 1).checked_shl(u32::from(*pin)).unwrap_or(0))
}
