//! What the program headers of a 32-bit ELF file say: what goes into flash, and how much memory it takes.

/// A loadable piece.
#[derive(Debug, PartialEq, Eq)]
pub struct Segment<'a> {
    /// Where it is stored.
    pub stored: u32,
    /// Where it is when the program runs.
    pub runs: u32,
    /// What is stored.
    pub bytes: &'a [u8],
    /// Memory that it takes when the program runs.
    pub memory: u32,
}

const LOAD: u32 = 1;
const HEADERS_AT: usize = 28;
const HEADER_SIZE_AT: usize = 42;
const HEADER_COUNT_AT: usize = 44;

/// The loadable pieces of a file; none if it is no such file.
pub fn segments(file: &[u8]) -> Option<Vec<Segment<'_>>> {
    if !file.starts_with(b"\x7fELF\x01\x01") {
        return None;
    }
    let start = word(file, HEADERS_AT)? as usize;
    let size = half(file, HEADER_SIZE_AT)?;
    let mut found = Vec::new();
    for index in 0..half(file, HEADER_COUNT_AT)? {
        let header = file.get(start + index * size..)?;
        if word(header, 0)? != LOAD {
            continue;
        }
        let (offset, stored_size) = (word(header, 4)? as usize, word(header, 16)? as usize);
        found.push(Segment {
            stored: word(header, 12)?,
            runs: word(header, 8)?,
            bytes: file.get(offset..offset + stored_size)?,
            memory: word(header, 20)?,
        });
    }
    Some(found)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

fn half(bytes: &[u8], at: usize) -> Option<usize> {
    Some(usize::from(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_is_loaded() {
        let mut file = vec![0; 52 + 32];
        file[..6].copy_from_slice(b"\x7fELF\x01\x01");
        file[HEADERS_AT] = 52;
        file[HEADER_SIZE_AT] = 32;
        file[HEADER_COUNT_AT] = 1;
        for (word, value) in [LOAD, 84, 0x2000_0000, 0x1000_0100, 3, 8].into_iter().enumerate() {
            file[52 + 4 * word..][..4].copy_from_slice(&u32::to_le_bytes(value));
        }
        file.extend(b"abc");
        let segment = Segment { stored: 0x1000_0100, runs: 0x2000_0000, bytes: b"abc", memory: 8 };
        assert_eq!(segments(&file), Some(vec![segment]));
        assert_eq!(segments(&file[..80]), None);
        assert_eq!(segments(b"#!/bin/sh"), None);
    }
}
