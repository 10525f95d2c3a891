//! A table of folds for the reference garment: the whole left arm folds at its elbow, as much as a board holds.

use crate::surface::put;
use crc::{CRC_32_ISO_HDLC, Crc};
use taxel_core::fold::{CELLS, FOLDED, fold_table_bytes};

const BYTES: usize = fold_table_bytes(1, FOLDED, CELLS);
/// Bytes before the fold, and before its taxels.
const HEAD: usize = fold_table_bytes(0, 0, 0);
const TAXELS: usize = fold_table_bytes(1, 0, 0);
const KNOTS: usize = CELLS / FOLDED;
/// Number of the left arm's first taxel.
const FIRST: usize = 1024;

/// The bytes, aligned as flash is.
#[repr(align(4))]
pub struct AlignedFolds(pub [u8; BYTES]);

/// In flash, as on a board.
pub static FOLDS: AlignedFolds = AlignedFolds(bytes());

#[allow(long_running_const_eval)] // a CRC of 26 KB
const fn bytes() -> [u8; BYTES] {
    let mut bytes = put([0; BYTES], 0, b"TXFD");
    let [[t0, t1], [c0, c1]] = [(FOLDED as u16).to_le_bytes(), (CELLS as u16).to_le_bytes()];
    // Version 2, one joint, one fold; a unit of 4 counts.
    bytes = put(bytes, 8, &[2, 1, 1, 0, t0, t1, c0, c1, 4, 0]);
    let crc = Crc::<u32>::new(&CRC_32_ISO_HDLC);
    bytes = put(bytes, 20, &crate::surface::layout_sum());
    bytes = put(bytes, 24, b"left_elbow");
    // Knots from 0 degrees on, 9 degrees apart; a play of 6 degrees.
    let [step, play] = [900u16.to_le_bytes(), 600u16.to_le_bytes()];
    bytes = put(bytes, HEAD, &[0, 255, KNOTS as u8, 1]);
    bytes = put(bytes, HEAD + 8, &step);
    bytes = put(bytes, HEAD + 12, &play);
    bytes = put(bytes, HEAD + 16, &[t0, t1]);
    let mut taxel = 0;
    while taxel < FOLDED {
        bytes = put(bytes, TAXELS + 2 * taxel, &((FIRST + taxel) as u16).to_le_bytes());
        // Four means, four spreads and four days at each knot, then what each taxel feels at most: the last knot.
        let mut knot = 0;
        while knot < KNOTS {
            let mean = (knot * 8 + taxel % 16) as u8;
            let felt = [mean, 4 + mean / 8, mean / 2];
            let at = TAXELS + 2 * FOLDED + 3 * knot * FOLDED + taxel / 4 * 12 + taxel % 4;
            (bytes[at], bytes[at + 4], bytes[at + 8]) = (felt[0], felt[1], felt[2]);
            bytes[TAXELS + 2 * FOLDED + 3 * CELLS + taxel] = felt[0] + felt[1] + felt[2];
            knot += 1;
        }
        taxel += 1;
    }
    let (_, rest) = bytes.split_at(8);
    let sum = crc.checksum(rest).to_le_bytes();
    put(bytes, 4, &sum)
}

#[cfg(test)]
mod tests {
    use super::FOLDS;
    use taxel_core::fold::FoldTable;
    use taxel_core::garment::{Garment, Layout};

    #[test]
    fn it_is_a_table_of_the_reference_garment() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        assert_eq!(FoldTable::check(&FOLDS.0, &layout).map(|table| table.taxels().len()), Ok(128));
    }
}
