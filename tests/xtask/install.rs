//! What is missing on the machine is installed where that is allowed, and otherwise named.

use crate::process;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard};

/// What apt-get offers for the cross build where rustup cannot add the target: a compiler with its library's
/// source.
pub const CROSS: &[&str] = &["rustc-web", "cargo-web", "rust-web-src", "rust-web-clippy", "lld"];

/// What the emulator and the browser need.
pub const NODE: &[&str] = &["nodejs", "npm"];

/// What shows the page of `taxel view`.
pub const BROWSER: &[&str] = &["chromium"];

/// Checks run two at a time; only one of them installs.
static INSTALLING: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    INSTALLING.lock().unwrap_or_else(|broken| broken.into_inner())
}

/// Installs Debian packages, or says what to type.
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
    // The lists may be too old to find the packages.
    process::output(&mut apt(&["update"]));
    process::output(&mut install).map(|_| ()).ok_or(format!("{typed} failed"))
}

fn apt(args: &[&str]) -> Command {
    let mut command = Command::new("apt-get");
    command.args(args).env("DEBIAN_FRONTEND", "noninteractive");
    command
}

fn is_root() -> bool {
    process::output(Command::new("id").arg("-u")).as_deref() == Some("0")
}

/// Node and the emulator's packages.
pub fn emulator() -> Result<(), String> {
    let _alone = alone();
    node(&crate::paths::emulator(), "rp2040js")
}

/// A browser without a screen, and Node with what drives it.
pub fn browser() -> Result<(), String> {
    let _alone = alone();
    if !process::exists("chromium") {
        packages(BROWSER)?;
    }
    node(&crate::paths::browser(), "ws")
}

/// Node, and the packages of a folder, of which `package` is one.
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

/// An interpreter of Python that has the readers of recordings, in a folder of its own.
pub fn python() -> Result<PathBuf, String> {
    let _alone = alone();
    if !process::exists("python3") {
        packages(&["python3", "python3-venv"])?;
    }
    let folder = crate::paths::target().join("xtask/python");
    let python = folder.join("bin/python");
    let wanted = crate::paths::root().join("host/tests/python/requirements.txt");
    let read = |path: &Path| std::fs::read(path).ok();
    let note = folder.join("requirements.txt");
    if read(&note).is_some() && read(&note) == read(&wanted) {
        return Ok(python);
    }
    let mut make = Command::new("python3");
    make.args(["-m", "venv"]).arg(&folder);
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet", "--require-hashes", "--requirement"]).arg(&wanted);
    for command in [&mut make, &mut install] {
        process::output(command).ok_or(format!("`{}` failed", process::shown(command)))?;
    }
    std::fs::copy(&wanted, &note).map_err(|error| format!("{}: {error}", note.display()))?;
    Ok(python)
}

/// A program of cargo's registry in this version, in a folder of its own.
pub fn cargo_tool(name: &str, version: &str) -> Result<PathBuf, String> {
    let _alone = alone();
    let folder = crate::paths::target().join(format!("tools/{name}-{version}"));
    let program = folder.join("bin").join(name);
    if program.exists() {
        return Ok(program);
    }
    let mut install = Command::new("cargo");
    install.args(["install", name, "--version", version, "--locked", "--root"]).arg(&folder);
    eprintln!("xtask: {}", process::shown(&install));
    process::output(&mut install).map(|_| program).ok_or(format!("`{}` failed", process::shown(&install)))
}
