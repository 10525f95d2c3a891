//! The order of an interlaced scan: each of its sub-fields samples every small footprint at some taxel.
//!
//! The taxel at row r and column c of its panel is read in sub-field `(r + 3 c) mod 8`. Any 3 x 3 taxels hold
//! all eight residues, so a touch of that size is seen in each eighth of a frame. Four sub-fields,
//! `(r + 2 c) mod 4`, do so for 2 x 2 taxels, and two, `(r + c) mod 2`, for any two neighbours. The number of
//! sub-fields is the largest of 8, 4 and 2 for which each lasts at least 100 us and none is empty.
//!
//! | garment | time of a frame | sub-fields | each |
//! |---|---|---|---|
//! | `reference`, `mat-64x32` | 5,120 us | 8 | 640 us, 64 addresses |
//! | `block-4x16` | 640 us | 4 | 160 us, 16 addresses |
//! | any of less than 200 us | | refused: a whole frame is as fast | |
//!
//! Blocks that are read at one address may lie at different rows and columns of their panels. The block with
//! the lowest input decides the sub-field. The order in the other blocks is shifted, constant within a block:
//! only a footprint across two of those blocks may miss a sub-field.
//!
//! From one address to the next, row and column both change, so a line settles from a taxel that is no
//! neighbour: the residue is a part of the whole signal, not of a difference between neighbours. The bound, a
//! full-scale step, is that of every order (`cargo xtask bench acquisition`, "order").

use super::addresses::{self, Address, InputPins, Read};
use super::rounds::Rounds;
use super::sweep::SWEEP_ADDRESSES;
use super::unfit::Unfit;
use super::{Depth, Plan};
use crate::garment::Circuit;
use core::ops::Range;

/// Most sub-fields of a frame.
pub const FIELDS: usize = 8;
/// Shortest sub-field, ns: five times the time of its check.
const SHORTEST_NS: u64 = 100_000;

/// The sub-fields of a plan.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Fields {
    inputs: InputPins,
    /// Number of sub-fields: 8, 4 or 2; 0 if there is no plan.
    count: u8,
    /// Addresses per sub-field.
    addresses: [u16; FIELDS],
}

impl Fields {
    /// No sub-fields.
    pub const fn none() -> Fields {
        Fields { inputs: InputPins::new(), count: 0, addresses: [0; FIELDS] }
    }

    /// Computes the sub-fields of an interlaced plan. Error if a DMA chain cannot read them.
    #[inline(never)] // own frame: its stack is free again on return
    pub fn of(circuit: &Circuit, plan: &Plan) -> Result<Fields, Unfit> {
        if !cfg!(feature = "reflex") {
            return Err(Unfit::LeftOut);
        }
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

    /// Error if the plan is interlaced and the garment cannot be read so.
    pub fn check(circuit: &Circuit, plan: &Plan) -> Result<(), Unfit> {
        if plan.depth == Depth::Interlaced { Fields::of(circuit, plan).map(|_| ()) } else { Ok(()) }
    }

    /// GPIO numbers of the converter inputs that are read at each address, ascending.
    pub fn inputs(&self) -> &[u8] {
        &self.inputs
    }

    /// Number of sub-fields: 8, 4 or 2; 0 if there is no plan.
    pub const fn count(&self) -> usize {
        self.count as usize
    }

    /// Number of addresses of a sub-field; 0 past the last.
    pub fn addresses(&self, field: usize) -> usize {
        self.addresses.get(field).map_or(0, |addresses| usize::from(*addresses))
    }

    /// Number of addresses before a sub-field.
    pub fn before(&self, field: usize) -> usize {
        self.addresses.iter().take(field).map(|addresses| usize::from(*addresses)).sum()
    }

    /// Range of a sub-field's codes if the codes of all sub-fields follow each other; within a sub-field,
    /// those of one input come after those of the previous input.
    pub fn span(&self, field: usize) -> Range<usize> {
        let first = self.before(field) * self.inputs.len();
        first..first + self.addresses(field) * self.inputs.len()
    }

    /// Visits all addresses in the order of the scan, with their sub-field, the levels of the select lines
    /// (bit `n` for GPIO `n`), and the taxels that the inputs read. `circuit` and `plan` must be those of
    /// [`Fields::of`].
    pub fn each(&self, circuit: &Circuit, plan: &Plan, mut take: impl FnMut(usize, u32, Read)) {
        for field in 0..self.count() {
            // No address is refused.
            let _ = addresses::each(circuit, plan, |address| {
                if residue(self.count, &address) == field {
                    take(field, address.levels(), address.taxels(&self.inputs));
                }
                Ok(())
            });
        }
    }
}

/// Returns the sub-field of an address, of `count` (8, 4 or 2).
fn residue(count: u8, address: &Address<'_>) -> usize {
    let (row, column) = address.place();
    let slant = match count {
        8 => 3,
        4 => 2,
        _ => 1,
    };
    // `count` is a power of two: the mask is the remainder, also of negative numbers.
    ((row + slant * column) & (i32::from(count) - 1)) as usize
}
