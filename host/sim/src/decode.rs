//! Models the multiplexers of a garment: the levels of the select lines choose a block, a row and a column.
//!
//! Derived from the [`Garment`] alone, not from the core's `Circuit`, so that each checks the other.

use taxel_core::garment::{Block, Coding, Garment, Group};

/// The multiplexers of a garment.
#[derive(Debug, Clone)]
pub struct Decoder {
    garment: Garment,
    /// First taxel and columns of each panel.
    panels: Vec<(usize, usize)>,
    /// GPIO numbers of the converter inputs, ascending.
    inputs: Vec<u8>,
    /// Block by input and select code.
    blocks: Vec<Option<u8>>,
    selects: usize,
}

/// Codes of the select lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Address {
    /// code of the block lines
    pub select: u32,
    /// code of the row lines
    pub row: u32,
    /// code of the column lines
    pub column: u32,
}

impl Decoder {
    /// Decoder of any garment; `Circuit::build` refuses contradictory blocks.
    pub fn build(garment: &Garment) -> Decoder {
        let mut base = 0;
        let panels = garment
            .panels
            .iter()
            .map(|panel| {
                let first = base;
                base += usize::from(panel.rows) * usize::from(panel.columns);
                (first, usize::from(panel.columns))
            })
            .collect();
        let mut inputs: Vec<u8> = garment.blocks.iter().map(|b| b.input).collect();
        inputs.sort_unstable();
        inputs.dedup();
        let selects = garment.blocks.iter().map(|b| usize::from(b.select) + 1).max().unwrap_or(0);
        let mut blocks = vec![None; inputs.len() * selects];
        for (index, block) in garment.blocks.iter().enumerate() {
            let input = inputs.iter().position(|pin| *pin == block.input).unwrap_or(0);
            if let Some(slot) = blocks.get_mut(input * selects + usize::from(block.select)) {
                *slot = Some(index as u8);
            }
        }
        Decoder { garment: garment.clone(), panels, inputs, blocks, selects }
    }

    /// GPIO numbers of the converter inputs in use, ascending.
    pub fn inputs(&self) -> &[u8] {
        &self.inputs
    }

    /// Address selected by the levels: bit `n` of the word is the level of GPIO `n`. None while an enable is
    /// not asserted, or unless exactly one line of a one-hot group is.
    pub fn address(&self, levels: u64) -> Option<Address> {
        let wiring = &self.garment.wiring;
        let asserted =
            |pin: u8, inverted: bool| (levels.checked_shr(u32::from(pin)).unwrap_or(0) & 1 == 1) != inverted;
        if !wiring.enable.iter().all(|line| asserted(line.pin, line.inverted)) {
            return None;
        }
        let code = |group: &Group| {
            let lines =
                || group.lines.iter().enumerate().filter(|(_, line)| asserted(line.pin, line.inverted));
            match group.coding {
                _ if group.lines.is_empty() => Some(0),
                Coding::Binary => Some(lines().fold(0, |code, (bit, _)| code | 1 << bit)),
                Coding::OneHot => {
                    let mut on = lines();
                    on.next().filter(|_| on.next().is_none()).map(|(number, _)| number as u32)
                }
            }
        };
        Some(Address { select: code(&wiring.block)?, row: code(&wiring.row)?, column: code(&wiring.column)? })
    }

    /// Taxel at the input with this index (see [`Decoder::inputs`]); none if nothing is connected.
    #[inline]
    pub fn taxel(&self, address: Address, input: usize) -> Option<usize> {
        let select = address.select as usize;
        if select >= self.selects {
            return None;
        }
        let block = (*self.blocks.get(input * self.selects + select)?)?;
        let block = self.garment.blocks.get(usize::from(block))?;
        let inside = address.row < u32::from(block.rows) && address.column < u32::from(block.columns);
        inside.then(|| self.taxel_of(block, address.row as u8, address.column as u8))
    }

