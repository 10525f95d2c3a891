//! `taxel flash`: writes the firmware to a board, by its boot loader's drive or a debug probe.

use crate::fault::Fault;
use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use taxel::files::input;

/// Bytes of a UF2 block.
const BLOCK: usize = 512;
/// First two words of each block, and its last.
const MARKS: [u32; 3] = [0x0a32_4655, 0x9e5d_5157, 0x0ab1_6f30];
/// Family id of the RP2040.
const FAMILY: u32 = 0xe48b_ff56;
/// Flags of a block: only "family id present".
const HAS_FAMILY: u32 = 0x2000;
/// Payload of a block, bytes.
const PAGE: u32 = 256;
/// Flash range of the program. The board's settings are behind it and survive a new firmware.
const PROGRAM: std::ops::Range<u32> = 0x1000_0000..0x1000_0000 + (2048 - 216) * 1024;
/// File that identifies the boot loader's drive, and a word in it.
const MARKER: (&str, &str) = ("INFO_UF2.TXT", "RPI-RP2");

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel flash taxel.uf2
  taxel flash taxel.elf";

/// Write the firmware to a board
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct FlashArgs {
    /// The firmware: UF2 for the boot loader's drive, ELF for a debug probe; `cargo xtask firmware` builds both
    #[arg(value_name = "UF2|ELF")]
    pub file: PathBuf,
    /// The boot loader's drive [default: the one that is found]
    #[arg(long, value_name = "FOLDER")]
    pub drive: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: FlashArgs) -> Result<()> {
    let name = args.file.display();
    let image = input::bytes(&args.file).with_context(|| format!("{name} cannot be read"))?;
    if image.starts_with(b"\x7fELF") {
        return probe(&args.file);
    }
    check(&image).with_context(|| name.to_string())?;
    let drive = match &args.drive {
        Some(drive) => {
            ensure!(
                is_drive(drive),
                "{} is not the drive of an RP2040's boot loader: it has no {}",
                drive.display(),
                MARKER.0
            );
            drive.clone()
        }
        None => only(drives())?,
    };
    copy(&image, &drive.join("taxel.uf2"))?;
    println!("{name} is on {}: the board restarts by itself; `taxel doctor` checks it.", drive.display());
    Ok(())
}

/// Mounted drives of boot loaders.
pub fn drives() -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = places().into_iter().filter(|place| is_drive(place)).collect();
    found.sort();
    found.dedup();
    found
}

fn only(drives: Vec<PathBuf>) -> Result<PathBuf> {
    match drives.as_slice() {
        [drive] => Ok(drive.clone()),
        [] => bail!(Fault::board(format!(
            "no drive {} is mounted: hold BOOTSEL while plugging the board in, open the drive once if nothing mounts it by itself, \
             and try again",
            MARKER.1
        ))),
        many => {
            let count = many.len();
            bail!(Fault::usage(format!("{count} boards wait in their boot loaders: choose one with --drive")))
        }
    }
}

/// Folders under which this system mounts drives.
fn places() -> Vec<PathBuf> {
    if cfg!(windows) {
        return (b'D'..=b'Z').map(|letter| PathBuf::from(format!("{}:\\", char::from(letter)))).collect();
    }
    let mounts = fs::read_to_string("/proc/mounts").unwrap_or_default();
    let field = |line: &str| line.split(' ').nth(1).map(|place| PathBuf::from(place.replace("\\040", " ")));
    let volumes = fs::read_dir("/Volumes").into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    mounts.lines().filter_map(field).chain(volumes).collect()
}

fn is_drive(place: &Path) -> bool {
    fs::read_to_string(place.join(MARKER.0)).is_ok_and(|text| text.contains(MARKER.1))
}

/// Checks for a complete UF2 for the RP2040 that writes one contiguous program and nothing else. Errors name
/// the block.
fn check(image: &[u8]) -> Result<()> {
    let (blocks, rest) = image.as_chunks::<BLOCK>();
    ensure!(
        !blocks.is_empty() && rest.is_empty(),
        "it is neither an ELF nor a UF2, whose length is a multiple of {BLOCK} bytes"
    );
    for (index, block) in blocks.iter().enumerate() {
        let word = |at: usize| u32::from_le_bytes([block[at], block[at + 1], block[at + 2], block[at + 3]]);
        ensure!([word(0), word(4), word(BLOCK - 4)] == MARKS, "block {index} of it is not a UF2 block");
        ensure!(word(28) == FAMILY, "block {index} of it is for another microcontroller than the RP2040");
        ensure!(
            word(20) as usize == index && word(24) as usize == blocks.len(),
            "block {index} of it says it is number {} of {}: the file is incomplete",
            word(20),
            word(24)
        );
        let (flags, address, length) = (word(8), word(12), word(16));
        ensure!(
            flags == HAS_FAMILY,
            "block {index} of it has the flags {flags:#x}, expected {HAS_FAMILY:#x}"
        );
        ensure!(length == PAGE, "block {index} of it writes {length} bytes, expected {PAGE}");
        ensure!(
            PROGRAM.contains(&address),
            "block {index} of it is for address {address:#x}, outside of the program ({:#x} to {:#x})",
            PROGRAM.start,
            PROGRAM.end - 1
        );
        // The first address is the beginning, where the boot loader looks for a program; in gaps the old
        // contents would remain.
        let expected = PROGRAM.start + PAGE * index as u32;
        ensure!(
            address == expected,
            "block {index} of it is for address {address:#x}, expected {expected:#x}: a program is in one piece"
        );
    }
    Ok(())
}

