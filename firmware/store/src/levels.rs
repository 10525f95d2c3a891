//! Levels of the outputs, in two sectors of their own: a board reads them in place at start-up, before its
//! memory is initialised.
//!
//! | word | what |
//! |---|---|
//! | 0 | number of the record: the later is in force |
//! | 1 | pins that are driven, bit `i` for GPIO `i` |
//! | 2 | pins of these that are high |
//! | 3 | CRC-32/ISO-HDLC of the bytes before, in the order of the flash |
//!
//! A record is written to the sector that does not hold the one in force. So one of the two is always in
//! force, whatever happens during the write.

use crate::store::StoreError;
use embedded_storage::nor_flash::NorFlash;
use taxel_core::board::Saved;
use taxel_core::react::Levels;

/// Number of words of a record.
const WORDS: usize = 4;

/// A record: its words in the flash.
pub type Record = [u32; WORDS];

/// Number of bytes of a record.
const BYTES: usize = 4 * WORDS;
/// Polynomial of the CRC, the lowest bit first.
const POLYNOMIAL: u32 = 0xedb8_8320;

/// Returns the levels in force; none if neither record is valid. Uses only registers and the stack.
#[inline]
pub fn in_force(records: [Record; 2]) -> Option<Levels> {
    let [_, pins, high, _] = records[newest(&records)?];
    Some(Levels { pins, high })
}

/// Index of the record in force.
#[inline]
fn newest(records: &[Record; 2]) -> Option<usize> {
    let [a, b] = records;
    match (is_whole(a), is_whole(b)) {
        (true, true) => Some(usize::from(b[0].wrapping_sub(a[0]) < 1 << 31)),
        (true, false) => Some(0),
        (false, true) => Some(1),
        (false, false) => None,
    }
}

#[inline]
fn is_whole(record: &Record) -> bool {
    let [number, pins, high, sum] = *record;
    sum_of([number, pins, high]) == sum
}

/// Bitwise CRC: loading a table from a flash that has just been powered takes time. Out of line: three places
/// need it.
#[inline(never)]
fn sum_of(words: [u32; 3]) -> u32 {
    let mut crc = u32::MAX;
    for word in words {
        crc ^= word;
        for _ in 0..32 {
            crc = (crc >> 1) ^ (POLYNOMIAL & (crc & 1).wrapping_neg());
        }
    }
    !crc
}

/// Stores levels in the sectors that begin at `sectors`. Writes nothing if they are in force already, or if
/// the sectors are blank and no pin is to be driven.
pub fn keep_levels<F: NorFlash>(
    flash: &mut F,
    sectors: [u32; 2],
    levels: Levels,
) -> Result<Saved, StoreError> {
    let records = [read(flash, sectors[0])?, read(flash, sectors[1])?];
    if in_force(records).unwrap_or_default() == levels {
        return Ok(Saved::Unchanged);
    }
    let (place, number) = match newest(&records) {
        Some(last) => (1 - last, records[last][0].wrapping_add(1)),
        None => (0, 0),
    };
    let words = [number, levels.pins, levels.high];
    let record = [number, levels.pins, levels.high, sum_of(words)].map(u32::to_le_bytes);
    let start = sectors[place];
    let done = flash
        .erase(start, start + F::ERASE_SIZE as u32)
        .and_then(|()| flash.write(start, record.as_flattened()));
    done.map_err(|_| StoreError::Flash)?;
    Ok(Saved::Written)
}

fn read<F: NorFlash>(flash: &mut F, start: u32) -> Result<Record, StoreError> {
    let mut bytes = [0; BYTES];
    flash.read(start, &mut bytes).map_err(|_| StoreError::Flash)?;
    let (words, _) = bytes.as_chunks();
    Ok(core::array::from_fn(|at| u32::from_le_bytes(words[at])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crc::{CRC_32_ISO_HDLC, Crc};

    fn record(number: u32, pins: u32, high: u32) -> Record {
        [number, pins, high, sum_of([number, pins, high])]
    }

    #[test]
    fn the_sum_is_that_of_the_crate() {
        for words in [[0; 3], [u32::MAX; 3], [1, 0x0004_0000, 0x8000_0000]] {
            let bytes = words.map(u32::to_le_bytes);
            assert_eq!(sum_of(words), Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(bytes.as_flattened()));
        }
    }

    #[test]
    fn the_later_of_the_whole_records_is_in_force() {
        let blank = [u32::MAX; WORDS];
        let levels = |pins, high| Some(Levels { pins, high });
        assert_eq!(in_force([blank, blank]), None);
        assert_eq!(in_force([[0; WORDS], [0x5555_5555; WORDS]]), None);
        assert_eq!(in_force([record(7, 3, 1), blank]), levels(3, 1));
        assert_eq!(in_force([blank, record(7, 3, 1)]), levels(3, 1));
        assert_eq!(in_force([record(7, 3, 1), record(8, 4, 4)]), levels(4, 4));
        assert_eq!(
            in_force([record(0, 3, 1), record(u32::MAX, 4, 4)]),
            levels(3, 1),
            "the number turns over"
        );
        assert_eq!(in_force([record(5, 3, 1), record(5 + (1 << 31), 4, 4)]), levels(3, 1), "half a turn");
        for bit in 0..32 * WORDS {
            let mut torn = record(9, 4, 4);
            torn[bit / 32] ^= 1 << (bit % 32);
            assert_eq!(in_force([record(8, 3, 1), torn]), levels(3, 1), "bit {bit}");
        }
    }
}
