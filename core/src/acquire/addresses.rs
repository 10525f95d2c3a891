//! The addresses of a plan, which every scan reads, whatever its order.

use super::Plan;
use super::unfit::{SWEEP_INPUTS, Unfit};
use crate::garment::{Circuit, Site};
use heapless::Vec;

/// Numbers of the taxels read at one address, by the position of their input among the plan's.
pub type Read = [Option<u16>; SWEEP_INPUTS];

/// GPIO numbers of the converter inputs of a plan, ascending.
pub(super) type InputPins = Vec<u8, SWEEP_INPUTS>;

/// Returns the inputs that one converter reads in turn. Error if a line is past GPIO 31 or there are too
/// many.
pub(super) fn inputs(circuit: &Circuit, plan: &Plan) -> Result<InputPins, Unfit> {
    if let Some(pin) = circuit.lines().iter().find(|pin| **pin >= 32) {
        return Err(Unfit::Line(*pin));
    }
    let read = circuit.sites().iter().filter(|s| plan.reads(s.panel, s.block));
    let mask = read.fold(0u64, |mask, site| mask | 1 << (site.input & 63));
    let mut inputs = InputPins::new();
    // Without the library's sort, which can panic.
    for input in (0..64).filter(|input| mask >> input & 1 == 1) {
        inputs.push(input).map_err(|_| Unfit::Inputs)?;
    }
    Ok(inputs)
}

/// One combination of select code, row and column.
pub(super) struct Address<'a> {
    circuit: &'a Circuit,
    plan: &'a Plan,
    /// Blocks that share its select code.
    sites: &'a [Site],
    /// First of these blocks that the plan reads.
    lead: &'a Site,
    row: u8,
    column: u8,
    /// Position within its line; 0 where a line of the lead's taxels begins.
    pub point: u8,
}

impl Address<'_> {
    /// Levels of the select lines, bit `n` for GPIO `n`.
    pub fn levels(&self) -> u32 {
        let word = self.circuit.word(self.lead.select, self.row, self.column);
        let bits = self.circuit.lines().iter().enumerate();
        bits.fold(0, |levels, (bit, pin)| {
            levels | (word >> bit & 1).checked_shl(u32::from(*pin)).unwrap_or(0)
        })
    }

    /// Row and column of the lead's taxel in its panel.
    pub fn place(&self) -> (i32, i32) {
        self.lead.place(self.row, self.column)
    }

    /// Returns the taxels that these inputs read here.
    pub fn taxels(&self, inputs: &InputPins) -> Read {
        let mut here = [None; SWEEP_INPUTS];
        let there = |site: &&Site| {
            self.plan.reads(site.panel, site.block) && self.row < site.rows && self.column < site.columns
        };
        for site in self.sites.iter().filter(there) {
            let position = inputs.iter().position(|input| *input == site.input);
            if let Some(slot) = position.and_then(|position| here.get_mut(position)) {
                *slot = Some(site.taxel(self.row, self.column) as u16);
            }
        }
        here
    }
}

/// Visits all addresses, by select code. Within one code they follow the taxel numbers of its first block, so
/// that runs of consecutive taxels are as long as possible.
pub(super) fn each<'a>(
    circuit: &'a Circuit,
    plan: &'a Plan,
    mut take: impl FnMut(Address<'a>) -> Result<(), Unfit>,
) -> Result<(), Unfit> {
    for sites in circuit.selects() {
        let read = || sites.iter().filter(|s| plan.reads(s.panel, s.block));
        let Some(lead) = read().next() else { continue };
        let rows = read().map(|s| s.rows).max().unwrap_or(0);
        let columns = read().map(|s| s.columns).max().unwrap_or(0);
        let by_rows = lead.column_step.abs() == 1;
        let (lines, points, step) =
            if by_rows { (rows, columns, lead.column_step) } else { (columns, rows, lead.row_step) };
        for line in 0..lines {
            for point in 0..points {
                let here = if step < 0 { points - 1 - point } else { point };
                let (row, column) = if by_rows { (line, here) } else { (here, line) };
                take(Address { circuit, plan, sites, lead, row, column, point })?;
            }
        }
    }
    Ok(())
}
