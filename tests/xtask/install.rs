//! Installs missing programs if permitted, else names them.

use crate::process;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard};

/// Debian packages for the cross build if rustup cannot add the target: a compiler with the source of its
/// library.
pub const CROSS: &[&str] = &["rustc-web", "cargo-web", "rust-web-src", "rust-web-clippy", "lld"];

/// Debian packages for the emulator and the browser tests.
pub const NODE: &[&str] = &["nodejs", "npm"];

/// Debian packages of the browser.
pub const BROWSER: &[&str] = &["chromium"];

/// Debian packages that make machines of network namespaces, and lose packets between them.
const MACHINES: &[&str] = &["iproute2", "nftables"];

/// Checks run side by side; only one of them may install.
static INSTALLING: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    INSTALLING.lock().unwrap_or_else(|broken| broken.into_inner())
}

/// Refuses if rustup has no nightly compiler: it would be a large download that nobody asked for.
pub fn nightly() -> Result<(), String> {
    let asked = ["run", "nightly", "rustc", "--version"];
    let missing = "not run: there is no nightly compiler (rustup toolchain install nightly)";
    process::output(Command::new("rustup").args(asked)).map(|_| ()).ok_or(missing.into())
}

/// Installs Debian packages, or returns the command to type.
pub fn packages(names: &[&str]) -> Result<(), String> {
    let typed = format!("apt-get install {}", names.join(" "));
    if !is_root() || !process::exists("apt-get") {
        return Err(format!("missing; to install: {typed}"));
    }
    eprintln!("xtask: {typed}");
    let mut install = apt(&["install", "--yes", "--no-install-recommends"]);
    install.args(names);
    if process::output(&mut install).is_some() {
        return Ok(());
    }
    // The package lists may be outdated.
    process::output(&mut apt(&["update"]));
    process::output(&mut install).map(|_| ()).ok_or(format!("{typed} failed"))
}

fn apt(args: &[&str]) -> Command {
    let mut command = Command::new("apt-get");
    command.args(args).env("DEBIAN_FRONTEND", "noninteractive");
    command
}

/// True if this user may install packages.
pub fn is_root() -> bool {
    process::output(Command::new("id").arg("-u")).as_deref() == Some("0")
}

/// Installs Node and the emulator's packages.
pub fn emulator() -> Result<(), String> {
    let _alone = alone();
    node(&crate::paths::emulator(), "rp2040js")
}

/// Installs a headless browser, and Node with its driver and the checker of types.
pub fn browser() -> Result<(), String> {
    let _alone = alone();
    if !process::exists("chromium") {
        packages(BROWSER)?;
    }
    node(&crate::paths::browser(), "typescript")
}

/// Installs Node, and the packages of a folder, one of which is `package`.
fn node(folder: &Path, package: &str) -> Result<(), String> {
    if !process::exists("node") || !process::exists("npm") {
        packages(NODE)?;
    }
    if folder.join("node_modules").join(package).exists() {
        return Ok(());
    }
    let mut npm = Command::new("npm");
    npm.args(["ci", "--no-audit", "--no-fund"]).current_dir(folder);
    process::output(&mut npm).map(|_| ()).ok_or(format!(
        "`{}` in {} failed",
        process::shown(&npm),
        folder.display()
    ))
}

/// Installs what makes machines of network namespaces.
pub fn machines() -> Result<(), String> {
    let _alone = alone();
    let is_there = |tool: &str| process::output(Command::new(tool).arg("-V")).is_some();
    if ["ip", "nft"].into_iter().all(is_there) { Ok(()) } else { packages(MACHINES) }
}

/// Creates a Python environment with the readers of recordings, in a folder of its own.
pub fn python() -> Result<PathBuf, String> {
    python3("python3")?;
    let folder = crate::paths::target().join("xtask/python");
    let wanted = crate::paths::root().join("host/cli/tests/python/requirements.txt");
    python_in("python3", &folder, &wanted)
}

/// Installs Python if that is missing.
pub fn python3(python: &str) -> Result<(), String> {
    let _alone = alone();
    if process::exists(python) { Ok(()) } else { packages(&["python3", "python3-venv"]) }
}

/// Creates an environment of an interpreter with these packages, pinned by hash.
pub fn python_in(interpreter: &str, folder: &Path, wanted: &Path) -> Result<PathBuf, String> {
    let _alone = alone();
    let python = folder.join("bin/python");
    let read = |path: &Path| std::fs::read(path).ok();
    let note = folder.join("requirements.txt");
    if read(&note).is_some() && read(&note) == read(wanted) {
        return Ok(python);
    }
    let mut make = Command::new(interpreter);
    make.args(["-m", "venv"]).arg(folder);
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet", "--require-hashes", "--requirement"]).arg(wanted);
    for command in [&mut make, &mut install] {
        process::output(command).ok_or(format!("`{}` failed", process::shown(command)))?;
    }
    std::fs::copy(wanted, &note).map_err(|error| format!("{}: {error}", note.display()))?;
    Ok(python)
}

/// Creates an environment of an interpreter that did not exist before.
pub fn new_python(interpreter: &str, folder: &Path, log: &Path) -> Result<PathBuf, String> {
    let _ = std::fs::remove_dir_all(folder);
    process::run_into(Command::new(interpreter).args(["-m", "venv"]).arg(folder), log)?;
    Ok(folder.join("bin/python"))
}

/// Installs a program from crates.io in this version, in a folder of its own.
pub fn cargo_tool(name: &str, version: &str) -> Result<PathBuf, String> {
    cargo_tool_of(name, version, &[])
}

/// Installs a version of a program from cargo's registry with these options of `cargo install`.
pub fn cargo_tool_of(name: &str, version: &str, options: &[&str]) -> Result<PathBuf, String> {
    let _alone = alone();
    let folder = crate::paths::target().join(format!("tools/{name}-{version}"));
    let program = folder.join("bin").join(name);
    if program.exists() {
        return Ok(program);
    }
    let mut install = Command::new("cargo");
    install
        .args(["install", name, "--version", version, "--locked"])
        .args(options)
        .arg("--root")
        .arg(&folder);
    eprintln!("xtask: {}", process::shown(&install));
    process::output(&mut install).map(|_| program).ok_or(format!("`{}` failed", process::shown(&install)))
}
