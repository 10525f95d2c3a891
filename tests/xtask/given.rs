//! `cargo xtask campaign --only release`: what is given away is made, unpacked where there is no compiler, and walked
//! through (`tests/release/walk.py`): the program of each system, by an emulator where it must be, and the wheel with each
//! CPython.

use crate::end::End;
use crate::{install, interpreter, paths, process, release, wheels};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Debian's packages that run programs of other systems.
const EMULATORS: [&str; 3] = ["wine", "qemu-user-static", "libc6-arm64-cross"];

/// Makes and walks; returns sizes and what each walk took.
pub fn campaign(log: &Path) -> End<Vec<String>> {
    install::packages(&EMULATORS)?;
    Ok(made_and_walked(log))
}

fn made_and_walked(log: &Path) -> Result<Vec<String>, String> {
    let folder = paths::target().join("given/release");
    let _ = std::fs::remove_dir_all(&folder);
    let dist = folder.join("dist");
    let mut order: Vec<String> = vec!["--out".into(), dist.display().to_string()];
    order.extend(release::TARGETS.iter().flat_map(|target| ["--target".into(), target.to_string()]));
    release::run(&order)?;
    let mut lines = Vec::new();
    for file in files(&dist)? {
        lines.push(wheels::shown(&file));
    }
    for (target, through) in release::TARGETS.into_iter().zip(runners()) {
        let archive =
            files(&dist)?.into_iter().find(|file| file.to_string_lossy().contains(&format!("-{target}.")));
        let archive = archive.ok_or(format!("there is no program for {target}"))?;
        let module = if archive.extension().is_some_and(|end| end == "zip") { "zipfile" } else { "tarfile" };
        process::run_into(
            Command::new("python3").args(["-m", module, "-e"]).arg(&archive).arg(&folder),
            log,
        )?;
        let unpacked = folder.join(format!("taxel-{}-{target}", env!("CARGO_PKG_VERSION")));
        let is_windows = target.contains("windows");
        if is_windows {
            random_numbers(&unpacked, log)?;
        }
        let program = unpacked.join(if is_windows { "taxel.exe" } else { "taxel" });
        lines.extend(walked(target, &through, &program, log)?);
    }
    for python in interpreter::VERSIONS.filter_map(interpreter::interpreter) {
        let own = install::new_python(&python, &folder.join("python"), log)?;
        let wheel = files(&dist)?.into_iter().find(|file| file.to_string_lossy().ends_with("_x86_64.whl"));
        let wheel = wheel.ok_or("there is no wheel for this machine")?;
        process::run_into(Command::new(&own).args(["-m", "pip", "install", "--quiet"]).arg(wheel), log)?;
        let what = format!("wheel with CPython 3.{}", interpreter::minor(&python));
        lines.extend(walked(&what, &[], &own.with_file_name("taxel"), log)?);
    }
    Ok(lines)
}

/// How the program of each target is run.
fn runners() -> [Vec<&'static str>; 3] {
    [vec![], vec!["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu"], vec!["wine"]]
}

/// The library that Wine lacks a function of, beside a program.
fn random_numbers(folder: &Path, log: &Path) -> Result<(), String> {
    let mut build = Command::new(wheels::folder().join("bin/python"));
    build.args(["-m", "ziglang", "cc", "-target", "x86_64-windows-gnu", "-shared", "-o"]);
    build
        .arg(folder.join("bcryptprimitives.dll"))
        .arg(paths::root().join("tests/release/bcryptprimitives.c"));
    process::run_into(build.arg("-ladvapi32"), log)
}

/// Walks through a program; returns the lines that tell times.
fn walked(what: &str, through: &[&str], program: &Path, log: &Path) -> Result<Vec<String>, String> {
    let before = std::fs::read_to_string(log).unwrap_or_default().len();
    let mut walk = Command::new(wheels::folder().join("bin/python"));
    walk.arg(paths::root().join("tests/release/walk.py")).args(through).arg(program);
    walk.env("WINEPREFIX", paths::target().join("xtask/wine")).env("WINEDEBUG", "-all");
    // Without Rust on the path.
    process::run_into(walk.env("PATH", "/usr/bin:/bin"), log).map_err(|why| format!("{what}: {why}"))?;
    let said = std::fs::read_to_string(log).unwrap_or_default();
    let said = said.get(before..).unwrap_or_default().lines();
    let told = said.filter(|line| line.starts_with("first ") || line.starts_with("the walk"));
    Ok(told.map(|line| format!("{what}: {line}")).collect())
}

fn files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    Ok(files)
}
