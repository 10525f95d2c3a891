//! A garment with random wiring.

use fastrand::Rng;
use taxel_core::garment::{Block, Garment, Group};

/// Rewires a garment at random: any address line on any pin, any of them inverted; any input on any panel;
/// panels sewn in mirrored or turned; single blocks mirrored or turned within them; blocks of a panel in any
/// order.
pub fn rewire(garment: &Garment, rng: &mut Rng) -> Garment {
    let mut wired = garment.clone();
    let mut pins: Vec<u8> =
        groups(&mut wired).flat_map(|group| group.lines.iter().map(|line| line.pin)).collect();
    rng.shuffle(&mut pins);
    let lines = groups(&mut wired).flat_map(|group| group.lines.iter_mut());
    for (line, pin) in lines.zip(pins) {
        (line.pin, line.inverted) = (pin, rng.bool());
    }
    let mut inputs: Vec<u8> = garment.blocks.iter().map(|block| block.input).collect();
    inputs.sort_unstable();
    inputs.dedup();
    let mut shuffled = inputs.clone();
    rng.shuffle(&mut shuffled);
    for block in &mut wired.blocks {
        let at = inputs.iter().position(|input| *input == block.input).unwrap_or(0);
        block.input = shuffled[at];
        if rng.u8(..8) == 0 {
            turn(block, [rng.bool(), rng.bool()]);
        }
    }
    for panel in 0..wired.panels.len() {
        let size = [wired.panels[panel].columns, wired.panels[panel].rows];
        let mirror = [rng.bool(), rng.bool()];
        let swapped = rng.u8(..4) == 0;
        let mut selects = Vec::new();
        for block in wired.blocks.iter_mut().filter(|block| usize::from(block.panel) == panel) {
            sew(block, size, mirror);
            selects.push((block.input, block.select));
        }
        if swapped {
            rng.shuffle(&mut selects);
            let blocks = wired.blocks.iter_mut().filter(|block| usize::from(block.panel) == panel);
            blocks.zip(selects).for_each(|(block, address)| (block.input, block.select) = address);
        }
    }
    wired
}

fn groups(garment: &mut Garment) -> impl Iterator<Item = &mut Group> {
    let wiring = &mut garment.wiring;
    [&mut wiring.block, &mut wiring.row, &mut wiring.column].into_iter()
}

fn turn(block: &mut Block, mirror: [bool; 2]) {
    block.orientation.mirror_x ^= mirror[0];
    block.orientation.mirror_y ^= mirror[1];
}

/// Places a block in a panel of this size (columns, rows) that is sewn in mirrored.
fn sew(block: &mut Block, size: [u16; 2], mirror: [bool; 2]) {
    let (mut width, mut height) = (u16::from(block.columns), u16::from(block.rows));
    if block.orientation.transposed {
        std::mem::swap(&mut width, &mut height);
    }
    if mirror[0] {
        block.column = size[0] - block.column - width;
    }
    if mirror[1] {
        block.row = size[1] - block.row - height;
    }
    turn(block, mirror);
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::{Circuit, Layout, Pins};

    #[test]
    fn every_wiring_is_a_garment_and_no_two_are_alike() {
        let mut rng = Rng::with_seed(4);
        for garment in [Garment::reference(), Garment::mat()] {
            let wired: Vec<Garment> = (0..20).map(|_| rewire(&garment, &mut rng)).collect();
            for (index, one) in wired.iter().enumerate() {
                let layout = Layout::build(one, 2048, 4095).unwrap();
                Circuit::build(one, &layout, Pins::ANY).unwrap();
                assert!(wired[..index].iter().all(|other| other.wiring != one.wiring));
            }
        }
    }
}