    /// Number of the taxel at a wired row and column of a block.
    #[inline]
    pub fn taxel_of(&self, block: &Block, row: u8, column: u8) -> usize {
        let turn = block.orientation;
        let (mut x, mut y) = (usize::from(column), usize::from(row));
        let (mut width, mut height) = (usize::from(block.columns), usize::from(block.rows));
        if turn.transposed {
            (x, y, width, height) = (y, x, height, width);
        }
        if turn.mirror_x {
            x = width.saturating_sub(x + 1);
        }
        if turn.mirror_y {
            y = height.saturating_sub(y + 1);
        }
        let (first, columns) = self.panels.get(usize::from(block.panel)).copied().unwrap_or((0, 0));
        first + (usize::from(block.row) + y) * columns + usize::from(block.column) + x
    }

    /// All addresses with a taxel at any input, in the order of a progressive scan: by select code, then row,
    /// then column.
    pub fn addresses(&self) -> Vec<Address> {
        let mut addresses: Vec<Address> = self
            .garment
            .blocks
            .iter()
            .flat_map(|b| {
                let select = u32::from(b.select);
                let rows = 0..u32::from(b.rows);
                rows.flat_map(move |row| {
                    (0..u32::from(b.columns)).map(move |column| Address { select, row, column })
                })
            })
            .collect();
        addresses.sort_unstable();
        addresses.dedup();
        addresses
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::{Circuit, Layout, Line, Orientation, Pins};

    /// Levels of the GPIOs for a word of the circuit.
    fn levels(circuit: &Circuit, word: u32) -> u64 {
        circuit.lines().iter().enumerate().fold(0, |all, (bit, pin)| all | u64::from(word >> bit & 1) << pin)
    }

    /// Checks that the decoder inverts the core's circuit at every address of every block.
    fn agrees(garment: &Garment) {
        let layout = Layout::build(garment, 4096, 4095).unwrap();
        let circuit = Circuit::build(garment, &layout, Pins::ANY).unwrap();
        let decoder = Decoder::build(garment);
        let mut seen = vec![false; layout.taxels()];
        for site in circuit.sites() {
            for (row, column) in (0..site.rows).flat_map(|r| (0..site.columns).map(move |c| (r, c))) {
                let address =
                    decoder.address(levels(&circuit, circuit.word(site.select, row, column))).unwrap();
                let input = decoder.inputs().iter().position(|pin| *pin == site.input).unwrap();
                assert_eq!(decoder.taxel(address, input), Some(site.taxel(row, column)));
                seen[site.taxel(row, column)] = true;
            }
        }
        assert!(seen.iter().all(|s| *s));
    }

    #[test]
    fn presets_decode() {
        for preset in Garment::PRESETS {
            agrees(&Garment::preset(preset).unwrap());
        }
    }

    #[test]
    fn turned_blocks_one_hot_rows_inverted_lines_and_enables_decode() {
        let mut garment = Garment::reference();
        for (index, block) in garment.blocks.iter_mut().enumerate() {
            block.orientation =
                Orientation { transposed: false, mirror_x: index & 1 == 1, mirror_y: index & 2 == 2 };
        }
        agrees(&garment);
        garment.wiring.row.coding = Coding::OneHot;
        garment.wiring.row.lines = (13..17).map(|pin| Line { pin, inverted: pin & 1 == 1 }).collect();
        garment.wiring.enable.push(Line { pin: 20, inverted: true }).unwrap();
        garment.wiring.enable.push(Line { pin: 21, inverted: false }).unwrap();
        agrees(&garment);
        let decoder = Decoder::build(&garment);
        let one_row = 1 << 13 ^ (1 << 13 | 1 << 15);
        assert_eq!(decoder.address(1 << 21), None, "rows 0 and 2 are both asserted");
        assert!(decoder.address(1 << 21 | one_row).is_some());
        assert_eq!(decoder.address(one_row), None, "not enabled");
        let mut square = Garment::block();
        square.panels[0].rows = 16;
        square.panels[0].columns = 4;
        for mirrors in 0..4u8 {
            square.blocks[0].orientation =
                Orientation { transposed: true, mirror_x: mirrors & 1 == 1, mirror_y: mirrors & 2 == 2 };
            agrees(&square);
        }
    }
}
