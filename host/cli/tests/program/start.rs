//! Paths of the program and its examples.
#![allow(dead_code)] // each test that uses this takes a part of it

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

/// The program.
pub fn taxel() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_taxel"))
}

/// An example. Cargo builds it for a whole test run, but not for one target: it is built here if it is missing or
/// older than its sources.
pub fn example(name: &str) -> PathBuf {
    let folder = taxel().parent().unwrap();
    let example = folder.join("examples").join(name).with_extension(std::env::consts::EXE_EXTENSION);
    if changed(&example).is_none_or(|built| built < newest_source()) {
        build(folder, &["--example", name]);
    }
    example
}

fn changed(path: &Path) -> Option<SystemTime> {
    path.metadata().ok()?.modified().ok()
}

/// The workspace.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap()
}

fn newest_source() -> SystemTime {
    fn newest(path: &Path) -> Option<SystemTime> {
        let Ok(entries) = path.read_dir() else { return changed(path) };
        entries.filter_map(|entry| newest(&entry.ok()?.path())).max()
    }
    let folders =
        ["core/src", "host/cli/src", "host/sim", "host/taxel"].map(|folder| newest(&root().join(folder)));
    folders.into_iter().flatten().max().unwrap()
}

/// Builds into the folder of the profile.
fn build(folder: &Path, what: &[&str]) {
    let profile = folder.file_name().unwrap().to_str().unwrap();
    let profile = if profile == "debug" { "dev" } else { profile };
    let cargo = std::env::var_os("CARGO").unwrap_or("cargo".into());
    let mut command = Command::new(cargo);
    command
        .current_dir(root())
        .args(["build", "--quiet", "--workspace", "--features", "full", "--profile", profile])
        .args(what);
    let status = command.arg("--target-dir").arg(folder.parent().unwrap()).status().unwrap();
    assert!(status.success(), "the example cannot be built");
}
