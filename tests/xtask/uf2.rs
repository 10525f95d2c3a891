//! UF2, the file format of a board's boot loader, copied to its drive: blocks of 512 bytes, each with 256
//! bytes of flash and their address.

use crate::elf::Segment;

const FAMILY_RP2040: u32 = 0xe48b_ff56;
const FLASH: std::ops::Range<u32> = 0x1000_0000..0x1100_0000;
const PAGE: u32 = 256;
const BLOCK: usize = 512;
const START: [u32; 2] = [0x0a32_4655, 0x9e5d_5157];
const END: u32 = 0x0ab1_6f30;
const HAS_FAMILY: u32 = 0x2000;
const ERASED: u8 = 0xff;

/// UF2 file for the flash contents of an image.
pub fn file(segments: &[Segment]) -> Result<Vec<u8>, String> {
    let stored = || segments.iter().filter(|s| !s.bytes.is_empty());
    if let Some(outside) = stored().find(|s| !FLASH.contains(&s.stored)) {
        return Err(format!("a segment is stored at {:#x}, which is not flash", outside.stored));
    }
    let start = stored().map(|s| s.stored / PAGE * PAGE).min().ok_or("the image stores nothing")?;
    let end = stored().map(|s| s.stored + s.bytes.len() as u32).max().unwrap_or(start);
    // Contiguous: the boot loader erases a sector when the first of its pages arrives.
    let mut image = vec![ERASED; (end - start).next_multiple_of(PAGE) as usize];
    for segment in stored() {
        image[(segment.stored - start) as usize..][..segment.bytes.len()].copy_from_slice(segment.bytes);
    }
    let pages = image.chunks(PAGE as usize);
    let count = pages.len() as u32;
    Ok(pages.zip(0..).flat_map(|(page, index)| block(page, start + index * PAGE, index, count)).collect())
}

fn block(page: &[u8], address: u32, index: u32, count: u32) -> [u8; BLOCK] {
    let mut block = [0; BLOCK];
    let header = [START[0], START[1], HAS_FAMILY, address, PAGE, index, count, FAMILY_RP2040];
    for (slot, word) in block.chunks_mut(4).zip(header) {
        slot.copy_from_slice(&word.to_le_bytes());
    }
    block[32..][..page.len()].copy_from_slice(page);
    block[BLOCK - 4..].copy_from_slice(&END.to_le_bytes());
    block
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(stored: u32, bytes: &[u8]) -> Segment<'_> {
        Segment { stored, runs: stored, bytes, memory: bytes.len() as u32 }
    }

    fn word(file: &[u8], at: usize) -> u32 {
        u32::from_le_bytes(file[at..at + 4].try_into().unwrap())
    }

    #[test]
    fn pages_are_numbered_and_gaps_are_erased() {
        let long = [7; 300];
        let file = file(&[segment(0x1000_0100, &long), segment(0x1000_0000, &[1, 2, 3])]).unwrap();
        assert_eq!(file.len(), 3 * BLOCK);
        for index in 0..3 {
            let block = &file[index * BLOCK..][..BLOCK];
            let header: Vec<u32> = (0..8).map(|i| word(block, 4 * i)).collect();
            let address = 0x1000_0000 + 256 * index as u32;
            assert_eq!(
                header,
                [0x0a32_4655, 0x9e5d_5157, 0x2000, address, 256, index as u32, 3, 0xe48b_ff56]
            );
            assert_eq!(word(block, 508), 0x0ab1_6f30);
            assert!(block[32 + 256..508].iter().all(|byte| *byte == 0));
        }
        assert_eq!(file[32..36], [1, 2, 3, 0xff]);
        assert_eq!(file[BLOCK + 32..BLOCK + 34], [7, 7]);
        assert_eq!(file[2 * BLOCK + 32 + 43..][..2], [7, 0xff]);
    }

    #[test]
    fn what_is_not_flash_is_refused() {
        assert!(file(&[segment(0x2000_0000, &[1])]).is_err());
        assert!(file(&[segment(0x1000_0000, &[])]).is_err());
    }
}
