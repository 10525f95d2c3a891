//! The order of an interlaced scan: sub-fields, each of which meets every small footprint somewhere.
//!
//! The taxel at row r and column c of its panel is read in sub-field `(r + 3 c) mod 8`. Any three rows of
//! three columns hold all eight residues, so a touch of 3 x 3 taxels is met in each eighth of a frame; with
//! four sub-fields, `(r + 2 c) mod 4`, one of 2 x 2 is; with two, `(r + c) mod 2`, any two neighbours. There
//! are as many sub-fields, of 8, 4 and 2, as last for at least 100 us each and are not empty.
//!
//! | garment | time of a frame | sub-fields | each |
//! |---|---|---|---|
//! | `reference`, `mat-64x32` | 5,120 us | 8 | 640 us, 64 addresses |
//! | `block-4x16` | 640 us | 4 | 160 us, 16 addresses |
//! | any of less than 200 us | | refused: a whole frame is as quick | |
//!
//! Blocks that are read together, at one address, may lie at other rows and columns of their panels. The
//! sub-field is that of the one with the lowest input. In the others the order is the same but for a shift,
//! within each block: only a footprint across two of their blocks may miss a sub-field.
//!
//! From one address to the next row and column both change, so a line settles from a taxel that is no
//! neighbour: what is left of it is a part of the whole signal and not of a difference between neighbours.
//! The bound, a full-scale step, is that of every order (`taxel bench acquisition`, "order").

use super::addresses::{self, Address, Inputs, Read};
use super::rounds::Rounds;
use super::sweep::{SWEEP_ADDRESSES, Unfit};
use super::{Depth, Plan};
use crate::garment::Circuit;
use core::ops::Range;

/// Most sub-fields of a frame.
pub const FIELDS: usize = 8;
/// Least time of a sub-field, ns: five times what its check takes.
const SHORTEST_NS: u64 = 100_000;

/// The sub-fields of a plan.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Fields {
    inputs: Inputs,
    /// How many there are: 8, 4 or 2; 0 of none.
    count: u8,
    /// Addresses of each.
    addresses: [u16; FIELDS],
}

impl Fields {
    /// Of nothing.
    pub const fn none() -> Fields {
        Fields { inputs: Inputs::new(), count: 0, addresses: [0; FIELDS] }
    }

    /// Works out the sub-fields of a plan that asks for them, and whether a chain can read them.
    #[inline(never)] // it needs stack only meanwhile
    pub fn of(circuit: &Circuit, plan: &Plan) -> Result<Fields, Unfit> {
        let inputs = addresses::inputs(circuit, plan)?;
        let address_ns = Rounds::of(inputs.len(), circuit.settle_ns()).address_ns();
        let mut fields = Fields { inputs, ..Fields::none() };
        for count in [8, 4, 2] {
            (fields.count, fields.addresses) = (count, [0; FIELDS]);
            let mut all = 0;
            addresses::each(circuit, plan, |address| {
                all += 1;
                let slot = fields.addresses.get_mut(residue(count, &address));
                slot.into_iter().for_each(|addresses| *addresses += 1);
                if all > SWEEP_ADDRESSES { Err(Unfit::Addresses(SWEEP_ADDRESSES)) } else { Ok(()) }
            })?;
            let least = fields.addresses.iter().take(count.into()).min().map_or(0, |least| u64::from(*least));
            if least * address_ns >= SHORTEST_NS {
                return Ok(fields);
            }
        }
        Err(Unfit::Short)
    }

    /// Whether a garment can be read as its plan asks: one that is not to be interlaced always can.
    pub fn check(circuit: &Circuit, plan: &Plan) -> Result<(), Unfit> {
        if plan.depth == Depth::Interlaced { Fields::of(circuit, plan).map(|_| ()) } else { Ok(()) }
    }

    /// GPIO numbers of the converter inputs that are read at each address, ascending.
    pub fn inputs(&self) -> &[u8] {
        &self.inputs
    }

    /// How many there are: 8, 4 or 2.
    pub const fn count(&self) -> usize {
        self.count as usize
    }

    /// Addresses of a sub-field; 0 past the last.
    pub fn addresses(&self, field: usize) -> usize {
        self.addresses.get(field).map_or(0, |addresses| usize::from(*addresses))
    }

    /// Addresses before a sub-field.
    pub fn before(&self, field: usize) -> usize {
        self.addresses.iter().take(field).map(|addresses| usize::from(*addresses)).sum()
    }

    /// Where the codes of a sub-field lie, those of one input after those of the other, where each follows
    /// the one before.
    pub fn span(&self, field: usize) -> Range<usize> {
        let first = self.before(field) * self.inputs.len();
        first..first + self.addresses(field) * self.inputs.len()
    }

    /// Goes through all addresses in the order of the scan: its sub-field, the levels of the select lines
    /// (bit `n` for GPIO `n`), and the taxels that the inputs read. The circuit and the plan are those that
    /// the sub-fields are of.
    pub fn each(&self, circuit: &Circuit, plan: &Plan, mut take: impl FnMut(usize, u32, Read)) {
        for field in 0..self.count() {
            // Nothing here is refused.
            let _ = addresses::each(circuit, plan, |address| {
                if residue(self.count, &address) == field {
                    take(field, address.levels(), address.taxels(&self.inputs));
                }
                Ok(())
            });
        }
    }
}

/// The sub-field of an address, of 8, 4 or 2.
fn residue(count: u8, address: &Address<'_>) -> usize {
    let (row, column) = address.place();
    let slant = match count {
        8 => 3,
        4 => 2,
        _ => 1,
    };
    // A power of two: the mask is the remainder, of what is negative, too.
    ((row + slant * column) & (i32::from(count) - 1)) as usize
}
