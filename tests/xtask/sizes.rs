//! Table of the use of flash and RAM, `docs/evidence/bench/sizes.txt`, and its comparison with an image.

use crate::elf::{self, Symbol};
use crate::firmware::Image;
use crate::{names, paths};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::PathBuf;

/// Tolerance for a section, per cent, and least tolerance, bytes, if both images are by the same compiler.
const PERCENT: u32 = 2;
const BYTES: u32 = 256;
/// Limits of flash and RAM for any compiler, KiB: a tenth of flash above the table, and 48 KiB left for the
/// stack.
const MOST: [(&str, u64); 2] = [("flash", 528), ("RAM", 216)];
/// Listed crates and symbols: the largest.
const CRATES: usize = 12;
const SYMBOLS: usize = 24;
/// Group of symbols without a crate: interrupts, arithmetic, copying.
const OTHERS: &str = "others";
/// Constants of the flash without a symbol.
const UNNAMED: &str = "constants without a name";
/// Prefix of the compiler's name.
const COMPILER: &str = "Built by ";
/// Headings of the three parts of the table.
const SECTION: &str = "section";
const CRATE: &str = "crate";
const SYMBOL: &str = "symbol";

/// Path of the table.
fn file() -> PathBuf {
    paths::root().join("docs/evidence/bench/sizes.txt")
}

/// Writes the table of an image, and that of images that leave features out.
pub fn write(image: &Image, features: &str) -> Result<(), String> {
    let table = format!("{}\n{features}", read(image)?);
    let file = file();
    let folder = file.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder.and_then(|()| std::fs::write(&file, table)).map_err(|error| format!("{}: {error}", file.display()))
}

/// Checks an image against the limits, and against the table: strictly if the table is by the same compiler,
/// else returns both tables' sections for comparison.
pub fn check(image: &Image) -> Result<String, String> {
    for ((what, most), size) in MOST.into_iter().zip(image.sizes()) {
        if size > most * 1024 {
            return Err(format!("{what}: {:.1} KiB, at most {most}", size as f64 / 1024.0));
        }
    }
    let kept = std::fs::read_to_string(file()).map_err(|error| format!("{}: {error}", file().display()))?;
    compare(&kept, &read(image)?)
}

/// Builds the table of an image.
fn read(image: &Image) -> Result<String, String> {
    let bytes = std::fs::read(&image.elf).map_err(|error| format!("{}: {error}", image.elf.display()))?;
    table(&bytes, &image.compiler).ok_or(format!("{} is not an ELF file with symbols", image.elf.display()))
}

fn table(image: &[u8], compiler: &str) -> Option<String> {
    let sections = elf::sections(image)?;
    let mut symbols = elf::symbols(image)?;
    symbols.retain(|s| s.size > 0 && sections.get(s.section).is_some_and(|section| section.allocated));
    symbols.sort_by_key(|s| (s.address, s.size));
    // Two names for one address.
    symbols.dedup_by_key(|s| s.address);
    let in_flash = |s: &Symbol| sections.get(s.section).is_some_and(|section| section.stored);
    let mut text = format!(
        "What the firmware takes of flash and RAM, in bytes. `cargo xtask firmware --write` writes this table;\n\
         `cargo xtask test --only firmware` fails where a section differs by more than {PERCENT} % and {BYTES} bytes, if the\n\
         compiler is the same; with any compiler, where the image takes more than {} KiB of flash or {} of RAM.\n\
         {COMPILER}{compiler}\n\n\
         {SECTION:<60}{:>10}\n",
        MOST[0].1, MOST[1].1, "bytes"
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

/// Compares the sections of two tables; the error names each that differs too much. Tables of different
/// compilers are listed side by side.
fn compare(kept: &str, found: &str) -> Result<String, String> {
    let compilers = [kept, found].map(compiler);
    let (kept, found) = (sections(kept), sections(found));
    if kept.is_empty() {
        return Err(format!("{} has no sections", file().display()));
    }
    let names: BTreeSet<&str> = kept.keys().chain(found.keys()).copied().collect();
    let sizes = |name: &str| [&kept, &found].map(|table| table.get(name).copied().unwrap_or(0));
    let [before, now] = compilers;
    if before != now {
        let line = |name: &str| {
            let [a, b] = sizes(name);
            format!("  {name:<20}{b:>10}{a:>10}{:>8.3}\n", f64::from(b) / f64::from(a.max(1)))
        };
        let lines: String = names.into_iter().map(line).collect();
        return Ok(format!("  beside the table, which is of {before}; this image is of {now}:\n{lines}"));
    }
    let near = |[a, b]: [u32; 2]| a.abs_diff(b) <= BYTES.max(a / 100 * PERCENT);
    let differ = names.into_iter().filter(|name| !near(sizes(name)));
    let differ: Vec<String> = differ
        .map(|name| {
            let [a, b] = sizes(name);
            format!("{name} {b}, in the table {a}")
        })
        .collect();
    if differ.is_empty() {
        return Ok(String::new());
    }
    Err(format!("{}; `cargo xtask firmware --write` where that is meant", differ.join("; ")))
}

/// Compiler of a table's image.
fn compiler(table: &str) -> &str {
    table.lines().find_map(|line| line.strip_prefix(COMPILER)).unwrap_or("an unknown compiler")
}

/// First part of a table.
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
        assert_eq!(compare(&table(100_000, 500), &table(102_000, 756)), Ok(String::new()));
        assert_eq!(compare(&table(100_000, 500), &table(98_000, 244)), Ok(String::new()));
        let said = compare(&table(100_000, 500), &table(102_001, 757)).unwrap_err();
        assert!(
            said.starts_with(".bss 757, in the table 500; .text 102001, in the table 100000; "),
            "{said}"
        );
        let said = compare("section\n.text 300\n.data 300\n", "section\n.text 300\n").unwrap_err();
        assert!(said.starts_with(".data 0, in the table 300; "), "{said}");
        assert!(compare("", &table(1, 1)).is_err());
    }

    #[test]
    fn sections_of_another_compiler_stand_beside_the_table() {
        let table = |compiler, text| format!("Built by {compiler}\n\nsection\n.text {text}\n");
        let said = compare(&table("rustc 1", 1000), &table("rustc 2", 1100)).unwrap();
        assert!(said.contains("which is of rustc 1; this image is of rustc 2"), "{said}");
        assert!(said.contains(".text                     1100      1000   1.100"), "{said}");
        assert!(compare(&table("rustc 1", 1000), &table("rustc 1", 1300)).is_err());
    }
}
