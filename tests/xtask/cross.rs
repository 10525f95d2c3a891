//! The compiler for the microcontroller.
//!
//! The first compiler that has the source of its library builds that, too, and so without frame pointers: they would take one of the
//! eight registers that most instructions of a Cortex-M0+ can name, and 3 to 6 % more cycles. Else a toolchain that has the target's
//! library builds plainly; else rustup is asked for the target, then apt-get for a compiler with source.

use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The microcontroller's target.
pub const TARGET: &str = "thumbv6m-none-eabi";

/// What describes targets and builds the library is for nightly compilers, or for those that are told to be one.
const BOOTSTRAP: (&str, &str) = ("RUSTC_BOOTSTRAP", "1");

/// Loops whose length is not known stay as they are: most are short here, and what leads into an unrolled one takes longer than it saves.
/// That saves 1 % of a frame's cycles and 8 % of the image.
const FLAGS: &str = "-Cllvm-args=-unroll-runtime=false";

/// The oldest compiler that the sources are written for.
const OLDEST: (u32, u32) = (1, 95);

/// A compiler that can build for the target.
#[derive(Debug)]
pub struct Toolchain {
    bin: PathBuf,
    /// The description of the target for which the library is built, too; none: the library is there.
    described: Option<PathBuf>,
    linker: PathBuf,
}

impl Toolchain {
    /// Finds one, or installs one.
    pub fn find() -> Result<Toolchain, String> {
        if let Some(found) = Toolchain::installed() {
            return Ok(found);
        }
        let rustup = ["target", "add", TARGET];
        if process::output(Command::new("rustup").args(rustup)).is_none() {
            install::packages(install::CROSS)
                .map_err(|apt| format!("no compiler for {TARGET}: rustup {}; or {apt}", rustup.join(" ")))?;
        }
        Toolchain::installed().ok_or(format!("no compiler for {TARGET}"))
    }

    fn installed() -> Option<Toolchain> {
        let sysroots = sysroots();
        let sources = sysroots.iter().filter(|root| has_source(root));
        let mut described = sources.filter_map(|root| Some((root, Some(describe(root)?))));
        let plain = || sysroots.iter().find(|root| has_target_library(root)).map(|root| (root, None));
        let (root, described) = described.next().or_else(plain)?;
        Some(Toolchain { bin: root.join("bin"), described, linker: linker(&sysroots)? })
    }

    /// `cargo SUBCOMMAND` for the target, in `folder`, whose manifest and configuration cargo finds by that.
    pub fn cargo(&self, subcommand: &str, folder: &Path) -> Command {
        let mut command =
            Command::new(self.bin.join(if subcommand == "clippy" { "cargo-clippy" } else { "cargo" }));
        let target = self.described.as_deref().unwrap_or(Path::new(TARGET));
        command
            .arg(subcommand)
            .args(["--release", "--target"])
            .arg(target)
            .current_dir(folder)
            .env("CARGO", self.bin.join("cargo"))
            .env("RUSTC", self.bin.join("rustc"))
            .env("CARGO_TARGET_DIR", paths::cross_target())
            .env("CARGO_TARGET_THUMBV6M_NONE_EABI_LINKER", &self.linker)
            .env("CARGO_TARGET_THUMBV6M_NONE_EABI_RUSTFLAGS", FLAGS)
            .env_remove("RUSTUP_TOOLCHAIN");
        if self.described.is_some() {
            command.args(["-Zbuild-std=core", "-Zjson-target-spec"]).env(BOOTSTRAP.0, BOOTSTRAP.1);
        }
        command
    }

    /// Whether this toolchain has clippy.
    pub fn has_clippy(&self) -> bool {
        self.bin.join("cargo-clippy").exists()
    }
}

/// The folders of all compilers that are new enough: the one in use first, then rustup's others, then the system's.
fn sysroots() -> Vec<PathBuf> {
    let mut compilers = vec![PathBuf::from("rustc")];
    let listed =
        process::output(Command::new("rustup").args(["toolchain", "list", "-v"])).unwrap_or_default();
    let folders = listed.lines().filter_map(|line| line.split_whitespace().last());
    compilers.extend(folders.map(|folder| Path::new(folder).join("bin/rustc")));
    compilers.push(PathBuf::from("/usr/bin/rustc"));
    let mut roots: Vec<PathBuf> = Vec::new();
    for compiler in compilers {
        let Some(version) = process::output(Command::new(&compiler).arg("--version")) else { continue };
        let Some(root) = process::output(Command::new(&compiler).args(["--print", "sysroot"])) else {
            continue;
        };
        let root = PathBuf::from(root);
        if parse_version(&version).is_some_and(|v| v >= OLDEST) && !roots.contains(&root) {
            roots.push(root);
        }
    }
    roots
}

/// "rustc 1.96.0 (...)" is (1, 96).
fn parse_version(text: &str) -> Option<(u32, u32)> {
    let mut numbers = text.split_whitespace().nth(1)?.split('.');
    Some((numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?))
}

/// rustc prints the folder of a target's library even when nothing is there.
fn has_target_library(root: &Path) -> bool {
    let files = std::fs::read_dir(root.join("lib/rustlib").join(TARGET).join("lib"));
    files.into_iter().flatten().flatten().any(|file| {
        let name = file.file_name().to_string_lossy().into_owned();
        name.starts_with("libcore-") && name.ends_with(".rlib")
    })
}

/// Writes down what a compiler knows of the target, but that frame pointers are not wanted; the file is named as the target is.
fn describe(root: &Path) -> Option<PathBuf> {
    let print = ["-Zunstable-options", "--print", "target-spec-json", "--target", TARGET];
    let known =
        process::output(Command::new(root.join("bin/rustc")).args(print).env(BOOTSTRAP.0, BOOTSTRAP.1))?;
    let text = known.replace(r#""frame-pointer": "always""#, r#""frame-pointer": "may-omit""#);
    // Cargo looks for it from another folder.
    let path = std::path::absolute(paths::cross_target().join(TARGET).with_extension("json")).ok()?;
    if std::fs::read_to_string(&path).is_ok_and(|written| written == text) {
        return Some(path);
    }
    std::fs::create_dir_all(path.parent()?).ok()?;
    std::fs::write(&path, text).ok()?;
    Some(path)
}

fn has_source(root: &Path) -> bool {
    root.join("lib/rustlib/src/rust/library/core/src/lib.rs").exists()
}

/// rust-lld of any toolchain, else the system's lld.
fn linker(sysroots: &[PathBuf]) -> Option<PathBuf> {
    let hosts = |root: &PathBuf| {
        let folders = std::fs::read_dir(root.join("lib/rustlib")).into_iter().flatten().flatten();
        folders.map(|host| host.path().join("bin/rust-lld")).find(|path| path.exists())
    };
    let system = PathBuf::from("/usr/bin/ld.lld");
    sysroots.iter().find_map(hosts).or_else(|| system.exists().then_some(system))
}

#[cfg(test)]
mod tests {
    use super::parse_version;

    #[test]
    fn versions_compare_by_number() {
        assert_eq!(parse_version("rustc 1.96.0 (ac68faa20 2026-05-25)"), Some((1, 96)));
        assert!(parse_version("rustc 1.100.0-nightly (x)") > Some((1, 95)));
        assert_eq!(parse_version("rustc"), None);
    }
}
