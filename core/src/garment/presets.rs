//! Garments that come with the program.

use super::config::{Block, Coding, Garment, Group, Line, Orientation, Panel, Seam, SeamEdge, Side, Wiring};
use crate::format::name;
use heapless::Vec;

/// First converter input of the RP2040.
const GP26: u8 = 26;

impl Garment {
    /// Names of the garments that come with the program.
    pub const PRESETS: [&'static str; 3] = ["reference", "mat-64x32", "block-4x16"];

    /// The garment of that name, see [`Garment::PRESETS`].
    pub fn preset(name: &str) -> Option<Garment> {
        match name {
            "reference" => Some(Garment::reference()),
            "mat-64x32" => Some(Garment::mat()),
            "block-4x16" => Some(Garment::block()),
            _ => None,
        }
    }

    /// The reference garment: four panels of 32 x 16 (chest, back, left arm, right arm), eight blocks of 4 x
    /// 16 stacked in each, one converter input per panel; chest and back are sewn together along both flanks.
    pub fn reference() -> Garment {
        let panel = |text, link, region, pitch_um| Panel {
            name: name(text),
            link: name(link),
            region: name(region),
            rows: 32,
            columns: 16,
            pitch_um,
        };
        let mut garment = Garment {
            name: name("reference"),
            wiring: reference_wiring(),
            panels: Vec::from_array([
                panel("chest", "torso", "chest", [12_000, 10_000]),
                panel("back", "torso", "back", [12_000, 10_000]),
                panel("left arm", "left_upper_arm", "left arm", [12_000, 10_000]),
                panel("right arm", "right_upper_arm", "right arm", [12_000, 10_000]),
            ]),
            blocks: Vec::new(),
            seams: Vec::from_array([flank(Side::Right, Side::Left), flank(Side::Left, Side::Right)]),
            absent: Vec::new(),
        };
        for panel in 0..4 {
            for select in 0..8 {
                let _ = garment.blocks.push(block(panel, u16::from(select) * 4, 0, GP26 + panel, select));
            }
        }
        garment
    }

    /// One mat of 64 x 32 on four inputs: input k reads rows 16 k to 16 k + 15, two blocks of 4 x 16 side by
    /// side.
    pub fn mat() -> Garment {
        let mut garment = plain("mat-64x32", 64, 32);
        for input in 0..4u8 {
            for select in 0..8u8 {
                let row = u16::from(input) * 16 + u16::from(select / 2) * 4;
                let _ = garment.blocks.push(block(0, row, u16::from(select % 2) * 16, GP26 + input, select));
            }
        }
        garment
    }

    /// The first garment to solder: one block of 4 x 16. GP2, GP3, GP6 and GP7 drive its four rows directly;
    /// one multiplexer (GP9-GP12) connects its sixteen columns to one converter input (GP26).
    ///
    /// It settles for 8 us. A delay in whole microseconds is sure to give 7, after which a line of 80 pF
    /// behind its 10 kOhm keeps 0.65 counts of a full-scale step (`cargo xtask bench acquisition`).
    pub fn block() -> Garment {
        let mut garment = plain("block-4x16", 4, 16);
        garment.wiring.block.lines.clear();
        garment.wiring.row = Group { coding: Coding::OneHot, ..lines(&[2, 3, 6, 7]) };
        garment.wiring.settle_ns = 8_000;
        let _ = garment.blocks.push(block(0, 0, 0, GP26, 0));
        garment
    }

    /// One panel of any size for recorded frames, whose pitch is unknown.
    pub fn recorded(rows: u16, columns: u16) -> Garment {
        Garment::grid("recorded", rows, columns, [0, 0])
    }

    /// One panel of any size, of this distance of columns and of rows, um; 0 if unknown. Without blocks it
    /// can be perceived but not scanned.
    pub fn grid(title: &str, rows: u16, columns: u16, pitch_um: [u32; 2]) -> Garment {
        let mut garment = plain(title, rows, columns);
        if let Some(panel) = garment.panels.first_mut() {
            panel.pitch_um = pitch_um;
        }
        garment
    }
}

fn plain(title: &str, rows: u16, columns: u16) -> Garment {
    let panel = Panel {
        name: name("mat"),
        link: name("base"),
        region: name("mat"),
        rows,
        columns,
        pitch_um: [10_000, 10_000],
    };
    Garment {
        name: name(title),
        wiring: reference_wiring(),
        panels: [panel].into_iter().collect(),
        blocks: Vec::new(),
        seams: Vec::new(),
        absent: Vec::new(),
    }
}

/// Nine address lines on pins that both a Feather RP2040 and a bare RP2040 bring out: three for the block
/// (GP2, GP3, GP6), two for the row (GP7, GP8), four for the column (GP9-GP12).
///
/// Settling is 3 us, of which a board is sure to give 2 (one conversion, or a delay in whole microseconds). A
/// conditioned line with a time constant of 240 ns (3 kOhm and 80 pF) then keeps 0.98 counts of a full-scale
/// step (`cargo xtask bench acquisition`). A slower line needs a longer time, which a frame pays 512 times or
/// a little more (`acquire::Rounds`). For an amplifier that is fast enough: `cargo xtask bench amplifier`.
fn reference_wiring() -> Wiring {
    Wiring {
        block: lines(&[2, 3, 6]),
        row: lines(&[7, 8]),
        column: lines(&[9, 10, 11, 12]),
        enable: Vec::new(),
        settle_ns: 3_000,
        falling: false,
    }
}

fn lines(pins: &[u8]) -> Group {
    Group { lines: pins.iter().map(|pin| Line { pin: *pin, inverted: false }).collect(), ..Group::default() }
}

fn block(panel: u8, row: u16, column: u16, input: u8, select: u8) -> Block {
    Block {
        panel,
        row,
        column,
        rows: 4,
        columns: 16,
        input,
        select: u16::from(select),
        orientation: Orientation::default(),
    }
}

/// A flank of the torso: one side of the chest (panel 0), sewn to the opposite side of the back (panel 1).
fn flank(chest: Side, back: Side) -> Seam {
    Seam {
        a: SeamEdge { panel: 0, side: chest, start: 0 },
        b: SeamEdge { panel: 1, side: back, start: 0 },
        length: 32,
        reversed: false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Circuit, Layout, Pins};
    use super::*;

    #[test]
    fn every_preset_builds_for_the_reference_board() {
        for preset in Garment::PRESETS {
            let garment = Garment::preset(preset).unwrap();
            let layout = Layout::build(&garment, 2048, 4095).unwrap();
            let circuit = Circuit::build(&garment, &layout, Pins::FEATHER).unwrap();
            assert_eq!(garment.name.as_str(), preset);
            let read: usize =
                circuit.sites().iter().map(|s| usize::from(s.rows) * usize::from(s.columns)).sum();
            assert_eq!(read, layout.taxels());
        }
    }
}
