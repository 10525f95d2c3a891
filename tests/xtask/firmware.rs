//! Builds, measures and runs the firmware image.

use crate::cross::Toolchain;
use crate::{elf, install, paths, process, uf2};
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

const FLASH: u64 = 2048 * 1024 - 160 * 1024;
const RAM: std::ops::Range<u32> = 0x2000_0000..0x2004_2000;
/// Part of the RAM that memory.x reserves for the stack.
const STACK: u64 = 48 * 1024;

/// A finished image.
#[derive(Debug)]
pub struct Image {
    /// ELF file for debug probes and the emulator.
    pub elf: PathBuf,
    uf2: PathBuf,
    flash: u64,
    ram: u64,
    /// Compiler, and origin of its library.
    pub compiler: String,
}

impl Image {
    /// Size of flash, and of RAM besides the stack, bytes.
    pub fn sizes(&self) -> [u64; 2] {
        [self.flash, self.ram]
    }
}

impl fmt::Display for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kib = |bytes: u64| bytes as f64 / 1024.0;
        let ram = u64::from(RAM.end - RAM.start) - STACK;
        writeln!(f, "ELF    {}", self.elf.display())?;
        writeln!(f, "UF2    {}", self.uf2.display())?;
        writeln!(f, "by     {}", self.compiler)?;
        writeln!(f, "flash  {:.1} of {:.0} KiB", kib(self.flash), kib(FLASH))?;
        writeln!(
            f,
            "RAM    {:.1} of {:.0} KiB, besides {:.0} for the stack",
            kib(self.ram),
            kib(ram),
            kib(STACK)
        )
    }
}

/// Builds the firmware.
pub fn build() -> Result<Image, String> {
    let toolchain = Toolchain::find()?;
    process::run(&mut command(&toolchain))?;
    measure(&toolchain)
}

/// The command that builds the firmware.
pub fn command(toolchain: &Toolchain) -> Command {
    toolchain.cargo("build", &paths::firmware())
}

/// The command that builds the benchmark image.
pub fn bench_command(toolchain: &Toolchain) -> Command {
    let mut cargo = command(toolchain);
    cargo.args(["--bin", "bench", "--features", "bench"]);
    cargo
}

/// Path of the benchmark image.
pub fn bench_elf(toolchain: &Toolchain) -> PathBuf {
    toolchain.folder().join(crate::cross::TARGET).join("release/bench")
}

/// Writes the UF2 beside the built ELF, and measures both.
pub fn measure(toolchain: &Toolchain) -> Result<Image, String> {
    let elf = toolchain.folder().join(crate::cross::TARGET).join("release/taxel-firmware");
    let [flash, ram] = sizes_of(&elf)?;
    let uf2 = to_uf2(&elf)?;
    let compiler = compiler(&elf, toolchain)?;
    Ok(Image { elf, uf2, flash, ram, compiler })
}

/// Writes the UF2 beside a built ELF.
pub fn to_uf2(elf: &Path) -> Result<PathBuf, String> {
    let file = read(elf)?;
    let segments = elf::segments(&file).ok_or(format!("{} is not an ELF file", elf.display()))?;
    let uf2 = elf.with_extension("uf2");
    std::fs::write(&uf2, uf2::file(&segments)?).map_err(|error| format!("{}: {error}", uf2.display()))?;
    Ok(uf2)
}

fn read(elf: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(elf).map_err(|error| format!("{}: {error}", elf.display()))
}

/// Flash and RAM of an image, bytes.
fn sizes(segments: &[elf::Segment<'_>]) -> [u64; 2] {
    let flash = segments.iter().map(|s| s.bytes.len() as u64).sum();
    let ram = segments.iter().filter(|s| RAM.contains(&s.runs)).map(|s| u64::from(s.memory)).sum();
    [flash, ram]
}

/// Flash and RAM of a built ELF, bytes.
pub fn sizes_of(elf: &Path) -> Result<[u64; 2], String> {
    let file = read(elf)?;
    let segments = elf::segments(&file).ok_or(format!("{} is not an ELF file", elf.display()))?;
    Ok(sizes(&segments))
}

/// Compiler of an image, as stored in it, and origin of its library.
pub fn compiler(image: &Path, toolchain: &Toolchain) -> Result<String, String> {
    let file = std::fs::read(image).map_err(|error| format!("{}: {error}", image.display()))?;
    let compiler = elf::compiler(&file).ok_or(format!("{} does not name its compiler", image.display()))?;
    Ok(format!("{compiler}, {}", toolchain.library()))
}

/// Builds the firmware with its lock file; immediate if nothing has changed.
pub fn image(toolchain: &Toolchain, log: &Path) -> Result<Image, String> {
    process::run_into(command(toolchain).arg("--locked"), log).and_then(|()| measure(toolchain))
}

/// The command that compiles only the core, up to its code for the processor: that is what images are built
/// for.
pub fn core_command(toolchain: &Toolchain) -> Command {
    let mut cargo = toolchain.cargo("check", &paths::root());
    cargo.args(["--package", "taxel-core"]);
    cargo
}

/// Compiles only the core.
pub fn check_core() -> Result<(), String> {
    process::run(&mut core_command(&Toolchain::find()?))
}

/// Builds the firmware and runs it in the emulator.
pub fn emulate(args: &[String]) -> Result<(), String> {
    install::emulator()?;
    let image = build()?;
    let mut node = Command::new("node");
    node.arg(paths::emulator().join("emulator.mjs")).arg("--image").arg(image.elf).args(args);
    process::run(&mut node)
}
