//! The board's serial number: the unique id of its flash chip, in hexadecimal. The RP2040 has none of its own.

use crate::store::Flash;
use static_cell::StaticCell;

/// Bytes of the id.
const ID: usize = 8;

/// Reads the serial number; none if the chip has no id and answers with bytes that are all equal. Nothing else
/// may read the flash meanwhile. Must be called once.
pub fn read(flash: &mut Flash) -> Option<&'static str> {
    static NUMBER: StaticCell<[u8; 2 * ID]> = StaticCell::new();
    let mut id = [0; ID];
    flash.blocking_unique_id(&mut id).ok()?;
    if id.iter().all(|byte| *byte == id[0]) {
        return None;
    }
    let mut number = [0; 2 * ID];
    for (digits, byte) in number.as_chunks_mut::<2>().0.iter_mut().zip(id) {
        *digits = [byte >> 4, byte & 0xf].map(|digit| b"0123456789ABCDEF"[usize::from(digit)]);
    }
    core::str::from_utf8(NUMBER.init(number)).ok()
}