fn copy(image: &[u8], to: &Path) -> Result<()> {
    let wrong = || format!("{} cannot be written", to.display());
    let mut file = File::create(to).with_context(wrong)?;
    file.write_all(image).with_context(wrong)?;
    // The board restarts as soon as it has the last block, and its drive disappears.
    let _ = file.sync_all();
    Ok(())
}

fn probe(elf: &Path) -> Result<()> {
    for step in
        [vec!["download", "--chip", "RP2040", &elf.to_string_lossy()], vec!["reset", "--chip", "RP2040"]]
    {
        let status = Command::new("probe-rs").args(&step).status().context(
            "probe-rs is not installed, which writes an ELF by a debug probe (https://probe.rs); without a probe, give the UF2",
        )?;
        ensure!(status.success(), "probe-rs {} failed", step[0]);
    }
    println!("{} is on the board: `taxel doctor` checks it.", elf.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(index: u32, count: u32) -> Vec<u8> {
        let mut block = vec![0; BLOCK];
        for (at, word) in
            [(0, MARKS[0]), (4, MARKS[1]), (20, index), (24, count), (28, FAMILY), (BLOCK - 4, MARKS[2])]
                .into_iter()
                .chain([(8, HAS_FAMILY), (12, PROGRAM.start + PAGE * index), (16, PAGE)])
        {
            block[at..at + 4].copy_from_slice(&u32::to_le_bytes(word));
        }
        block
    }

    #[test]
    fn a_file_that_is_no_firmware_is_refused_by_its_block() {
        let why = |image: &[u8]| check(image).unwrap_err().to_string();
        let whole = [block(0, 2), block(1, 2)].concat();
        assert!(check(&whole).is_ok());
        assert!(why(&whole[..700]).contains("multiple of 512"));
        assert!(why(&whole[..512]).contains("number 0 of 2"));
        assert!(why(&[block(0, 2), vec![0; BLOCK]].concat()).starts_with("block 1 of it is not a UF2 block"));
        let mut other = whole.clone();
        other[BLOCK + 28] ^= 1;
        assert!(why(&other).contains("another microcontroller"));
    }

    #[test]
    fn a_block_that_writes_elsewhere_than_the_program_is_refused() {
        let why = |at: usize, number: u32| {
            let mut image = [block(0, 2), block(1, 2)].concat();
            image[BLOCK + at..][..4].copy_from_slice(&number.to_le_bytes());
            check(&image).unwrap_err().to_string()
        };
        for address in [0x101c_a000, 0x1000_0000 - 256, 0x2000_0000, 0, u32::MAX, 0x1100_0000] {
            let outside = format!("block 1 of it is for address {address:#x}, outside of the program");
            assert!(why(12, address).starts_with(&outside), "{address:#x}");
        }
        // A page twice, a gap, and a page that overlaps another.
        for address in [0x1000_0000, 0x1000_0200, 0x1000_0180] {
            assert!(why(12, address).ends_with("a program is in one piece"), "{address:#x}");
        }
        assert!(why(16, 476).contains("writes 476 bytes"));
        assert!(why(8, HAS_FAMILY | 1).contains("flags 0x2001"), "a block that is not for the flash");
        let many = PROGRAM.len() as u32 / PAGE;
        let image = |blocks: u32| (0..blocks).flat_map(|index| block(index, blocks)).collect::<Vec<_>>();
        assert!(check(&image(many)).is_ok());
        assert!(check(&image(many + 1)).unwrap_err().to_string().contains("outside of the program"));
    }

    #[test]
    fn the_program_ends_where_the_memory_map_says() {
        let map = include_str!("../../../../../memory.x");
        assert!(
            map.contains("ORIGIN = 0x10000000") && map.contains("LENGTH = 2048K - 0x100 - 216K"),
            "{map}"
        );
        assert_eq!(PROGRAM.end, 0x1000_0100 + 2048 * 1024 - 0x100 - 216 * 1024);
    }

    #[test]
    fn it_is_copied_to_a_drive_that_says_what_it_is() {
        let folder = std::env::temp_dir().join(format!("taxel-flash-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (file, image) = (folder.join("it.bin"), block(0, 1));
        fs::write(&file, &image).unwrap();
        let args = FlashArgs { file, drive: Some(folder.clone()) };
        assert!(run(args.clone()).unwrap_err().to_string().contains("it has no INFO_UF2.TXT"));
        fs::write(folder.join("INFO_UF2.TXT"), "UF2 Bootloader v3.0\nBoard-ID: RPI-RP2\n").unwrap();
        run(args).unwrap();
        assert_eq!(fs::read(folder.join("taxel.uf2")).unwrap(), image);
        fs::remove_dir_all(folder).unwrap();
        assert!(only(vec![]).unwrap_err().to_string().contains("BOOTSEL"));
        assert!(only(vec!["a".into(), "b".into()]).unwrap_err().to_string().contains("--drive"));
    }
}
