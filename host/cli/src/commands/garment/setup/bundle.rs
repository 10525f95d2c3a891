//! The wires before setup: which pins are outputs and which are inputs.

use anyhow::{Result, bail, ensure};
use taxel_core::format::name;
use taxel_core::garment::{Block, Coding, Garment, Group, Line, Orientation, Panel};

/// Most block columns of the probe garment: with 4 of them, blocks have at most 16 rows and columns.
const SIDE: usize = 4;

/// A bundle of unidentified wires. An address is `input * 2^lines + word`; bit `i` of the word is the level
/// of line `i`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bundle {
    /// GPIO numbers of the address lines.
    pub lines: Vec<u8>,
    /// GPIO numbers of the converter inputs.
    pub inputs: Vec<u8>,
}

impl Bundle {
    /// Collects the pins of a garment. Error if it cannot be set up by touch.
    pub fn of(garment: &Garment) -> Result<Bundle> {
        let groups = [&garment.wiring.block, &garment.wiring.row, &garment.wiring.column];
        if groups.iter().any(|group| group.coding != Coding::Binary && !group.lines.is_empty()) {
            bail!(
                "garment {}: one line for each row needs no setup by touch, only binary addresses do",
                garment.name
            );
        }
        let lines: Vec<u8> =
            groups.iter().flat_map(|group| group.lines.iter().map(|line| line.pin)).collect();
        let mut inputs: Vec<u8> = garment.blocks.iter().map(|block| block.input).collect();
        inputs.sort_unstable();
        inputs.dedup();
        ensure!(!inputs.is_empty(), "garment {}: it has no blocks", garment.name);
        let blocks = 1usize.checked_shl(lines.len().saturating_sub(2 * SIDE) as u32).unwrap_or(usize::MAX);
        ensure!(
            blocks.saturating_mul(inputs.len()) <= taxel_core::garment::BLOCKS
                && inputs.len() <= taxel_core::garment::PANELS,
            "garment {}: {} address lines and {} inputs are more than setup by touch can read",
            garment.name,
            lines.len(),
            inputs.len()
        );
        for block in &garment.blocks {
            ensure!(
                block.rows.is_power_of_two() && block.columns.is_power_of_two(),
                "garment {}: setup by touch needs blocks of 1, 2, 4, 8 or 16 rows and columns",
                garment.name
            );
        }
        Ok(Bundle { lines, inputs })
    }

    /// Number of addresses.
    pub fn addresses(&self) -> usize {
        self.inputs.len() << self.lines.len()
    }

    /// Index of the input, and the word, of an address.
    pub fn split(&self, address: usize) -> (usize, usize) {
        (address >> self.lines.len(), address & ((1 << self.lines.len()) - 1))
    }

    /// Levels of the GPIOs at an address, for a garment with known enables.
    pub fn levels(&self, address: usize, garment: &Garment) -> u64 {
        let (_, word) = self.split(address);
        let lines =
            self.lines.iter().enumerate().filter(|(bit, _)| word >> bit & 1 == 1).map(|(_, pin)| *pin);
        let enables = garment.wiring.enable.iter().filter(|line| !line.inverted).map(|line| line.pin);
        lines.chain(enables).fold(0, |levels, pin| levels | 1u64.checked_shl(pin.into()).unwrap_or(0))
    }

    /// Returns a garment that reads every address of every input, with taxels numbered like addresses.
    pub fn probe(&self, garment: &Garment) -> Garment {
        let count = self.lines.len();
        let (columns, rows) = (count.min(SIDE), count.saturating_sub(SIDE).min(SIDE));
        let group = |range: std::ops::Range<usize>| Group {
            coding: Coding::Binary,
            lines: self.lines[range].iter().map(|pin| Line { pin: *pin, inverted: false }).collect(),
        };
        let mut probe = garment.clone();
        probe.name = name("unknown");
        probe.wiring.column = group(0..columns);
        probe.wiring.row = group(columns..columns + rows);
        probe.wiring.block = group(columns + rows..count);
        let selects = 1u16 << (count - columns - rows);
        let panel = |input: &u8| Panel {
            name: name(&format!("GP{input}")),
            link: name("unknown"),
            region: name("unknown"),
            rows: selects << rows,
            columns: 1 << columns,
            pitch_um: [0, 0],
        };
        let block = |panel: usize, select: u16| Block {
            panel: panel as u8,
            row: select << rows,
            column: 0,
            rows: 1 << rows,
            columns: 1 << columns,
            input: self.inputs[panel],
            select,
            orientation: Orientation::default(),
        };
        probe.panels = self.inputs.iter().map(panel).collect();
        probe.blocks = (0..self.inputs.len())
            .flat_map(|panel| (0..selects).map(move |select| (panel, select)))
            .map(|(panel, select)| block(panel, select))
            .collect();
        probe.seams.clear();
        probe.absent.clear();
        probe
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel::sim::Decoder;
    use taxel_core::garment::{Circuit, Layout, Pins};

    #[test]
    fn the_probe_reads_each_address_once() {
        for garment in [Garment::reference(), Garment::mat()] {
            let bundle = Bundle::of(&garment).unwrap();
            let probe = bundle.probe(&garment);
            let layout = Layout::build(&probe, 2048, 4095).unwrap();
            Circuit::build(&probe, &layout, Pins::ANY).unwrap();
            let decoder = Decoder::build(&probe);
            assert_eq!(layout.taxels(), bundle.addresses());
            for address in 0..bundle.addresses() {
                let at = decoder.address(bundle.levels(address, &probe)).unwrap();
                assert_eq!(decoder.taxel(at, bundle.split(address).0), Some(address));
            }
        }
        assert!(Bundle::of(&Garment::block()).unwrap_err().to_string().contains("binary"));
    }
}
