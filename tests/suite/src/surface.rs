//! A table of the surface for the reference garment: each panel lies flat on the torso. What is measured does
//! not depend on the shape.

use crc::{CRC_32_ISO_HDLC, Crc};
use taxel_core::capacity::TAXELS;
use taxel_core::surface::{ONE, table_bytes};

const BYTES: usize = table_bytes(TAXELS);
/// Bytes before the first taxel.
const HEAD: usize = table_bytes(0);
/// Rows of all panels, and columns of each.
const ROWS: usize = 128;
const COLUMNS: usize = TAXELS / ROWS;

/// The bytes, aligned as flash is.
#[repr(align(4))]
pub struct Aligned(pub [u8; BYTES]);

/// In flash, as on a board.
pub static TABLE: Aligned = Aligned(bytes());

/// `bytes` with others from a position on.
pub(crate) const fn put<const N: usize>(mut bytes: [u8; N], at: usize, from: &[u8]) -> [u8; N] {
    let mut index = 0;
    while index < from.len() {
        bytes[at + index] = from[index];
        index += 1;
    }
    bytes
}

/// Sum of the reference garment's layout.
pub(crate) const fn layout_sum() -> [u8; 4] {
    // Rows and columns of the four panels; there is room for eight.
    let mut sizes = [0; 32];
    let mut panel = 0;
    while panel < 4 {
        (sizes[4 * panel], sizes[4 * panel + 2]) = ((ROWS / 4) as u8, COLUMNS as u8);
        panel += 1;
    }
    Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(&sizes).to_le_bytes()
}

#[allow(long_running_const_eval)] // a CRC of 41 KB
const fn bytes() -> [u8; BYTES] {
    let mut bytes = put([0; BYTES], 0, b"TXSF");
    let [low, high] = (TAXELS as u16).to_le_bytes();
    bytes = put(bytes, 8, &[2, 1, low, high]);
    let crc = Crc::<u32>::new(&CRC_32_ISO_HDLC);
    bytes = put(bytes, 12, &layout_sum());
    bytes = put(bytes, 20, b"torso");
    let mut taxel = 0;
    while taxel < TAXELS {
        // 10 mm apart, in units of 2^-14 m.
        let [x, y] = [(taxel % COLUMNS * 164) as i16, (taxel / COLUMNS * 164) as i16];
        let at = HEAD + 20 * taxel;
        // Link 0, no region.
        let numbers = [0xff00u16 as i16, x, y, 0, 0, 0, ONE, y, -x, 0];
        let mut index = 0;
        while index < numbers.len() {
            let [low, high] = numbers[index].to_le_bytes();
            (bytes[at + 2 * index], bytes[at + 2 * index + 1]) = (low, high);
            index += 1;
        }
        taxel += 1;
    }
    let (_, rest) = bytes.split_at(8);
    let sum = crc.checksum(rest).to_le_bytes();
    put(bytes, 4, &sum)
}

#[cfg(test)]
mod tests {
    use super::TABLE;
    use taxel_core::garment::{Garment, Layout};
    use taxel_core::surface::Table;

    #[test]
    fn it_is_a_table_of_the_reference_garment() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        assert!(Table::check(&TABLE.0, &layout).is_ok());
    }
}
