//! Compiler for the microcontroller.
//!
//! There are three ways to get one. Two also build the compiler's library, and so without frame pointers:
//! these would take one of the eight registers that most instructions of a Cortex-M0+ can address, and 3 to 6
//! % more cycles. `cargo xtask firmware` prefers them: it asks rustup for the library's source, else apt-get
//! for a compiler with source. If neither is available, it uses the library that rustup has for the target.
//! TAXEL_CROSS selects a way by name.

use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

/// Target of the microcontroller.
pub const TARGET: &str = "thumbv6m-none-eabi";

/// Makes a stable compiler accept the options for target descriptions and library builds, which are for
/// nightly ones.
const BOOTSTRAP: (&str, &str) = ("RUSTC_BOOTSTRAP", "1");

/// Disables unrolling of loops with unknown length: most are short here, and the entry to an unrolled loop
/// takes longer than it saves. This saves 1 % of a frame's cycles and 8 % of the image. Then unrolls and
/// inlines less than by default (300 and 250): this saves 30 KiB of the image, and the functions for which it
/// costs cycles say `inline`.
pub const FLAGS: &str =
    "-Cllvm-args=-unroll-runtime=false -Cllvm-args=-unroll-threshold=120 -Cllvm-args=-inline-threshold=70";

/// Where cargo reads them.
pub const FLAGS_VARIABLE: &str = "CARGO_TARGET_THUMBV6M_NONE_EABI_RUSTFLAGS";

/// Oldest supported compiler version.
const OLDEST: (u32, u32) = (1, 95);

/// Origin of the compiler and its library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// rustup's compiler; the library is built from source.
    RustSrc,
    /// Debian's compiler; the library is built from source.
    Debian,
    /// rustup's compiler and rustup's library for the target.
    Target,
}

impl Way {
    /// All ways, best first.
    pub const ALL: [Way; 3] = [Way::RustSrc, Way::Debian, Way::Target];

    /// Name, as in TAXEL_CROSS.
    pub fn name(self) -> &'static str {
        match self {
            Way::RustSrc => "rust-src",
            Way::Debian => "debian",
            Way::Target => "target",
        }
    }

    /// The way that TAXEL_CROSS selects.
    fn asked() -> Result<Option<Way>, String> {
        let Some(name) = std::env::var_os("TAXEL_CROSS") else { return Ok(None) };
        let found = Way::ALL.into_iter().find(|way| name == way.name());
        found.map(Some).ok_or_else(|| {
            format!("TAXEL_CROSS is one of {}, not {name:?}", Way::ALL.map(Way::name).join(", "))
        })
    }

    /// Installs what the way needs.
    fn install(self) -> Result<(), String> {
        match self {
            Way::RustSrc => rustup(&["component", "add", "rust-src"]),
            Way::Debian => install::packages(install::CROSS),
            Way::Target => rustup(&["target", "add", TARGET]),
        }
    }

    /// An installed compiler.
    fn installed(self) -> Option<Toolchain> {
        let roots = sysroots();
        let mut mine =
            roots.iter().filter(|root| (root.as_path() == Path::new("/usr")) == (self == Way::Debian));
        let (root, described) = if self == Way::Target {
            (mine.find(|root| has_target_library(root))?, None)
        } else {
            mine.filter(|root| has_source(root)).find_map(|root| Some((root, Some(describe(root, self)?))))?
        };
        Some(Toolchain { way: self, bin: root.join("bin"), described, linker: linker(&roots)? })
    }
}

/// A compiler that can build for the target.
#[derive(Debug)]
pub struct Toolchain {
    way: Way,
    bin: PathBuf,
    /// Target description if the library is built, too; none if the library is installed.
    described: Option<PathBuf>,
    linker: PathBuf,
}

