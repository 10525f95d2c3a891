//! The table of what takes how much flash and RAM, `docs/bench/sizes.txt`, and its comparison with an image.

use crate::elf::{self, Symbol};
use crate::{names, paths};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A section may differ from the table by so many percent, and by so many bytes however small it is.
const PERCENT: u32 = 2;
const BYTES: u32 = 256;
/// Crates and symbols that are listed: the largest.
const CRATES: usize = 12;
const SYMBOLS: usize = 24;
/// Where symbols belong whose names tell no crate: interrupts, arithmetic, copying.
const OTHERS: &str = "others";
/// Tables and texts of the flash that have no symbol.
const UNNAMED: &str = "constants without a name";
/// What stands before the name of the compiler.
const COMPILER: &str = "Built by ";
/// The heads of the three parts of the table.
const SECTION: &str = "section";
const CRATE: &str = "crate";
const SYMBOL: &str = "symbol";

/// Where the table lies.
fn file() -> PathBuf {
    paths::root().join("docs/bench/sizes.txt")
}

/// Writes the table of an image.
pub fn write(image: &Path) -> Result<(), String> {
    let table = read(image)?;
    let file = file();
    let folder = file.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder.and_then(|()| std::fs::write(&file, table)).map_err(|error| format!("{}: {error}", file.display()))
}

/// Compares an image with the table.
pub fn check(image: &Path) -> Result<(), String> {
    let kept = std::fs::read_to_string(file()).map_err(|error| format!("{}: {error}", file().display()))?;
    compare(&kept, &read(image)?)
}

/// The table of an image.
fn read(image: &Path) -> Result<String, String> {
    let bytes = std::fs::read(image).map_err(|error| format!("{}: {error}", image.display()))?;
    table(&bytes).ok_or(format!("{} is no ELF file with symbols", image.display()))
}

fn table(image: &[u8]) -> Option<String> {
    let sections = elf::sections(image)?;
    let mut symbols = elf::symbols(image)?;
    symbols.retain(|s| s.size > 0 && sections.get(s.section).is_some_and(|section| section.allocated));
    symbols.sort_by_key(|s| (s.address, s.size));
    // Two names for one thing.
    symbols.dedup_by_key(|s| s.address);
    let in_flash = |s: &Symbol| sections.get(s.section).is_some_and(|section| section.stored);
    let mut text = format!(
        "What the firmware takes of flash and RAM, in bytes. `cargo xtask firmware --write` writes this table;\n\
         `cargo xtask test --only sizes` fails where a section differs by more than {PERCENT} % and {BYTES} bytes.\n\
         {COMPILER}{}\n\n\
         {SECTION:<60}{:>10}\n",
        elf::compiler(image)?,
        "bytes"
    );
    for section in sections.iter().filter(|s| s.allocated && s.size > 0) {
        let _ = writeln!(text, "{:<60}{:>10}", section.name, section.size);
    }
    let mut crates: BTreeMap<String, [u32; 2]> = BTreeMap::new();
    for symbol in &symbols {
        let sums = crates.entry(names::of_crate(symbol.name).unwrap_or(OTHERS.into())).or_default();
        sums[usize::from(!in_flash(symbol))] += symbol.size;
    }
    let stored = sections.iter().filter(|s| s.allocated && s.stored).map(|s| s.size).sum::<u32>();
    let named = crates.values().map(|[flash, _]| flash).sum();
    crates.insert(UNNAMED.into(), [stored.saturating_sub(named), 0]);
    let mut crates: Vec<_> = crates.into_iter().collect();
    crates.sort_by_key(|(name, sums)| (std::cmp::Reverse(sums.iter().sum::<u32>()), name.clone()));
    let _ = writeln!(text, "\n{CRATE:<60}{:>10}{:>10}", "flash", "RAM");
    for (name, [flash, ram]) in crates.iter().take(CRATES) {
        let _ = writeln!(text, "{name:<60}{flash:>10}{ram:>10}");
    }
    symbols.sort_by_key(|s| std::cmp::Reverse(s.size));
    let _ = writeln!(text, "\n{SYMBOL:<60}{:>10}{:>10}", "flash", "RAM");
    for symbol in symbols.iter().take(SYMBOLS) {
        let name: String = names::path(symbol.name).chars().take(58).collect();
        let column = if in_flash(symbol) { 10 } else { 20 };
        let _ = writeln!(text, "{name:<60}{:>column$}", symbol.size);
    }
    Some(text)
}

/// Whether the sections of two tables are about as large; each that is not is named.
fn compare(kept: &str, found: &str) -> Result<(), String> {
    let compiler = |table: &str| {
        let named = table.lines().find_map(|line| line.strip_prefix(COMPILER));
        named.unwrap_or("an unknown compiler").to_owned()
    };
    let compilers = [kept, found].map(compiler);
    let (kept, found) = (sections(kept), sections(found));
    if kept.is_empty() {
        return Err(format!("{} has no sections", file().display()));
    }
    let near = |a: u32, b: u32| a.abs_diff(b) <= BYTES.max(a / 100 * PERCENT);
    let names = kept.keys().chain(found.keys()).collect::<std::collections::BTreeSet<_>>();
    let differ = names.into_iter().filter_map(|name| {
        let [a, b] = [&kept, &found].map(|table| table.get(name).copied().unwrap_or(0));
        (!near(a, b)).then(|| format!("{name} {b}, in the table {a}"))
    });
    let differ: Vec<String> = differ.collect();
    if differ.is_empty() {
        return Ok(());
    }
    let [before, now] = compilers;
    let built =
        if before == now { String::new() } else { format!("; built by {now}, the table's by {before}") };
    Err(format!("{}{built}; `cargo xtask firmware --write` where that is meant", differ.join("; ")))
}

/// The first part of a table.
fn sections(table: &str) -> BTreeMap<&str, u32> {
    let lines = table.lines().skip_while(|line| !line.starts_with(SECTION)).skip(1);
    let lines = lines.take_while(|line| !line.is_empty());
    lines
        .filter_map(|line| line.rsplit_once(' '))
        .filter_map(|(name, size)| Some((name.trim(), size.parse().ok()?)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::compare;

    fn table(text: u32, bss: u32) -> String {
        format!("What.\n\nsection  bytes\n.text {text}\n.bss   {bss}\n\ncrate  flash RAM\nx  5  6\n")
    }

    #[test]
    fn sections_that_differ_are_named() {
        assert_eq!(compare(&table(100_000, 500), &table(102_000, 756)), Ok(()));
        assert_eq!(compare(&table(100_000, 500), &table(98_000, 244)), Ok(()));
        let said = compare(&table(100_000, 500), &table(102_001, 757)).unwrap_err();
        assert!(
            said.starts_with(".bss 757, in the table 500; .text 102001, in the table 100000; "),
            "{said}"
        );
        let said = compare("section\n.text 300\n.data 300\n", "section\n.text 300\n").unwrap_err();
        assert!(said.starts_with(".data 0, in the table 300; "), "{said}");
        let said =
            compare("Built by rustc 1\n\nsection\n.text 1\n", "Built by rustc 2\n\nsection\n.text 9999\n")
                .unwrap_err();
        assert!(
            said.contains(".text 9999, in the table 1; built by rustc 2, the table's by rustc 1; "),
            "{said}"
        );
        assert!(compare("", &table(1, 1)).is_err());
    }
}
