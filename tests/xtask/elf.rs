//! Reads 32-bit ELF files: contents of the flash, memory, sections and symbols.

/// A loadable segment.
#[derive(Debug, PartialEq, Eq)]
pub struct Segment<'a> {
    /// Load address (LMA).
    pub stored: u32,
    /// Run address (VMA).
    pub runs: u32,
    /// Contents.
    pub bytes: &'a [u8],
    /// Size in memory.
    pub memory: u32,
}

/// A section.
#[derive(Debug, PartialEq, Eq)]
pub struct Section<'a> {
    /// Name, with a leading dot.
    pub name: &'a str,
    /// True if it takes memory or flash; false for debug information.
    pub allocated: bool,
    /// True if it is stored in the file; false for zeros.
    pub stored: bool,
    /// Size, bytes.
    pub size: u32,
}

/// A function or a variable.
#[derive(Debug, PartialEq, Eq)]
pub struct Symbol<'a> {
    /// Mangled name.
    pub name: &'a str,
    /// Index of its section.
    pub section: usize,
    /// Run address.
    pub address: u32,
    /// Size, bytes.
    pub size: u32,
}

const LOAD: u32 = 1;
const HEADERS_AT: usize = 28;
const HEADER_SIZE_AT: usize = 42;
const HEADER_COUNT_AT: usize = 44;

/// Loadable segments of a file; none if it is not a 32-bit ELF file.
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

const SECTIONS_AT: usize = 32;
const SECTION_SIZE_AT: usize = 46;
const SECTION_COUNT_AT: usize = 48;
const SECTION_NAMES_AT: usize = 50;
const SYMBOLS: u32 = 2;
const ZEROS: u32 = 8;
const ALLOCATED: u32 = 2;
const SYMBOL_SIZE: usize = 16;

/// Section headers of a file.
fn headers(file: &[u8]) -> Option<Vec<&[u8]>> {
    let start = word(file, SECTIONS_AT)? as usize;
    let size = half(file, SECTION_SIZE_AT)?;
    (0..half(file, SECTION_COUNT_AT)?).map(|index| file.get(start + index * size..)).collect()
}

/// Contents of a section.
fn content<'a>(file: &'a [u8], header: &[u8]) -> Option<&'a [u8]> {
    let (offset, size) = (word(header, 16)? as usize, word(header, 20)? as usize);
    file.get(offset..offset + size)
}

/// Sections of a file, in order.
pub fn sections(file: &[u8]) -> Option<Vec<Section<'_>>> {
    let headers = headers(file)?;
    let names = content(file, headers.get(half(file, SECTION_NAMES_AT)?)?)?;
    let section = |header: &&[u8]| {
        Some(Section {
            name: text(names, word(header, 0)?)?,
            allocated: word(header, 8)? & ALLOCATED != 0,
            stored: word(header, 4)? != ZEROS,
            size: word(header, 20)?,
        })
    };
    headers.iter().map(section).collect()
}

/// Name and version of the compiler of a file.
pub fn compiler(file: &[u8]) -> Option<&str> {
    let at = sections(file)?.iter().position(|section| section.name == ".comment")?;
    let notes = content(file, headers(file)?.get(at)?)?;
    let note = notes.split(|byte| *byte == 0).filter_map(|note| std::str::from_utf8(note).ok());
    let named = note.into_iter().find(|note| note.starts_with("rustc "))?;
    Some(named.split(" (").next().unwrap_or(named))
}

/// Functions and variables of a file.
pub fn symbols(file: &[u8]) -> Option<Vec<Symbol<'_>>> {
    let headers = headers(file)?;
    let table = headers.iter().find(|header| word(header, 4) == Some(SYMBOLS))?;
    let names = content(file, headers.get(word(table, 24)? as usize)?)?;
    let symbol = |entry: &'_ [u8]| {
        Some(Symbol {
            name: text(names, word(entry, 0)?)?,
            section: half(entry, 14)?,
            address: word(entry, 4)?,
            size: word(entry, 8)?,
        })
    };
    content(file, table)?.chunks_exact(SYMBOL_SIZE).map(symbol).collect()
}

/// A zero-terminated text.
fn text(bytes: &[u8], at: u32) -> Option<&str> {
    let from = bytes.get(at as usize..)?;
    std::str::from_utf8(from.split(|byte| *byte == 0).next()?).ok()
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

    #[test]
    fn reads_what_it_is_for() {
        // Header, names with notes and symbols at 52, then four section headers: names, symbols, memory for
        // zeros, notes.
        let names = b"\0.text\0.bss\0it\0.comment\0Linker: x\0rustc version 1.95.0 (5980 2026)\0";
        let mut file = vec![0; 52];
        file[..6].copy_from_slice(b"\x7fELF\x01\x01");
        let symbols = (52 + names.len()) as u32;
        file[SECTIONS_AT..][..4].copy_from_slice(&(symbols + SYMBOL_SIZE as u32).to_le_bytes());
        file[SECTION_SIZE_AT] = 40;
        file[SECTION_COUNT_AT] = 4;
        file.extend(names);
        let words = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<_>>();
        file.extend(words(&[12, 0x2000_0004, 8, 2 << 16]));
        file.extend(words(&[1, 3, ALLOCATED, 0, 52, names.len() as u32, 0, 0, 0, 0]));
        file.extend(words(&[0, SYMBOLS, 0, 0, symbols, SYMBOL_SIZE as u32, 0, 0, 0, 0]));
        file.extend(words(&[7, ZEROS, ALLOCATED, 0, 0, 99, 0, 0, 0, 0]));
        file.extend(words(&[15, 1, 0, 0, 52 + 24, names.len() as u32 - 24, 0, 0, 0, 0]));
        let sections = sections(&file).unwrap();
        let text = Section { name: ".text", allocated: true, stored: true, size: names.len() as u32 };
        assert_eq!(sections[0], text);
        assert!(!sections[1].allocated);
        assert_eq!(sections[2], Section { name: ".bss", allocated: true, stored: false, size: 99 });
        let it = Symbol { name: "it", section: 2, address: 0x2000_0004, size: 8 };
        assert_eq!(super::symbols(&file), Some(vec![it]));
        assert_eq!(compiler(&file), Some("rustc version 1.95.0"));
        assert_eq!(super::symbols(&file[..file.len() - 100]), None);
    }
}