impl Toolchain {
    /// Finds or installs a toolchain: the way named by TAXEL_CROSS, else the best available. An installed way
    /// is preferred to an equally good one that must be installed first.
    pub fn find() -> Result<Toolchain, String> {
        if let Some(way) = Way::asked()? {
            return Toolchain::by(way);
        }
        if let Some(there) = [Way::RustSrc, Way::Debian].into_iter().find_map(Way::installed) {
            return Ok(there);
        }
        let mut why = Vec::new();
        for way in [Way::RustSrc, Way::Target, Way::Debian] {
            match Toolchain::by(way) {
                Ok(found) => return Ok(found),
                Err(error) => why.push(error),
            }
        }
        Err(format!("no compiler for {TARGET}: {}", why.join("; ")))
    }

    /// Toolchain of one way, installed if necessary.
    pub fn by(way: Way) -> Result<Toolchain, String> {
        if let Some(there) = way.installed() {
            return Ok(there);
        }
        way.install()?;
        way.installed().ok_or(format!("{}: no compiler that is new enough", way.name()))
    }

    /// Description of the library, for tables: images are comparable only for the same compiler and way.
    pub fn library(&self) -> &'static str {
        match self.way {
            Way::Target => "rustup's library, with frame pointers",
            Way::RustSrc | Way::Debian => "library built without frame pointers",
        }
    }

    /// The compiler itself.
    pub fn rustc(&self) -> PathBuf {
        self.bin.join("rustc")
    }

    /// Target folder; each way has its own, so that build products are not mixed.
    pub fn folder(&self) -> PathBuf {
        folder(self.way)
    }

    /// `cargo SUBCOMMAND` for the target, in `folder` with its manifest and configuration.
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
            .env("CARGO_TARGET_DIR", self.folder())
            // An incremental build is cut into other units: its sizes and cycles are not those of the image.
            .env("CARGO_INCREMENTAL", "0")
            .env("CARGO_TARGET_THUMBV6M_NONE_EABI_LINKER", &self.linker)
            .env(FLAGS_VARIABLE, FLAGS)
            .env_remove("RUSTUP_TOOLCHAIN");
        if self.described.is_some() {
            command.args(["-Zbuild-std=core", "-Zjson-target-spec"]).env(BOOTSTRAP.0, BOOTSTRAP.1);
        }
        command
    }

    /// Installs this toolchain's clippy if it is missing.
    pub fn install_clippy(&self) -> Result<(), String> {
        if self.bin.join("cargo-clippy").exists() {
            return Ok(());
        }
        if self.way == Way::Debian {
            install::packages(install::CROSS)
        } else {
            rustup(&["component", "add", "clippy"])
        }
    }
}

/// One at a time: two checks may miss the same component at once, and of two concurrent downloads to one
/// folder one fails.
fn rustup(args: &[&str]) -> Result<(), String> {
    static ONE: Mutex<()> = Mutex::new(());
    let _one = ONE.lock().unwrap_or_else(|broken| broken.into_inner());
    let mut rustup = Command::new("rustup");
    let typed = process::shown(rustup.args(args));
    eprintln!("xtask: {typed}");
    process::output(&mut rustup).map(|_| ()).ok_or(format!("`{typed}` failed"))
}

/// Build folder of a way.
fn folder(way: Way) -> PathBuf {
    paths::cross_target().join(way.name())
}

/// Folders of all sufficiently new compilers: the one in use first, then rustup's others, then the system's.
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

/// rustc prints the folder of a target's library even if it does not exist.
fn has_target_library(root: &Path) -> bool {
    let files = std::fs::read_dir(root.join("lib/rustlib").join(TARGET).join("lib"));
    files.into_iter().flatten().flatten().any(|file| {
        let name = file.file_name().to_string_lossy().into_owned();
        name.starts_with("libcore-") && name.ends_with(".rlib")
    })
}

/// Writes the compiler's description of the target, without frame pointers, to a file named after the target.
fn describe(root: &Path, way: Way) -> Option<PathBuf> {
    let print = ["-Zunstable-options", "--print", "target-spec-json", "--target", TARGET];
    let known =
        process::output(Command::new(root.join("bin/rustc")).args(print).env(BOOTSTRAP.0, BOOTSTRAP.1))?;
    let text = known.replace(r#""frame-pointer": "always""#, r#""frame-pointer": "may-omit""#);
    // Absolute, because cargo runs in another folder.
    let path = std::path::absolute(folder(way).join(TARGET).with_extension("json")).ok()?;
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
